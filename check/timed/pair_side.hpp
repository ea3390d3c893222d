// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "timed/contacts.hpp"
#include "timed/paths.hpp"

namespace quadrille_check {

/// From `low` to `high`, both included.
struct Range {
  Int low = -kNever, high = kNever;
  void at_least(Int value) { low = std::max(low, value); }
  void at_most(Int value) { high = std::min(high, value); }
  [[nodiscard]] bool is_empty() const { return low > high; }
  [[nodiscard]] bool contains(const Range& other) const {
    return low <= other.low && other.high <= high;
  }
};

/// What is asked of one agent.
struct TimedParty {
  int agent = 0;
  Int most = 0;  ///< It is at its goal for good by then.
  std::vector<const TimedBan*> bans;
};

/// What one of two agents can do, as far as it matters to the other one. Moves that keep all bans,
/// and that, like the stays before and after them, meet nothing that the other one can do, do not.
class PairSide {
 public:
  /// Moves that matter along an edge, begun within a range: they break no ban by themselves, and of
  /// each ban of stays at their ends all are before, or all after. Or the stay at the start.
  struct Element {
    int edge = -1;  ///< -1: the start.
    int from = 0, to = 0;
    Int duration = 0;
    Range starts;
  };
  /// How the agent goes on by moves that do not matter.
  struct Ways {
    std::map<int, Int> ticks;  ///< To vertices from which moves that matter go on.
    std::optional<Int> done;   ///< To the goal.
  };

  /// All outlive it.
  PairSide(const Road& road, const TimedContacts& contacts, TimedPaths& paths,
           const TimedParty& party, const TimedParty& other);
  /// To be called for both sides, once each, before all else: what of the two meets.
  void meet(PairSide& other);
  /// To be called after that.
  void make_elements();

  /// Whether it may not even be where it starts.
  [[nodiscard]] bool is_blocked() const;
  [[nodiscard]] int agent() const { return party_.agent; }
  /// The first one is the start.
  [[nodiscard]] const std::vector<Element>& elements() const { return elements_; }
  [[nodiscard]] const std::vector<std::size_t>& leaving(int vertex) { return leaving_[vertex]; }
  [[nodiscard]] const Ways& ways(int vertex);
  /// Whether the agent is gone once it has come there.
  [[nodiscard]] bool is_gone(const Element& last) const {
    return task().leaves && last.to == task().goal;
  }
  [[nodiscard]] bool does_stay_matter(int vertex) const { return stays_.count(vertex) != 0; }
  /// Whether the stay between the two breaks a ban.
  [[nodiscard]] bool breaks_ban(const Element& before, const Element& after) const;
  /// The last start of a last element that matters after which it is at its goal in time; nothing:
  /// there is none.
  [[nodiscard]] std::optional<Int> last_start(const Element& last);

 private:
  struct Move {
    int edge = 0, from = 0, to = 0;
    Int duration = 0;
    Range starts;
    bool matters = false;
  };
  [[nodiscard]] const Road::Agent& task() const {
    return road_.agents[static_cast<std::size_t>(party_.agent)];
  }
  void add_elements(const Move& move);
  [[nodiscard]] Int leave_by(int vertex) const;

  const Road& road_;
  const TimedContacts& contacts_;
  const TimedParty& party_;
  std::map<int, std::vector<TimedBan>> banned_starts_, banned_stays_;
  std::map<int, Int> arrivals_;  // the earliest, by vertex
  std::vector<Move> moves_;
  std::map<int, std::size_t> move_along_;               // by edge
  std::map<int, std::vector<std::size_t>> moves_from_;  // by vertex
  std::set<int> stays_;                                 // that matter
  std::vector<Element> elements_;
  std::map<int, std::vector<std::size_t>> leaving_;  // elements, by vertex
  std::map<int, Ways> ways_;
};

}  // namespace quadrille_check
