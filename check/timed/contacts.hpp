// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "timed/bans.hpp"

namespace quadrille_check {

/// What the file says of when agents meet, checked: record m.
class TimedContacts {
 public:
  explicit TimedContacts(const Road& road);  ///< Which outlives it.

  /// agent edge other kind place begin end: who is like `agent`, and sets out along the edge, meets
  /// all that are like `other` and break the ban, whose times count from there. Throws Rejected.
  void add(const Record& record);
  struct Stretch {
    Int begin = 0, end = 0;
  };
  /// Nothing: none is known.
  [[nodiscard]] std::optional<Stretch> find(int agent, int edge, int other, bool is_stay,
                                            int place) const;
  /// Calls visit(is_stay, place, stretch) for all that is known of the edge.
  template <class Visit>
  void visit(int agent, int edge, int other, const Visit& visit) const {
    const int a = like(agent), b = like(other);
    for (auto at = known_.lower_bound({a, edge, b, false, 0}); at != known_.end(); ++at) {
      const auto& [mover, along, another, is_stay, place] = at->first;
      if (mover != a || along != edge || another != b) return;
      visit(is_stay, place, at->second);
    }
  }

 private:
  [[nodiscard]] int like(int agent) const { return likes_[static_cast<std::size_t>(agent)]; }

  const Road& road_;
  std::vector<int> likes_;  // by agent: the first one with the same body and durations
  std::map<std::tuple<int, int, int, bool, int>, Stretch> known_;
};

}  // namespace quadrille_check
