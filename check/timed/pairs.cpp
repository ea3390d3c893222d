// SPDX-License-Identifier: MIT
// Rule 14: a search of two agents at once, which knows for each two moves all starts that the two
// can have, as ranges of both and of their difference. docs/certificates.md has the proof.
#include "timed/pairs.hpp"

#include <functional>
#include <queue>
#include <unordered_map>
#include <utility>

namespace quadrille_check {
namespace {

using Element = PairSide::Element;
using Stretch = std::optional<TimedContacts::Stretch>;

/// Of looks at what is known: some seconds.
constexpr std::size_t kMostLooks = 100'000'000;

/// The starts of two elements, and how much later the first one's is.
struct Zone {
  Range x, y, later;
  [[nodiscard]] Zone swapped() const { return {y, x, {-later.high, -later.low}}; }
  [[nodiscard]] bool contains(const Zone& other) const {
    return x.contains(other.x) && y.contains(other.y) && later.contains(other.later);
  }
  /// Makes each range as small as the others allow. False: there are no such starts.
  bool tighten() {
    x.at_least(y.low + later.low);
    x.at_most(y.high + later.high);
    y.at_least(x.low - later.high);
    y.at_most(x.high - later.low);
    later.at_least(x.low - y.high);
    later.at_most(x.high - y.low);
    return !x.is_empty() && !y.is_empty() && !later.is_empty();
  }
};

class PairSearch {
 public:
  PairSearch(const TimedContacts& contacts, PairSide& first, PairSide& second)
      : contacts_(contacts), sides_{&first, &second} {}

  /// Whether it does not come to two last elements.
  bool fails() {
    reach(0, 0, {{0, 0}, {0, 0}, {0, 0}});
    while (!open_.empty() && !has_plan_ && looks_ <= kMostLooks) {
      const Open now = open_.top();
      open_.pop();
      advance(0, now.first, now.second, now.zone);
      advance(1, now.second, now.first, now.zone.swapped());
    }
    return open_.empty() && !has_plan_;
  }

 private:
  struct Open {
    Int time;
    std::size_t first, second;
    Zone zone;
    bool operator>(const Open& other) const { return time > other.time; }
  };
  void reach(std::size_t first, std::size_t second, const Zone& zone);
  void advance(std::size_t side, std::size_t at_x, std::size_t at_y, const Zone& zone);
  void step(std::size_t side, std::size_t at_x, std::size_t to, Int ticks, std::size_t at_y,
            const Zone& zone);
  [[nodiscard]] std::optional<Int> passes_by(const PairSide& x, const Element& a, const PairSide& y,
                                             const Element& b) const;

  const TimedContacts& contacts_;
  PairSide* sides_[2];
  std::unordered_map<std::size_t, std::vector<Zone>> reached_;  // by both elements
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open_;
  bool has_plan_ = false;
  std::size_t looks_ = 0;
};

void PairSearch::reach(std::size_t first, std::size_t second, const Zone& zone) {
  std::vector<Zone>& known = reached_[first * sides_[1]->elements().size() + second];
  looks_ += 1 + known.size();
  for (const Zone& other : known)
    if (other.contains(zone)) return;
  known.push_back(zone);
  open_.push({std::max(zone.x.low, zone.y.low), first, second, zone});
}

// How much later than a, at least, b has to begin if the stay after b, which goes on until a has
// ended, is to begin when a has passed it. (Where agents leave no stay matters.)
std::optional<Int> PairSearch::passes_by(const PairSide& x, const Element& a, const PairSide& y,
                                         const Element& b) const {
  if (a.edge < 0 || !y.does_stay_matter(b.to)) return std::nullopt;
  const auto w = contacts_.find(x.agent(), a.edge, y.agent(), true, b.to);
  if (!w || w->begin >= a.duration) return std::nullopt;
  return w->end - b.duration;
}

// All that can follow when x begins its next move, or both go on to their goals.
void PairSearch::advance(std::size_t side, std::size_t at_x, std::size_t at_y, const Zone& zone) {
  PairSide &x = *sides_[side], &y = *sides_[1 - side];
  const Element &a = x.elements()[at_x], &b = y.elements()[at_y];
  Zone clear = zone;
  if (const auto least = passes_by(x, a, y, b)) clear.later.at_most(-*least);
  if (!clear.tighten()) return;
  const auto last_x = x.last_start(a), last_y = y.last_start(b);
  if (last_x && last_y) {
    Zone ended = clear;
    ended.x.at_most(*last_x);
    ended.y.at_most(*last_y);
    if (const auto least = passes_by(y, b, x, a)) ended.later.at_least(*least);
    has_plan_ = has_plan_ || ended.tighten();
  }
  if (x.is_gone(a)) return;
  for (const auto& [vertex, ticks] : x.ways(a.to).ticks)
    for (const std::size_t next : x.leaving(vertex)) step(side, at_x, next, ticks, at_y, clear);
}

// The stay of x before its next move, and the move that y is on; the next move, and that one: each
// is before the other, or after it.
void PairSearch::step(std::size_t side, std::size_t at_x, std::size_t to, Int ticks,
                      std::size_t at_y, const Zone& zone) {
  const PairSide &x = *sides_[side], &y = *sides_[1 - side];
  const Element &a = x.elements()[at_x], &b = y.elements()[at_y], &n = x.elements()[to];
  if (ticks == 0 && x.breaks_ban(a, n)) return;
  Stretch stay, moves;
  if (b.edge >= 0) {
    if (ticks == 0) stay = contacts_.find(y.agent(), b.edge, x.agent(), true, a.to);
    moves = contacts_.find(x.agent(), n.edge, y.agent(), false, b.edge);
  }
  for (const bool comes_late : {false, true})
    for (const bool goes_late : {false, true}) {
      if ((comes_late && !stay) || (goes_late && !moves)) continue;
      Zone before = zone;
      Range later{0, kNever};  // the next start of x, than that of y
      if (stay && comes_late) before.later.at_least(stay->end - a.duration);
      if (stay && !comes_late) later.at_most(stay->begin);
      if (moves && goes_late) later.at_least(1 - moves->begin);
      if (moves && !goes_late) later.at_most(-moves->end);
      if (!before.tighten()) continue;
      later.at_least(before.later.low + a.duration + ticks);
      Zone after{n.starts, before.y, later};
      after.x.at_least(before.x.low + a.duration + ticks);
      if (!after.tighten()) continue;
      if (side == 0)
        reach(to, at_y, after);
      else
        reach(at_y, to, after.swapped());
    }
}

}  // namespace

bool have_no_plan(const Road& road, const TimedContacts& contacts, TimedPaths& paths,
                  const TimedParty& first, const TimedParty& second) {
  PairSide x(road, contacts, paths, first, second), y(road, contacts, paths, second, first);
  if (x.is_blocked() || y.is_blocked()) return true;
  x.meet(y);
  y.meet(x);
  x.make_elements();
  y.make_elements();
  return PairSearch(contacts, x, y).fails();
}

}  // namespace quadrille_check
