// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/execution/precedences.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::execution {

/// By what agents that have been delayed go on.
enum class Rule {
  naive,    ///< By their own clocks, whatever the others do. Collides.
  gated,    ///< Executor::gate: whole moves, each after those that lead it have ended.
  coupled,  ///< Executor::couple: clocks with slack.
};
[[nodiscard]] std::string_view to_string(Rule rule) noexcept;  ///< "naive", "gated", "coupled"
[[nodiscard]] std::optional<Rule> parse_rule(std::string_view text) noexcept;

/// What holds up agents.
struct DelayOptions {
  double pause_chance = 0.1;  ///< Of a pause on each move; 0 .. 1.
  Ticks longest_pause = 1;    ///< At least 1; the shortest takes 1.
  double slowness = 0.15;     ///< Agents are slower than planned by up to this share; 0 .. 0.95.
};

/// What holds up one agent, whatever the others do.
struct AgentDelay {
  struct Pause {
    Ticks clock = 0;  ///< Where it happens: when the agent's clock comes to this time.
    Ticks duration = 0;
  };
  std::int64_t speed = 1'000'000;  ///< Millionths of the speed planned; 1 .. 10^6.
  std::vector<Pause> pauses;       ///< By clock.
};
using Delays = IdVector<AgentId, AgentDelay>;

/// Each agent's speed is drawn uniformly, and for each of its moves whether it pauses, when within
/// the move, and for how long; not where nobody may wait, if the move takes more than a tick. The
/// same on every platform. Requires options in their ranges.
[[nodiscard]] Delays draw_delays(const Precedences& order, const DelayOptions& options,
                                 std::uint64_t seed);

struct SimulationResult {
  bool all_arrived = false;         ///< If not, the others wait for each other for ever.
  Ticks now = 0;                    ///< When the plan begins.
  IdVector<AgentId, Ticks> finish;  ///< When it arrived; meaningless for one that did not.
  IdVector<AgentId, Ticks> held;    ///< How long it could have gone on and was not allowed to.
  /// From `now` on. Meaningful if all have arrived.
  [[nodiscard]] Ticks makespan() const;
  [[nodiscard]] Ticks sum_of_costs() const;
};

/// Called once for each period: the clocks before and after it. In between they run evenly.
using Watch = std::function<void(std::span<const Ticks> before, std::span<const Ticks> after)>;

/// Lets the agents of a plan go under a rule and delays. Every `period` ticks (at least 1) the rule
/// says how far each may go on within it; pauses begin and end with periods. `delays`: one per
/// agent. O(periods * agents), and what the executor takes.
[[nodiscard]] SimulationResult simulate(const Precedences& order, const Delays& delays, Rule rule,
                                        Ticks period, const Watch& watch = {});

}  // namespace quadrille::execution

QUADRILLE_API_END
