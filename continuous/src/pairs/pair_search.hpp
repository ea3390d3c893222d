// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "pairs/box_grid.hpp"
#include "traffic/scene.hpp"

namespace quadrille::continuous {

/// Finds out how much more one of two agents has to cost while the other keeps a cap, whatever the
/// others do.
///
/// Paths within a cap are made of *elements*: moves along an edge that begin in some interval of
/// ticks. An element *matters* if its move, or the stay after it, or the stay before it, could
/// collide with something that the other agent could do within its cap. The search visits pairs of
/// elements that matter, those that the two agents began last, in the order of time. A step to the
/// next one of either agent is refused only if all moves and stays that the elements stand for
/// collide. So each pair of paths that do not collide is among what the search follows, and if it
/// does not reach the two ends there is no such pair.
///
/// A higher cap lengthens the intervals, which may allow a step. The search takes the steps in the
/// order of the caps that they need, and so finds the highest cap for which it fails.
class PairSearch {
 public:
  explicit PairSearch(Scene& scene);

  struct Party {
    AgentId agent;
    Ticks cap = 0;  ///< It arrives at this tick or earlier. At least its free cost.
    friend bool operator==(const Party&, const Party&) = default;
  };
  /// Some r in [0, max_raise + 1]: no plan has both cost(i) < i.cap + r and cost(j) <= j.cap.
  /// Tries at most about `max_steps` steps, fewer if the limits of the scene are met.
  [[nodiscard]] Ticks refuted_raise(const Party& i, const Party& j, Ticks max_raise,
                                    std::int64_t max_steps);

  /// Starts that are not the earliest are split into intervals of `width` ticks (at least 1), or of
  /// half the slack of the cap if that is less. Short ones refute more, and take longer.
  void set_width(Ticks width) noexcept { width_ = width; }
  /// Of the longest intervals of the last search; 0 if it was not made, as it would be too large.
  [[nodiscard]] Ticks width() const {
    return prepared_ ? std::max(width_of(sides_[0]), width_of(sides_[1])) : Ticks{0};
  }

  /// Bans that agent i (0) and agent j (1) obey; none at first.
  [[nodiscard]] BanTable& bans(std::size_t side) { return bans_[side]; }
  void swap_bans() { std::swap(bans_[0], bans_[1]); }

  /// Steps from one pair of elements to another that all searches have tried so far.
  [[nodiscard]] std::int64_t effort() const noexcept { return effort_; }
  /// How often searches have looked at where two moves, or a move and a stay, come near each other,
  /// before their first steps; it takes about a fourth of a step.
  [[nodiscard]] std::int64_t num_looks() const noexcept {
    return edge_grid_.num_looks() + place_grid_.num_looks();
  }

 private:
  /// A move that begins at a tick from `first` to `last`. The first element is the stay at the
  /// start, the second one says that nothing more matters, from the end of the last move on.
  struct Element {
    bool is_move = false;
    bool matters = false;
    bool stay_matters = false;  // the one after it; then all that can follow matters
    EdgeId edge;
    VertexId to;
    Ticks first = 0, last = 0;
    Ticks duration = 0;
    Ticks last_without_raise = 0;  // grows with the raise until it is `last`, or is larger
  };
  static constexpr std::uint32_t kStart = 0, kDone = 1;
  struct TimedEdge {
    EdgeId edge;
    Ticks first = 0, last = 0;     // starts, at the largest raise
    Ticks last_without_raise = 0;  // grows with the raise until it is `last`
    bool may_collide = false;      // with something that the other agent can do
    bool matters = false;          // that, or bans or a stay that matters make it matter
  };
  /// How an agent goes on from a vertex by edges that do not matter.
  struct Way {
    VertexId vertex;  // from which edges that matter go on
    Ticks ticks = 0;
  };
  struct Next {
    bool is_known = false;
    std::vector<Way> ways;
    Ticks done = kForever;  // how long it takes to the goal if nothing more matters
    // The last start that matters is `begin_by` or, if that is less, `begin_by_without_raise` and
    // the raise.
    Ticks begin_by = -1, begin_by_without_raise = -1;
  };
  /// The elements of one agent.
  struct Side {
    ClassId c;
    AgentId agent;
    BanTable* bans = nullptr;
    Ticks slack = 0;               // at the largest raise
    std::vector<TimedEdge> edges;  // in the order of their tails
    std::vector<Element> elements;
    std::vector<Next> next;  // by vertex
    Ticks cap = 0;           // without raise
    Ticks release = 0;       // before which it cannot set out to a goal elsewhere
    // By vertex:
    std::vector<Ticks> from_start;                    // kForever: not reached within the cap
    std::vector<std::uint32_t> first_edge, end_edge;  // that leave it
    std::vector<std::uint32_t> first_element, end_element;
    std::vector<char> stay_matters, may_matter_later;
    std::vector<VertexId> reached;
    std::vector<Ticks> distance;  // kForever between uses
  };
  /// What is known of the starts of a pair of elements: no earlier ones need to be considered.
  struct Starts {
    Ticks x = 0, y = 0;
  };
  /// The pairs reached. Open addressing; there is no need to take keys out.
  class Reached {
   public:
    void clear();
    /// Widens what is known of the pair. Whether that makes a difference.
    bool widen(std::uint64_t key, const Starts& starts);
    [[nodiscard]] const Starts& at(std::uint64_t key) const;

   private:
    struct Slot {
      std::uint64_t key;  // + 1; 0: none
      Starts starts;
    };
    [[nodiscard]] std::size_t find(std::uint64_t key) const;
    void grow();
    std::vector<Slot> slots_;
    std::size_t size_ = 0;
  };

  /// Edges and contacts of both, which do not depend on the bans, unless they are those of the last
  /// search. False: there is too much of it.
  bool prepare(const Party& i, const Party& j, Ticks max_raise);
  /// `raise`: of the cap of `party`; `other_raise`: of the other's. One of them is 0. False: there
  /// is too much of it.
  bool collect_edges(const Party& party, Ticks raise, const Party& other, Ticks other_raise,
                     Side& side);
  [[nodiscard]] Ticks leave_by(const Side& side, VertexId v) const;
  /// False: the limits of the scene were met.
  bool find_contacts(Side& x, Side& y);
  void fill_grids(const Side& y, Length reach);
  void make_elements(Side& side);
  /// Of the intervals.
  [[nodiscard]] Ticks width_of(const Side& side) const;
  /// Starts of `e` that obey the bans, as far as these depend on the one move.
  void list_allowed(const Side& side, const TimedEdge& e);
  [[nodiscard]] bool is_banned(BanTable& bans, EdgeId e) const;
  /// Whether the stay between the two moves breaks a ban.
  [[nodiscard]] static bool breaks_ban(const Side& side, const Element& from, const Element& to);
  [[nodiscard]] const Next& next_of(Side& side, VertexId v);
  /// What a next start at `tick` or later needs, or none that matters, after a start at `start`.
  [[nodiscard]] Ticks raise_to_wait(Side& side, const Element& element, Ticks start, Ticks tick);
  [[nodiscard]] static Ticks raise_for_done(const Side& side, const Element& element, Ticks start,
                                            const Next& next);
  /// Visits the pairs that follow when the agent of `x` begins its next move.
  void advance(Side& x, std::uint32_t at_x, Ticks start_x, Side& y, std::uint32_t at_y,
               Ticks start_y, bool is_first);
  /// What it takes to go on, and the earliest starts of `next` and of b's move after that.
  struct Step {
    Ticks raise = kForever;
    Ticks start = 0, other_start = 0;
  };
  /// The ways in which x can go from a to `next` while y has not gone beyond `b`: `next` is late,
  /// or b is.
  struct Steps {
    Step late, early;
  };
  [[nodiscard]] Steps steps(const Side& x, const Element& a, Ticks start_a, const Element& next,
                            Ticks first_s, Side& y, const Element& b, Ticks first_t);
  /// What it takes that a's move, which has ended, has not passed where b stands until then: b is
  /// late.
  [[nodiscard]] Ticks raise_to_pass(const Side& x, const Element& a, Ticks start_a, const Side& y,
                                    const Element& b);
  /// What `element` needs to end at `tick` or later.
  [[nodiscard]] static Ticks raise_for_end(const Element& element, Ticks tick);
  [[nodiscard]] Box box(VertexId v) const;
  [[nodiscard]] Contacts::Window window(ClassId a, EdgeId e, ClassId b, VertexId v, Length reach);

  Scene& scene_;
  BanTable bans_[2];
  std::vector<Box> boxes_;  // by edge; none before the first search
  BoxGrid edge_grid_;       // of one side's edges
  BoxGrid place_grid_;      // of the vertices that it reaches
  std::vector<Box> listed_;
  struct Prepared {
    Party i, j;
    Ticks max_raise = 0;
    friend bool operator==(const Prepared&, const Prepared&) = default;
  };
  std::optional<Prepared> prepared_;  // whom the sides' edges and contacts are about
  std::vector<TickInterval> forbidden_, allowed_;
  Side sides_[2];
  Reached reached_;
  struct Open {
    Ticks time;
    std::uint64_t pair;
  };
  struct Pending {
    Ticks raise;
    std::uint64_t pair;
    Starts starts;
  };
  static bool is_later(const Open& a, const Open& b);
  void reach(std::uint64_t pair, const Starts& starts);
  static bool costs_more(const Pending& a, const Pending& b);
  /// Goes on with the least raise that is pending. False: there is none.
  bool next_raise();

  Ticks width_ = kForever;        // of intervals at most
  Ticks max_raise_ = 0;           // or what reaches both ends
  Ticks raise_ = 0;               // up to which steps have been taken
  std::vector<Open> open_;        // a heap, the earliest first: to be visited
  std::vector<Pending> pending_;  // a heap, the least raise first: to be visited later
  std::vector<std::uint32_t> stack_;
  std::int64_t effort_ = 0;
};

}  // namespace quadrille::continuous
