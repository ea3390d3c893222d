// SPDX-License-Identifier: MIT
#include "timed/pair_side.hpp"

#include <functional>
#include <queue>
#include <utility>

namespace quadrille_check {
namespace {

using Entry = std::pair<Int, int>;
using Queue = std::priority_queue<Entry, std::vector<Entry>, std::greater<>>;

bool is_banned(const std::map<int, std::vector<TimedBan>>& bans, int place) {
  return bans.count(place) != 0;
}

}  // namespace

// Moves that are on some way from start to goal in time. From when the other one is at its goal for
// good none touches that.
PairSide::PairSide(const Road& road, const TimedContacts& contacts, TimedPaths& paths,
                   const TimedParty& party, const TimedParty& other)
    : road_(road), contacts_(contacts), party_(party) {
  const Road::Agent& resident = road_.agents[static_cast<std::size_t>(other.agent)];
  for (const TimedBan* ban : party.bans)
    (ban->is_stay ? banned_stays_ : banned_starts_)[ban->place].push_back(*ban);
  const auto rest = paths.distances(party.agent);
  Queue queue;
  const auto visit = [&](int vertex, Int time) {
    const auto [at, is_new] = arrivals_.try_emplace(vertex, time);
    if (!is_new && at->second <= time) return;
    at->second = time;
    queue.emplace(time, vertex);
  };
  visit(task().start, task().release);
  while (!queue.empty()) {
    const auto [time, vertex] = queue.top();
    queue.pop();
    if (time > arrivals_[vertex] || (vertex == task().goal && task().leaves)) continue;
    for (const int edge : road_.out[static_cast<std::size_t>(vertex)]) {
      const int to = road_.edges[static_cast<std::size_t>(edge)].to;
      const Int left = (*rest)[static_cast<std::size_t>(to)];
      if (!road_.may_use(party.agent, edge) || left >= kNever) continue;
      const Int duration = road_.duration(party.agent, edge);
      Move move{edge, vertex, to, duration, {time, party.most - duration - left}, false};
      if (task().under_way && vertex == task().start) move.starts.at_most(0);
      if (!resident.leaves)
        if (const auto w = contacts_.find(party.agent, edge, other.agent, true, resident.goal))
          move.starts.at_most(other.most - w->end);
      if (move.starts.is_empty()) continue;
      moves_from_[vertex].push_back(moves_.size());
      move_along_[edge] = moves_.size();
      moves_.push_back(move);
      visit(to, time + duration);
    }
  }
  arrivals_[task().start] = 0;  // released late or not
}

bool PairSide::is_blocked() const {
  const auto bans = banned_stays_.find(task().start);
  return bans != banned_stays_.end() &&
         std::any_of(bans->second.begin(), bans->second.end(),
                     [](const TimedBan& ban) { return ban.begin < 0 && ban.end > 0; });
}

Int PairSide::leave_by(int vertex) const {
  if (vertex == task().goal) return task().leaves ? -kNever : kNever;
  Int last = -1;
  if (const auto from = moves_from_.find(vertex); from != moves_from_.end())
    for (const std::size_t k : from->second) last = std::max(last, moves_[k].starts.high);
  return last;
}

void PairSide::meet(PairSide& other) {
  for (Move& move : moves_)
    contacts_.visit(
        agent(), move.edge, other.agent(),
        [&](bool is_stay, int place, const TimedContacts::Stretch& when) {
          const Range& own = move.starts;
          if (is_stay) {
            const auto at = other.arrivals_.find(place);
            if (at == other.arrivals_.end() || at->second >= own.high + when.end ||
                other.leave_by(place) <= own.low + when.begin)
              return;
            other.stays_.insert(place);
          } else {
            const auto at = other.move_along_.find(place);
            if (at == other.move_along_.end()) return;
            Move& met = other.moves_[at->second];
            if (met.starts.low - own.high >= when.end || met.starts.high - own.low < when.begin)
              return;
            met.matters = true;
          }
          move.matters = true;
        });
}

void PairSide::make_elements() {
  elements_.push_back({-1, 0, task().start, 0, {0, 0}});
  for (Move& move : moves_) {
    move.matters = move.matters || does_stay_matter(move.from) || does_stay_matter(move.to) ||
                   is_banned(banned_starts_, move.edge) || is_banned(banned_stays_, move.from) ||
                   is_banned(banned_stays_, move.to) ||
                   (task().under_way && move.from == task().start);
    if (move.matters) add_elements(move);
  }
}

// A stay that is there strictly between a ban's ends breaks it: so does who sets out then, or
// arrives. Between a ban's ends the range is cut even if there is no tick.
void PairSide::add_elements(const Move& move) {
  std::vector<std::pair<Int, Int>> forbidden;
  const auto forbid = [&](const std::map<int, std::vector<TimedBan>>& bans, int place, Int inner,
                          Int after) {
    if (const auto at = bans.find(place); at != bans.end())
      for (const TimedBan& ban : at->second)
        forbidden.emplace_back(ban.begin + inner - after, ban.end - after);
  };
  forbid(banned_starts_, move.edge, 0, 0);
  forbid(banned_stays_, move.from, 1, 0);
  forbid(banned_stays_, move.to, 1, move.duration);
  std::sort(forbidden.begin(), forbidden.end());
  const auto add = [&](Int low, Int high) {
    if (low > high) return;
    leaving_[move.from].push_back(elements_.size());
    elements_.push_back({move.edge, move.from, move.to, move.duration, {low, high}});
  };
  Int from = move.starts.low;
  for (const auto& [begin, end] : forbidden) {
    add(from, std::min(begin - 1, move.starts.high));
    from = std::max({from, end, std::min(begin, move.starts.high + 1)});
  }
  add(from, move.starts.high);
}

bool PairSide::breaks_ban(const Element& before, const Element& after) const {
  const auto bans = banned_stays_.find(before.to);
  return bans != banned_stays_.end() &&
         std::any_of(bans->second.begin(), bans->second.end(), [&](const TimedBan& ban) {
           return before.starts.high + before.duration <= ban.begin && after.starts.low >= ban.end;
         });
}

// Waiting on the way is free: all stays there keep all bans, and meet nothing.
const PairSide::Ways& PairSide::ways(int vertex) {
  const auto [known, is_new] = ways_.try_emplace(vertex);
  Ways& ways = known->second;
  if (!is_new) return ways;
  std::map<int, Int> reached{{vertex, 0}};
  Queue queue;
  queue.emplace(0, vertex);
  while (!queue.empty()) {
    const auto [ticks, at] = queue.top();
    queue.pop();
    if (ticks > reached[at]) continue;
    if (at == task().goal && !ways.done) ways.done = ticks;
    if (leaving_.count(at) != 0) ways.ticks[at] = ticks;
    for (const std::size_t k : moves_from_[at]) {
      const Move& move = moves_[k];
      if (move.matters || arrivals_[vertex] + ticks > move.starts.high) continue;
      const Int longer = ticks + move.duration;
      const auto [there, is_first] = reached.try_emplace(move.to, longer);
      if (!is_first && there->second <= longer) continue;
      there->second = longer;
      queue.emplace(longer, move.to);
    }
  }
  return ways;
}

std::optional<Int> PairSide::last_start(const Element& last) {
  const Ways& onward = ways(last.to);
  if (!onward.done) return std::nullopt;
  const auto bans = banned_stays_.find(task().goal);
  if (last.to == task().goal && !task().leaves && bans != banned_stays_.end())
    for (const TimedBan& ban : bans->second)
      if (ban.end > last.starts.low + last.duration) return std::nullopt;
  const Int wait = last.edge < 0 && *onward.done > 0 ? task().release : 0;
  return party_.most - last.duration - *onward.done - wait;
}

}  // namespace quadrille_check
