// SPDX-License-Identifier: MIT
#include "timed/paths.hpp"

#include <algorithm>
#include <functional>
#include <queue>

namespace quadrille_check {
namespace {

/// A stay that keeps all bans, ends included, as does each that is part of it.
struct SafeStay {
  Int from = 0, until = kNever;
  Int reached = kNever;  ///< The earliest arrival so far.
};

/// The bans of one agent, by place.
class Bans {
 public:
  explicit Bans(std::span<const TimedBan* const> bans) {
    for (const TimedBan* ban : bans) (ban->is_stay ? stays_ : starts_)[ban->place].push_back(*ban);
    for (auto& [edge, list] : starts_)
      std::sort(list.begin(), list.end(),
                [](const TimedBan& a, const TimedBan& b) { return a.begin < b.begin; });
  }

  /// The longest ones. A stay is contained in the one that begins where the last ban ended that is
  /// over when it begins, or at 0: both go on until the first ban begins that is not over.
  [[nodiscard]] std::vector<SafeStay>& stays(int vertex) {
    const auto [known, is_new] = safe_.try_emplace(vertex);
    std::vector<SafeStay>& safe = known->second;
    if (!is_new) return safe;
    std::vector<TimedBan> bans;
    if (const auto at = stays_.find(vertex); at != stays_.end()) bans = at->second;
    std::sort(bans.begin(), bans.end(),
              [](const TimedBan& a, const TimedBan& b) { return a.end > b.end; });
    // Of those that end after it, the first one begins at `until`.
    Int until = kNever;
    const auto add = [&](Int from) {
      if (until >= from) safe.push_back({from, until, kNever});
    };
    for (std::size_t k = 0; k < bans.size() && bans[k].end > 0; ++k) {
      if (bans[k].end < kNever && (k == 0 || bans[k - 1].end > bans[k].end)) add(bans[k].end);
      until = std::min(until, bans[k].begin);
    }
    add(0);
    std::reverse(safe.begin(), safe.end());
    return safe;
  }

  /// The first tick from `from` on at which it may set out.
  [[nodiscard]] Int first_start(int edge, Int from) const {
    const auto bans = starts_.find(edge);
    if (bans == starts_.end()) return from;
    for (const TimedBan& ban : bans->second)
      if (ban.begin <= from && from < ban.end) from = ban.end;
    return from;
  }

 private:
  std::map<int, std::vector<TimedBan>> starts_, stays_;
  std::map<int, std::vector<SafeStay>> safe_;
};

}  // namespace

TimedPaths::TimedPaths(const Road& road) : road_(road) {}

TimedPaths::Table TimedPaths::distances(int agent) {
  const Road::Agent& task = road_.agents[static_cast<std::size_t>(agent)];
  Table& known = known_[{task.goal, task.durations, task.group}];
  if (known) return known;
  std::vector<Int> distances(road_.points.size(), kNever);
  using Entry = std::pair<Int, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  distances[static_cast<std::size_t>(task.goal)] = 0;
  queue.emplace(0, task.goal);
  while (!queue.empty()) {
    const auto [distance, vertex] = queue.top();
    queue.pop();
    if (distance > distances[static_cast<std::size_t>(vertex)]) continue;
    for (const int edge : road_.in[static_cast<std::size_t>(vertex)]) {
      if (!road_.may_use(agent, edge)) continue;
      const int from = road_.edges[static_cast<std::size_t>(edge)].from;
      const Int longer = distance + road_.duration(agent, edge);
      if (longer >= distances[static_cast<std::size_t>(from)]) continue;
      distances[static_cast<std::size_t>(from)] = longer;
      queue.emplace(longer, from);
    }
  }
  return known = std::make_shared<const std::vector<Int>>(std::move(distances));
}

// Of each safe stay only the earliest arrival counts: who is there earlier can wait, and do all
// that can be done later (Phillips and Likhachev, "SIPP", ICRA 2011). Places from which the way to
// the goal is too long are left out.
std::optional<Int> TimedPaths::arrival(int agent, std::span<const TimedBan* const> bans, Int most) {
  const Road::Agent& task = road_.agents[static_cast<std::size_t>(agent)];
  most = std::min(most, task.deadline);
  const Table rest = distances(agent);
  Bans all(bans);
  struct Entry {
    Int time;
    int vertex;
    std::size_t stay;
    bool operator>(const Entry& other) const { return time > other.time; }
  };
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const auto reach = [&](int vertex, std::size_t stay, Int time) {
    SafeStay& there = all.stays(vertex)[stay];
    const Int left = (*rest)[static_cast<std::size_t>(vertex)];
    if (left >= kNever || time > most || left > most - time || time >= there.reached) return;
    there.reached = time;
    queue.push({time, vertex, stay});
  };
  const auto& at_start = all.stays(task.start);
  if (!at_start.empty() && at_start.front().from == 0) reach(task.start, 0, 0);
  while (!queue.empty()) {
    const auto [time, vertex, stay] = queue.top();
    queue.pop();
    const SafeStay here = all.stays(vertex)[stay];
    if (time > here.reached) continue;
    if (vertex == task.goal && (here.until == kNever || task.leaves)) return time;
    for (const int edge : road_.out[static_cast<std::size_t>(vertex)]) {
      if (!road_.may_use(agent, edge)) continue;
      const Int duration = road_.duration(agent, edge);
      const int to = road_.edges[static_cast<std::size_t>(edge)].to;
      const auto& there = all.stays(to);
      for (std::size_t k = 0; k < there.size(); ++k) {
        const Int begin =
            all.first_start(edge, std::max({time, task.release, there[k].from - duration}));
        if (task.under_way && vertex == task.start && begin > 0) continue;
        if (begin <= here.until && begin < kNever && begin + duration <= there[k].until)
          reach(to, k, begin + duration);
      }
    }
  }
  return std::nullopt;
}

}  // namespace quadrille_check
