// SPDX-License-Identifier: MIT
#include "verify/replay.hpp"

// Boost's headers would warn of each other.
#define BOOST_ALLOW_DEPRECATED_HEADERS
#include <algorithm>
#include <array>
// Whole: from Boost 1.77 on the index alone lacks what it needs of the rest.
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>
#include <charconv>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <queue>
#include <tuple>
#include <utility>
#include <variant>

#include "quadrille/continuous/quantise.hpp"
#include "verify/footprints.hpp"
#include "verify/trip.hpp"

namespace quadrille::continuous {
namespace {

using Kind = Violation::Kind;

/// A number in few digits.
std::string number(double value, int digits) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                                 std::chars_format::general, digits);
  return {text.data(), end.ptr};
}

/// Where b is as seen from a, at `begin` and at `end`, in floating point.
RealStep real_step(const Piece& a, const Piece& b, Ticks begin, Ticks end) {
  const auto at = [](const Piece& p, Ticks tick, Length Point::*axis) {
    return static_cast<long double>((p.from.*axis).value()) +
           static_cast<long double>((p.to.*axis - p.from.*axis).value()) *
               static_cast<long double>(p.done(tick).value()) /
               static_cast<long double>(p.all().value());
  };
  const auto apart = [&](Ticks tick) {
    return RealPoint{at(b, tick, &Point::x) - at(a, tick, &Point::x),
                     at(b, tick, &Point::y) - at(a, tick, &Point::y),
                     at(b, tick, &Point::z) - at(a, tick, &Point::z)};
  };
  return {apart(begin), apart(end)};
}

/// The same, exactly: multiplied by both durations, positions are integers.
ExactStep exact_step(const Piece& a, const Piece& b, Ticks begin, Ticks end) {
  const Integer duration_a = a.all().value(), duration_b = b.all().value();
  const auto at = [](const Piece& p, Ticks tick, Length Point::*axis) -> Integer {
    return Integer((p.from.*axis).value()) * p.all().value() +
           Integer((p.to.*axis - p.from.*axis).value()) * p.done(tick).value();
  };
  const auto apart = [&](Ticks tick, Length Point::*axis) -> Integer {
    return at(b, tick, axis) * duration_a - at(a, tick, axis) * duration_b;
  };
  const auto place = [&](Ticks tick) -> ExactPoint {
    return {apart(tick, &Point::x), apart(tick, &Point::y), apart(tick, &Point::z)};
  };
  return {place(begin), place(end), duration_a * duration_b};
}

/// The last tick before two bodies overlap, and the first one after: they touch there, up to a
/// tick. Requires that they overlap between `begin` and `end`, and so, as bodies are convex and
/// each moves on a line as seen from the other, during one stretch of that time. Logarithmic in the
/// number of ticks.
std::pair<Ticks, Ticks> moments_of_contact(const FootprintPair& bodies, const Piece& a,
                                           const Piece& b, Ticks begin, Ticks end) {
  const auto overlap = [&](Ticks from, Ticks to) {
    return bodies.interiors_meet(exact_step(a, b, from, to));
  };
  Ticks first = begin, last = end;
  if (!overlap(begin, begin))
    for (Ticks known = end; known - first > 1;) {
      const Ticks middle = first + (known - first) / 2;
      (overlap(begin, middle) ? known : first) = middle;
    }
  if (!overlap(end, end))
    for (Ticks known = begin; last - known > 1;) {
      const Ticks middle = known + (last - known) / 2;
      (overlap(middle, end) ? known : last) = middle;
    }
  return {first, last};
}

/// How near two come, and when.
struct Nearness {
  double gap, tick;
};

/// Pieces, one after the other, that collide; when they begin and cease to; and those two that come
/// nearest.
struct Collision {
  Piece a, b;
  Ticks begin, end;
  Nearness nearest;
  bool goes_on;  // at `end`
};

// Coordinates are below 2^42, and so exact.
using Corner = boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>;
using Box = boost::geometry::model::box<Corner>;

/// How far a body reaches beyond its place in any direction, rounded up.
double reach_of(const Body& body) {
  if (const auto* disc = std::get_if<Disc>(&body)) return static_cast<double>(disc->radius.value());
  double most = 0;
  for (const Point& corner : std::get<ConvexPolygon>(body).vertices())
    for (const Length along : {corner.x, corner.y})
      most = std::max(most, std::abs(static_cast<double>(along.value())));
  return most;
}

double reach_of(const Agent& agent) {
  double most = reach_of(agent.body);
  for (const Body& body : agent.shapes) most = std::max(most, reach_of(body));
  return most;
}

Box box_around(const Point& from, const Point& to, double margin) {
  Corner low, high;
  const auto set = [&]<std::size_t k>(std::integral_constant<std::size_t, k>, Length a, Length b) {
    low.set<k>(static_cast<double>(std::min(a, b).value()) - margin);
    high.set<k>(static_cast<double>(std::max(a, b).value()) + margin);
  };
  set(std::integral_constant<std::size_t, 0>(), from.x, to.x);
  set(std::integral_constant<std::size_t, 1>(), from.y, to.y);
  set(std::integral_constant<std::size_t, 2>(), from.z, to.z);
  return {low, high};
}

/// The least clearances of so many pairs.
class LeastClearances {
 public:
  explicit LeastClearances(std::size_t most) : most_(most) {
    if (most == 0) ceiling_ = -std::numeric_limits<double>::infinity();
  }

  /// What is above this is none of them.
  [[nodiscard]] double ceiling() const { return ceiling_; }

  void add(const Clearance& found) {
    if (found.gap > ceiling_) return;
    const auto [entry, is_new] = of_pair_.try_emplace({found.agent, found.other}, found);
    if (!is_new && found.gap < entry->second.gap) entry->second = found;
    // Twice as many as are asked for, so that sorting them is rare.
    if (of_pair_.size() / 2 >= most_) drop();
  }

  [[nodiscard]] std::vector<Clearance> take() {
    std::vector<Clearance> all = sorted();
    if (all.size() > most_) all.resize(most_);
    return all;
  }

 private:
  [[nodiscard]] std::vector<Clearance> sorted() const {
    std::vector<Clearance> all;
    for (const auto& [pair, clearance] : of_pair_) all.push_back(clearance);
    std::stable_sort(all.begin(), all.end(),
                     [](const Clearance& a, const Clearance& b) { return a.gap < b.gap; });
    return all;
  }
  void drop() {
    const std::vector<Clearance> all = sorted();
    for (std::size_t k = most_; k < all.size(); ++k) of_pair_.erase({all[k].agent, all[k].other});
    ceiling_ = all[most_ - 1].gap;
  }

  std::size_t most_;
  double ceiling_ = std::numeric_limits<double>::infinity();
  std::map<std::pair<AgentId, AgentId>, Clearance> of_pair_;
};

/// Travellers are the agents, by their numbers, and after them the obstacles.
class Replay {
 public:
  Replay(const Instance& instance, const Plan& plan, const IdVector<AgentId, bool>& sound,
         std::size_t num_clearances)
      : instance_(instance), least_(num_clearances) {
    Ticks horizon = 1;
    for (const MovingObstacle& obstacle : instance.obstacles())
      horizon = std::max(horizon, obstacle.path.back().depart + 1);
    for (const AgentId i : instance.agent_ids())
      if (sound[i]) horizon = std::max(horizon, plan.paths[i].back().arrive + 1);
    std::map<std::size_t, double> reach_of_class;
    for (const AgentId i : instance.agent_ids()) {
      const Agent& agent = instance.agent(i);
      const std::size_t kind = instance.class_of(i).index();
      const auto [reach, is_new] = reach_of_class.try_emplace(kind, 0);
      if (is_new) reach->second = reach_of(agent);
      add({Trip(instance.roadmap(), plan.paths[i], agent.leaves, horizon), &agent.body, kind,
           reach->second},
          sound[i]);
    }
    num_agents_ = travellers_.size();
    for (std::size_t o = 0; o < instance.obstacles().size(); ++o) {
      const MovingObstacle& obstacle = instance.obstacles()[o];
      add({Trip(obstacle, horizon), &obstacle.body, num_agents_ + o, reach_of(obstacle.body)},
          true);
    }
    for (const AgentId i : instance.agent_ids())
      if (sound[i] && instance.agent(i).leaves) find_appearances(i, plan.paths[i]);
  }

  void run() {
    while (!next_.empty()) {
      const std::size_t t = next_.top().second;
      next_.pop();
      leave(t);
      enter(t);
    }
  }

  [[nodiscard]] std::vector<Violation> collisions() const {
    std::vector<Violation> found = overlaps_;
    for (const auto& [pair, all] : collisions_)
      for (const Collision& collision : all) found.push_back(violation(pair, collision));
    std::stable_sort(found.begin(), found.end(), [](const Violation& a, const Violation& b) {
      return std::tie(a.tick, a.agent, a.other) < std::tie(b.tick, b.agent, b.other);
    });
    return found;
  }

  [[nodiscard]] std::vector<Clearance> clearances() { return least_.take(); }

 private:
  struct Traveller {
    Trip trip;
    const Body* body;  // of one with shapes: during `piece`
    std::size_t kind;  // those of one kind have equal bodies
    double reach;
    std::optional<Piece> piece = {};  // the one after the last is none
    ShapeId shape = {};               // of `body`
    bool is_there = false;            // in `index_`, with `box`
    Box box = {};
  };
  using Entry = std::pair<Box, std::size_t>;
  using Pair = std::pair<std::size_t, std::size_t>;  // ascending

  void add(Traveller traveller, bool takes_part) {
    if (takes_part) traveller.piece = traveller.trip.next();
    if (traveller.piece) next_.emplace(traveller.piece->begin, travellers_.size());
    travellers_.push_back(std::move(traveller));
  }

  void leave(std::size_t t) {
    Traveller& traveller = travellers_[t];
    if (!traveller.is_there) return;
    index_.remove(Entry{traveller.box, t});
    traveller.is_there = false;
    traveller.piece = traveller.trip.next();
  }

  /// Looks at all who are near the piece that begins, and files it.
  void enter(std::size_t t) {
    Traveller& traveller = travellers_[t];
    if (!traveller.piece) return;
    const Piece& piece = *traveller.piece;
    if (t < num_agents_) put_on_shape(AgentId(t), traveller);
    near_.clear();
    // One unit more, so that nothing hangs on rounding.
    double margin = traveller.reach + 1;
    if (t < num_agents_) margin += std::max(least_.ceiling(), 0.0);
    index_.query(
        boost::geometry::index::intersects(box_around(piece.from, piece.to, margin)),
        boost::make_function_output_iterator([&](const Entry& e) { near_.push_back(e.second); }));
    // The tree's own order is nobody's business.
    std::sort(near_.begin(), near_.end());
    for (const std::size_t other : near_)
      if (std::min(t, other) < num_agents_) look({std::min(t, other), std::max(t, other)});
    traveller.box = box_around(piece.from, piece.to, traveller.reach);
    traveller.is_there = true;
    index_.insert(Entry{traveller.box, t});
    // At its end it leaves, and enters again.
    next_.emplace(piece.end, t);
  }

  /// That of where it stands, or of the edge that it is on.
  void put_on_shape(AgentId i, Traveller& traveller) const {
    const Agent& agent = instance_.agent(i);
    if (agent.shapes.empty()) return;
    const Piece& piece = *traveller.piece;
    const Roadmap& roadmap = instance_.roadmap();
    traveller.shape = piece.start == piece.goal ? roadmap.shape(piece.start)
                                                : roadmap.shape(piece.start, piece.goal);
    traveller.body = &agent.body_as(traveller.shape);
  }

  [[nodiscard]] const FootprintPair& footprints(const Traveller& a, const Traveller& b) {
    return footprints_.try_emplace({{a.kind, a.shape}, {b.kind, b.shape}}, *a.body, *b.body)
        .first->second;
  }

  void look(Pair pair) {
    const Traveller &a = travellers_[pair.first], &b = travellers_[pair.second];
    const Piece &p = *a.piece, &q = *b.piece;
    const Ticks begin = std::max(p.begin, q.begin), end = std::min(p.end, q.end);
    if (begin >= end) return;
    const bool are_agents = pair.second < num_agents_;
    if (are_agents && are_parked(pair, begin)) return;
    const bool collide = find_collision(pair, begin, end, are_agents);
    if (are_agents && instance_.has_whole_moves() && !collide) find_overlap(pair, begin);
  }

  /// An agent is in the way when it arrives and leaves, and an obstacle when it appears: where both
  /// have only that moment in common, no stretch of time shows it. Who leaves from its start
  /// at once is never there.
  void find_appearances(AgentId i, const Path& path) {
    const Stop& last = path.back();
    if (path.size() == 1 && last.depart == last.arrive) return;
    const Roadmap& roadmap = instance_.roadmap();
    const Point at = roadmap.position(last.vertex);
    const Body& body = instance_.agent(i).shapes.empty()
                           ? instance_.agent(i).body
                           : instance_.agent(i).body_as(roadmap.shape(last.vertex));
    for (std::size_t o = 0; o < instance_.obstacles().size(); ++o) {
      const MovingObstacle& obstacle = instance_.obstacles()[o];
      const MovingObstacle::Stop& first = obstacle.path.front();
      if (first.arrive != last.depart) continue;
      const ExactPoint apart{(first.at.x - at.x).value(), (first.at.y - at.y).value(),
                             (first.at.z - at.z).value()};
      if (FootprintPair(body, obstacle.body).interiors_meet({apart, apart, 1}))
        overlaps_.push_back({Kind::obstacle, i, std::nullopt, last.depart,
                             "at time " + time_text(instance_, last.depart) + " " + agent_name(i) +
                                 " leaves from vertex " + std::to_string(last.vertex.index()) +
                                 ", where obstacle " + std::to_string(o) + " appears"});
    }
  }

  /// Of two moves that are released as a whole.
  void find_overlap(Pair pair, Ticks begin) {
    const Traveller &a = travellers_[pair.first], &b = travellers_[pair.second];
    const Piece &p = *a.piece, &q = *b.piece;
    if (p.start == p.goal || q.start == q.goal) return;
    const auto between = [](const Point& from, const Point& to) {
      return ExactPoint{(to.x - from.x).value(), (to.y - from.y).value(), (to.z - from.z).value()};
    };
    if (!footprints(a, b).sweeps_meet(
            {between(p.from, q.from), between(p.to, p.from), between(q.from, q.to)}))
      return;
    const auto who = [&](std::size_t agent, const Piece& piece) {
      return "agent " + std::to_string(agent) + " " + describe(piece);
    };
    overlaps_.push_back({Kind::whole_moves, AgentId(pair.first), AgentId(pair.second), begin,
                         "at time " + time_text(instance_, begin) + " " + who(pair.first, p) +
                             " and " + who(pair.second, q) +
                             ": bodies could collide there, and moves are released as a whole"});
  }

  /// Whether there is one.
  bool find_collision(Pair pair, Ticks begin, Ticks end, bool are_agents) {
    const Traveller &a = travellers_[pair.first], &b = travellers_[pair.second];
    const Piece &p = *a.piece, &q = *b.piece;
    const double ceiling = are_agents ? least_.ceiling() : -1;
    const FootprintPair& bodies = footprints(a, b);
    const RealStep step = real_step(p, q, begin, end);
    const long double least = bodies.least_gap(step);
    if (least >= 1 && static_cast<double>(least) > ceiling) return false;
    const FootprintPair::Nearest near = bodies.nearest(step);
    const Nearness here{
        static_cast<double>(near.gap),
        static_cast<double>(static_cast<long double>(begin.value()) +
                            near.share * static_cast<long double>((end - begin).value()))};
    if (are_agents) least_.add({AgentId(pair.first), AgentId(pair.second), here.gap, here.tick});
    // Coordinates are below 2^42 and the rounding error of `nearest`, even where long double is
    // double, below 2^-5: those that are a whole unit apart need no exact look.
    if (near.gap >= 1 || !bodies.interiors_meet(exact_step(p, q, begin, end))) return false;
    const bool goes_on = bodies.interiors_meet(exact_step(p, q, end, end));
    const auto [first, last_touch] = moments_of_contact(bodies, p, q, begin, end);
    std::vector<Collision>& all = collisions_[pair];
    // What goes on at its end goes on in the next stretches of the two.
    if (all.empty() || !all.back().goes_on || all.back().end < begin) {
      all.push_back({p, q, first, last_touch, here, goes_on});
      return true;
    }
    Collision& last = all.back();
    if (here.gap < last.nearest.gap) std::tie(last.a, last.b, last.nearest) = std::tie(p, q, here);
    last.end = last_touch;
    last.goes_on = goes_on;
    return true;
  }

  /// Both may overlap at their starts and do, where one of them is and the other one is as well or
  /// makes its first move, at whose beginning they overlap, and at whose end they do not.
  [[nodiscard]] bool are_parked(Pair pair, Ticks begin) {
    const auto parks = [&](std::size_t t) { return instance_.agent(AgentId(t)).overlaps_at_start; };
    if (!parks(pair.first) || !parks(pair.second)) return false;
    const Traveller &a = travellers_[pair.first], &b = travellers_[pair.second];
    const Piece &p = *a.piece, &q = *b.piece;
    const bool p_stands = p.start == p.goal, q_stands = q.start == q.goal;
    const auto overlap = [&](Ticks tick) {
      return footprints(a, b).interiors_meet(exact_step(p, q, tick, tick));
    };
    if (!p.is_first || !q.is_first || (!p_stands && !q_stands) || !overlap(begin)) return false;
    return p_stands ? q_stands || !overlap(q.end) : !overlap(p.end);
  }

  [[nodiscard]] Violation violation(Pair pair, const Collision& c) const {
    const AgentId i(pair.first);
    const std::string between =
        " between times " + time_text(instance_, c.begin) + " and " + time_text(instance_, c.end);
    if (pair.second >= num_agents_)
      return {Kind::obstacle, i, std::nullopt, c.begin,
              agent_name(i) + " collides with obstacle " +
                  std::to_string(pair.second - num_agents_) + between + ", while it " +
                  describe(c.a)};
    const AgentId j(pair.second);
    const Resolution& resolution = instance_.resolution();
    const double overlap = -c.nearest.gap;
    return {Kind::collision,
            i,
            j,
            c.begin,
            "agents " + std::to_string(i.index()) + " and " + std::to_string(j.index()) +
                " collide" + between + ": nearest at about " +
                number(c.nearest.tick * resolution.time, 6) + ", while agent " +
                std::to_string(i.index()) + " " + describe(c.a) + " and agent " +
                std::to_string(j.index()) + " " + describe(c.b) + ", " +
                (overlap < 1.5 ? "at most " + number(1.5 * resolution.length, 3)
                               : "about " + number(overlap * resolution.length, 3)) +
                " too close",
            c.nearest.tick};
  }

  const Instance& instance_;
  std::size_t num_agents_ = 0;
  std::vector<Traveller> travellers_;
  // When pieces begin and end, by time, then traveller.
  using Event = std::pair<Ticks, std::size_t>;
  std::priority_queue<Event, std::vector<Event>, std::greater<>> next_;
  boost::geometry::index::rtree<Entry, boost::geometry::index::quadratic<16>> index_;
  std::vector<std::size_t> near_;
  using Look = std::pair<std::size_t, ShapeId>;  // a kind in a shape
  std::map<std::pair<Look, Look>, FootprintPair> footprints_;
  std::map<Pair, std::vector<Collision>> collisions_;
  std::vector<Violation> overlaps_;
  LeastClearances least_;
};

}  // namespace

std::string agent_name(AgentId i) { return "agent " + std::to_string(i.index()); }

std::string time_text(const Instance& instance, Ticks ticks) {
  return number(in_input_units(ticks, instance.resolution()), 15);
}

Happenings replay(const Instance& instance, const Plan& plan, const IdVector<AgentId, bool>& sound,
                  std::size_t num_clearances) {
  Replay replay(instance, plan, sound, num_clearances);
  replay.run();
  return {replay.collisions(), replay.clearances()};
}

}  // namespace quadrille::continuous
