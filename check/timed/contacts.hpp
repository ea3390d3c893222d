// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <unordered_map>
#include <utility>
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
  /// Calls visit(is_stay, place, stretch) for all that is known of the edge, in any order.
  template <class Visit>
  void visit(int agent, int edge, int other, const Visit& visit) const {
    for (const bool is_stay : {false, true})
      if (const Places* const places = of(agent, edge, other, is_stay))
        for (const auto& [place, stretch] : *places) visit(is_stay, place, stretch);
  }

 private:
  using Places = std::unordered_map<int, Stretch>;
  [[nodiscard]] static Int key(int edge, bool is_stay) { return 2 * Int{edge} + (is_stay ? 1 : 0); }
  [[nodiscard]] const Places* of(int agent, int edge, int other, bool is_stay) const;
  [[nodiscard]] int like(int agent) const { return likes_[static_cast<std::size_t>(agent)]; }

  const Road& road_;
  std::vector<int> likes_;  // by agent: the first one with the same body and durations
  std::map<std::pair<int, int>, std::unordered_map<Int, Places>> known_;  // by likes, edge and kind
};

}  // namespace quadrille_check
