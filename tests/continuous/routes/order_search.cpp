// SPDX-License-Identifier: MIT
#include "continuous/routes/order_search.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <map>

#include "continuous/support/differences.hpp"
#include "continuous/support/meeting.hpp"
#include "continuous/support/whole_places.hpp"

namespace quadrille::continuous::test {
namespace {

constexpr std::size_t kSomePlans = 10;
/// Later than all that happens: the end of stays for ever.
constexpr Ticks kNever = 1'000'000;
constexpr Cost kNoLimit = std::numeric_limits<Cost>::max() / 8;

/// The edges that an agent follows, and when that ends at the earliest.
struct Walk {
  std::vector<EdgeId> edges;
  std::vector<VertexId> places;  // one more
  std::vector<Ticks> durations;
  Ticks total = 0;
};

std::vector<Walk> walks(const Instance& instance, AgentId i, std::size_t max_moves) {
  std::vector<Walk> found;
  std::vector<Walk> some{{{}, {instance.agent(i).start}, {}, 0}};  // all of the same length
  for (std::size_t moves = 0; moves <= max_moves; ++moves) {
    std::vector<Walk> longer;
    for (const Walk& walk : some) {
      if (instance.agent(i).goals.contains(walk.places.back())) found.push_back(walk);
      for (const EdgeId e : instance.roadmap().out_edges(walk.places.back())) {
        if (!is_open(instance, i, e)) continue;
        longer.push_back(walk);
        longer.back().edges.push_back(e);
        longer.back().places.push_back(instance.roadmap().edge(e).to);
        longer.back().durations.push_back(instance.duration(instance.class_of(i), e));
        longer.back().total += longer.back().durations.back();
        if (longer.back().edges.size() == 1) longer.back().total += instance.agent(i).release;
      }
    }
    some = std::move(longer);
  }
  return found;
}

/// Move `later` of one agent begins `gap` or more after move `earlier` of the other one.
struct Order {
  bool second_waits = false;  // else it is the first agent's move that is the later one
  std::size_t earlier = 0, later = 0;
  Ticks gap = 0;
};

/// One of the orders has to be kept; there may be none, or one, to choose from.
using Question = std::vector<Order>;

/// A move begins at the tick or later, or at the tick or before.
struct Limit {
  bool is_least = false;
  std::size_t move = 0;
  Ticks tick = 0;
};

/// A way in which two agents get past each other: an answer to each question.
struct Passing {
  std::vector<Order> orders;
  Cost cost = 0;  // of both
};

class Oracle {
 public:
  Oracle(const Instance& instance, Objective objective, std::size_t max_moves)
      : instance_(instance),
        meetings_(instance_),
        is_sum_(objective == Objective::sum_of_costs),
        capacity_(instance.num_agents() * max_moves + 1) {
    for (const AgentId i : instance.agent_ids()) walks_.push_back(walks(instance, i, max_moves));
    passings_.resize(walks_.size() * walks_.size());
  }

  OrderSearch search() {
    for (const auto& of_agent : walks_) {
      if (of_agent.empty()) return result_;
      const auto shortest = std::min_element(of_agent.begin(), of_agent.end(), is_shorter);
      least_.push_back(as_cost(shortest->total));
    }
    follow({Differences(capacity_), {}, {}, 0});
    if (result_.some_plans.size() < kSomePlans) return result_;  // these are all
    for (auto& of_agent : walks_) std::stable_sort(of_agent.begin(), of_agent.end(), is_shorter);
    for (auto& known : passings_) known.clear();
    limit_ = *result_.best;
    follow({Differences(capacity_), {}, {}, 0});
    return result_;
  }

 private:
  /// Walks of the first agents, and the orders that have been chosen.
  struct Partial {
    Differences times;
    std::vector<std::size_t> walks;                // by agent
    std::vector<std::vector<std::size_t>> starts;  // by agent, by move: its moment
    Cost cost = 0;
  };

  static bool is_shorter(const Walk& a, const Walk& b) { return a.total < b.total; }
  [[nodiscard]] Cost joined(Cost a, Cost b) const { return is_sum_ ? a + b : std::max(a, b); }
  [[nodiscard]] const Walk& walk(std::size_t agent, std::size_t number) const {
    return walks_[agent][number];
  }
  /// `cost` and what all agents but these two, from `from` on, cost at least.
  [[nodiscard]] Cost with_others(Cost cost, std::size_t from, std::size_t i, std::size_t j) const {
    for (; from < least_.size(); ++from)
      if (from != i && from != j) cost = joined(cost, least_[from]);
    return cost;
  }
  /// kNoLimit: too late.
  [[nodiscard]] Cost arrival(const Differences& times, std::size_t agent, const Walk& walk,
                             const std::vector<std::size_t>& starts) const {
    if (starts.empty()) return 0;
    const Ticks tick = times.earliest(starts.back()) + walk.durations.back();
    return tick <= instance_.agent(AgentId(agent)).deadline.value_or(tick) ? as_cost(tick)
                                                                           : kNoLimit;
  }
  std::vector<std::size_t> append(Differences& times, std::size_t agent, const Walk& walk) const {
    const Ticks release = instance_.agent(AgentId(agent)).release;
    std::vector<std::size_t> starts;
    for (std::size_t k = 0; k < walk.edges.size(); ++k)
      starts.push_back(k == 0 ? times.append(0, release)
                              : times.append(starts.back(), walk.durations[k - 1]));
    for (std::size_t k = 1; k < walk.edges.size(); ++k)
      if (!instance_.roadmap().may_wait(walk.places[k]))
        static_cast<void>(times.ask(starts[k], starts[k - 1], -walk.durations[k - 1]));
    // At once, or not at all.
    if (instance_.agent(AgentId(agent)).under_way && !starts.empty())
      static_cast<void>(times.ask(starts.front(), 0, 0));
    return starts;
  }

  /// Adds the next agent, on each of its walks, past all before it in each way.
  void follow(const Partial& partial) {
    const std::size_t agent = partial.walks.size();
    if (agent == walks_.size()) return keep(partial);
    for (std::size_t w = 0; w < walks_[agent].size(); ++w) {
      const Cost least = joined(partial.cost, as_cost(walk(agent, w).total));
      if (with_others(least, agent + 1, agent, agent) >= limit_) continue;
      bool is_possible = true;
      for (std::size_t other = 0; other < agent && is_possible; ++other)
        is_possible = !passings(other, partial.walks[other], agent, w).empty();
      if (!is_possible) continue;
      Partial next = partial;
      next.walks.push_back(w);
      next.starts.push_back(append(next.times, agent, walk(agent, w)));
      avoid(next, obstacle_questions(agent, walk(agent, w)), 0);
    }
  }

  /// The agent added last keeps clear of the obstacles, in each way.
  void avoid(const Partial& partial, const std::vector<std::vector<Limit>>& questions,
             std::size_t question) {
    if (question == questions.size()) return pass(partial, 0);
    for (const Limit& limit : questions[question]) {
      Partial next = partial;
      const std::size_t start = next.starts.back()[limit.move];
      const bool is_possible = limit.is_least ? next.times.ask(0, start, limit.tick)
                                              : next.times.ask(start, 0, -limit.tick);
      if (is_possible) avoid(next, questions, question + 1);
    }
  }

  /// Each step of each obstacle against each move and each stay of the walk.
  [[nodiscard]] std::vector<std::vector<Limit>> obstacle_questions(std::size_t agent,
                                                                   const Walk& taken) const {
    std::vector<std::vector<Limit>> questions;
    const Agent& who = instance_.agent(AgentId(agent));
    const bool has_shapes = !who.shapes.empty();
    const bool leaves = instance_.agent(AgentId(agent)).leaves;
    const auto ask_stay = [&](std::size_t l, Ticks until, Ticks from) {
      // Gone by `until`, or not there before `from`.
      questions.emplace_back();
      if (l > 0 && from < kNever)
        questions.back().push_back({true, l - 1, from - taken.durations[l - 1]});
      if (l < taken.edges.size()) questions.back().push_back({false, l, until});
    };
    for (const MovingObstacle& obstacle : instance_.obstacles())
      for (const Element& step : steps_of(obstacle)) {
        const bool is_rest = step.from == step.to;
        for (std::size_t k = 0; k < taken.edges.size(); ++k) {
          const Edge& edge = instance_.roadmap().edge(taken.edges[k]);
          const Body& body = who.body_as(edge.shape);
          const Element move{instance_.roadmap().position(edge.from),
                             instance_.roadmap().position(edge.to), 0, taken.durations[k]};
          if (is_rest) {
            auto clear = clearance(move, body, step.from, obstacle.body);
            if (has_shapes) clear = without_ends(clear, move);
            if (!clear) continue;
            questions.push_back({{false, k, step.begin - clear->before_arrival}});
            if (step.end < kNever)
              questions.back().push_back({true, k, step.end + clear->after_leaving});
          } else {
            auto run = meeting_starts(step, obstacle.body, move, body);
            if (has_shapes) run = without_ends(run, step, move);
            if (run) questions.push_back({{true, k, run->last + 1}, {false, k, run->first - 1}});
          }
        }
        for (std::size_t l = 0; l < taken.places.size(); ++l) {
          if (l == taken.edges.size() && leaves) continue;  // no stay
          const Point& at = instance_.roadmap().position(taken.places[l]);
          const Body& body = who.body_as(instance_.roadmap().shape(taken.places[l]));
          if (!is_rest) {
            auto clear = clearance(step, obstacle.body, at, body);
            if (has_shapes) clear = without_ends(clear, step);
            if (clear)
              ask_stay(l, step.begin - clear->after_leaving, step.begin + clear->before_arrival);
          } else if (meet({at, at, 0, 1}, body, {step.from, step.from, 0, 1}, obstacle.body)) {
            ask_stay(l, step.begin, step.end);
          }
        }
      }
    return questions;
  }

  static std::vector<Element> steps_of(const MovingObstacle& obstacle) {
    std::vector<Element> steps;
    for (std::size_t k = 0; k < obstacle.path.size(); ++k) {
      const auto& stop = obstacle.path[k];
      const bool is_last = k + 1 == obstacle.path.size();
      const Ticks until = is_last && !obstacle.leaves ? kNever : stop.depart;
      if (until > stop.arrive) steps.push_back({stop.at, stop.at, stop.arrive, until});
      if (!is_last)
        steps.push_back(
            {stop.at, obstacle.path[k + 1].at, stop.depart, obstacle.path[k + 1].arrive});
    }
    return steps;
  }

  /// The agent added last passes `other` and those after it.
  void pass(const Partial& partial, std::size_t other) {
    const std::size_t agent = partial.walks.size() - 1;
    if (other == agent) {
      Partial next = partial;
      next.cost = cost_of(partial);
      if (with_others(next.cost, agent + 1, agent, agent) < limit_) follow(next);
      return;
    }
    const std::vector<Passing>& ways =
        passings(other, partial.walks[other], agent, partial.walks[agent]);
    for (const Passing& way : ways) {
      if (with_others(way.cost, 0, other, agent) >= limit_) continue;
      Partial next = partial;
      if (!ask(next.times, way.orders, next.starts[other], next.starts[agent])) continue;
      if (with_others(cost_of(next), agent + 1, agent, agent) < limit_) pass(next, other + 1);
    }
  }

  static bool ask(Differences& times, const Order& order, const std::vector<std::size_t>& first,
                  const std::vector<std::size_t>& second) {
    return order.second_waits ? times.ask(first[order.earlier], second[order.later], order.gap)
                              : times.ask(second[order.earlier], first[order.later], order.gap);
  }
  static bool ask(Differences& times, const std::vector<Order>& orders,
                  const std::vector<std::size_t>& first, const std::vector<std::size_t>& second) {
    return std::all_of(orders.begin(), orders.end(),
                       [&](const Order& order) { return ask(times, order, first, second); });
  }

  [[nodiscard]] Cost cost_of(const Partial& partial) const {
    Cost cost = 0;
    for (std::size_t i = 0; i < partial.walks.size(); ++i)
      cost = joined(cost, arrival(partial.times, i, walk(i, partial.walks[i]), partial.starts[i]));
    return cost;
  }

  /// All ways in which agent i, before j, and agent j can pass, as far as they may be cheap enough.
  const std::vector<Passing>& passings(std::size_t i, std::size_t walk_i, std::size_t j,
                                       std::size_t walk_j) {
    const auto [place, is_new] = passings_[i * walks_.size() + j].try_emplace({walk_i, walk_j});
    std::vector<Passing>& ways = place->second;
    if (!is_new) return ways;
    Differences times(walk(i, walk_i).edges.size() + walk(j, walk_j).edges.size() + 1);
    const std::vector<std::size_t> starts_i = append(times, i, walk(i, walk_i));
    const std::vector<std::size_t> starts_j = append(times, j, walk(j, walk_j));
    std::vector<Question> questions;
    ask_moves(i, walk(i, walk_i), j, walk(j, walk_j), questions);
    ask_stays(i, walk(i, walk_i), j, walk(j, walk_j), true, questions);
    ask_stays(j, walk(j, walk_j), i, walk(i, walk_i), false, questions);
    Passing way;
    const std::function<void(std::size_t, const Differences&)> answer =
        [&](std::size_t question, const Differences& known) {
          way.cost = joined(arrival(known, i, walk(i, walk_i), starts_i),
                            arrival(known, j, walk(j, walk_j), starts_j));
          if (with_others(way.cost, 0, i, j) >= limit_) return;
          if (question == questions.size()) return ways.push_back(way);
          for (const Order& order : questions[question]) {
            Differences next = known;
            if (!ask(next, order, starts_i, starts_j)) continue;
            way.orders.push_back(order);
            answer(question + 1, next);
            way.orders.pop_back();
          }
        };
    answer(0, times);
    return ways;
  }

  [[nodiscard]] ClassId class_of(std::size_t agent) const {
    return instance_.class_of(AgentId(agent));
  }

  void ask_moves(std::size_t i, const Walk& a, std::size_t j, const Walk& b,
                 std::vector<Question>& questions) {
    for (std::size_t k = 0; k < a.edges.size(); ++k)
      for (std::size_t l = 0; l < b.edges.size(); ++l)
        if (const auto& run = meetings_.moves(class_of(i), a.edges[k], class_of(j), b.edges[l]))
          questions.push_back({{true, k, l, run->last + 1}, {false, l, k, 1 - run->first}});
  }

  /// Moves of `mover` against stays of `stander`, the first one before its first move. The stander
  /// arrives in time after the move begins, or the move begins in time after it has left.
  void ask_stays(std::size_t mover, const Walk& moves, std::size_t stander, const Walk& stays,
                 bool stander_is_second, std::vector<Question>& questions) {
    for (std::size_t k = 0; k < moves.edges.size(); ++k)
      for (std::size_t l = 0; l < stays.places.size(); ++l) {
        if (l == stays.edges.size() && instance_.agent(AgentId(stander)).leaves) continue;
        const auto& clear =
            meetings_.stay(class_of(mover), moves.edges[k], class_of(stander), stays.places[l]);
        if (!clear) continue;
        questions.emplace_back();
        if (l > 0)
          questions.back().push_back(
              {stander_is_second, k, l - 1, clear->before_arrival - stays.durations[l - 1]});
        if (l < stays.edges.size())
          questions.back().push_back({!stander_is_second, l, k, clear->after_leaving});
      }
  }

  void keep(const Partial& found) {
    Plan plan;
    for (const AgentId i : instance_.agent_ids()) {
      const Walk& taken = walk(i.index(), found.walks[i.index()]);
      Path path{{taken.places.front(), 0, 0}};
      for (std::size_t k = 0; k < taken.edges.size(); ++k) {
        path.back().depart = found.times.earliest(found.starts[i.index()][k]);
        const Ticks arrive = path.back().depart + taken.durations[k];
        path.push_back({taken.places[k + 1], arrive, arrive});
      }
      plan.paths.push_back(path);
    }
    if (!result_.best || found.cost < *result_.best) {
      result_.best = found.cost;
      result_.best_plan = plan;
    }
    if (limit_ != kNoLimit) {
      limit_ = *result_.best;
    } else {
      result_.some_plans.push_back(plan);
      if (result_.some_plans.size() == kSomePlans) limit_ = 0;  // enough of that
    }
  }

  const Instance instance_;
  Meetings meetings_;
  const bool is_sum_;
  const std::size_t capacity_;
  std::vector<std::vector<Walk>> walks_;  // by agent
  std::vector<Cost> least_;               // by agent: of its shortest walk
  /// By two agents, by their walks.
  std::vector<std::map<std::pair<std::size_t, std::size_t>, std::vector<Passing>>> passings_;
  Cost limit_ = kNoLimit;  // plans that cost less are looked for
  OrderSearch result_;
};

}  // namespace

OrderSearch search_orders(const Instance& instance, Objective objective, std::size_t max_moves) {
  return Oracle(with_whole_places(instance), objective, max_moves).search();
}

std::vector<Plan> known_plans(const Instance& instance, std::size_t max_moves) {
  std::vector<Plan> plans;
  for (const Objective objective : {Objective::sum_of_costs, Objective::makespan}) {
    const OrderSearch found = search_orders(instance, objective, max_moves);
    plans.insert(plans.end(), found.some_plans.begin(), found.some_plans.end());
    if (found.best) plans.push_back(found.best_plan);
  }
  return plans;
}

}  // namespace quadrille::continuous::test
