// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/execution/precedences.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::execution {

/// Says which agents may go on, whatever has held up whom. The caller keeps a clock per agent: the
/// time of the plan that the agent has got to, in ticks (rounded down) or timesteps, which begins
/// at Precedences::now and never goes back. An agent that has arrived keeps its clock at the end of
/// its last move, or later.
///
/// There are three rules, for three kinds of systems; all keep agents from colliding as long as no
/// clock passes what it was allowed:
/// - `limits`: agents that move on their own and report their clocks now and then, late or not at
///   all. Old clocks are safe. Where agents follow each other in a circle without any slack, all of
///   them wait for ever; `couple` is for those.
/// - `couple`: agents that take a step at the same time. Never ends with all of them waiting, of a
///   plan that `precedences` takes.
/// - `gate`: systems that release whole moves and cannot hold an agent back within one: a follower
///   begins its move when the leader has ended its own. All may wait for each other for ever unless
///   the order of moves has no cycle: see node_order.hpp.
///
/// Under all of them an agent begins a passage (TimedMove::goes_on) only when nothing is in its way
/// any more until its end, and is not held back within it.
///
/// Nothing is allocated after construction, nothing is thrown. One thread at a time. Time per call:
/// agents + precedences that matter now (times agents at worst, where many are coupled).
class Executor {
 public:
  /// The limit of an agent that nothing holds back.
  static constexpr Ticks kUnlimited{std::numeric_limits<std::int64_t>::max()};

  explicit Executor(const Precedences& precedences);

  [[nodiscard]] std::size_t num_agents() const noexcept { return first_.size(); }

  /// How far each clock may run as things stand, kUnlimited where nothing is in the way. Requires
  /// one clock, and room for one limit, per agent, by id.
  void limits(std::span<const Ticks> clocks, std::span<Ticks> limits);

  /// The clocks are exact. `targets`: in, the clocks that the agents would have at the end of this
  /// step, each at least as late as its clock now (an agent that is held up: its clock); out, the
  /// latest ones, none later than asked for, to which they may go *in proportion*: after a share of
  /// the step each has that share of its way behind it. If the targets ask for a step of at least
  /// one tick wherever an agent is not held up, those with the earliest clock get at least one
  /// unless they follow one that is, or are about to begin a passage.
  void couple(std::span<const Ticks> clocks, std::span<Ticks> targets);

  /// The same for whole moves: an agent whose next move follows one that has not ended stops before
  /// it.
  void gate(std::span<const Ticks> clocks, std::span<Ticks> targets);

  /// The clocks may begin anew.
  void reset();

 private:
  /// One precedence, as its follower sees it.
  struct Hold {
    Ticks begin;  // Of the follower's move, or of the passage that it is in.
    Ticks end;    // Of the follower's move.
    Ticks leader_end;
    Ticks slack;
    std::uint32_t leader, follower;
    bool is_in_passage;  // Of the follower.
  };
  [[nodiscard]] static bool is_over(const Hold& hold, Ticks leader) {
    return leader >= hold.leader_end || leader + hold.slack >= hold.end;
  }
  void skip_over(std::size_t agent, std::span<const Ticks> clocks);
  void check(std::span<const Ticks> clocks, std::span<const Ticks> out) const;

  std::vector<Hold> holds_;                      // By follower, then begin.
  std::vector<std::size_t> begin_, end_;         // Of each agent's holds.
  std::vector<std::size_t> first_, first_gate_;  // Those before are over, for `gate` the latter.
  std::vector<std::uint32_t> coupled_;           // Holds to look at in `couple`; never grows.
};

}  // namespace quadrille::execution

QUADRILLE_API_END
