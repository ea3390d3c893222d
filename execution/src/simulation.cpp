// SPDX-License-Identifier: MIT
#include "quadrille/execution/simulation.hpp"

#include <algorithm>
#include <cmath>

#include "quadrille/core/contract.hpp"
#include "quadrille/core/random.hpp"
#include "quadrille/execution/executor.hpp"

namespace quadrille::execution {
namespace {

constexpr std::int64_t kFullSpeed = 1'000'000;
constexpr Rule kRules[] = {Rule::naive, Rule::gated, Rule::coupled};

std::int64_t draw_up_to(Random& random, std::int64_t most) {
  return static_cast<std::int64_t>(random.below(static_cast<std::uint64_t>(most) + 1));
}

class Simulation {
 public:
  Simulation(const Precedences& order, const Delays& delays, Rule rule, Ticks period)
      : order_(order), delays_(delays), rule_(rule), period_(period), executor_(order) {
    const std::size_t count = order.num_agents();
    clocks_.assign(count, order.now);
    targets_.assign(count, order.now);
    wanted_.assign(count, order.now);
    agents_.resize(count);
    result_.now = order.now;
    result_.finish.assign(count, order.now);
    result_.held.assign(count, 0);
  }

  SimulationResult run(const Watch& watch) {
    bool goes_on = true;
    for (Ticks now = order_.now + period_; goes_on; now += period_) {
      goes_on = false;
      for (const AgentId agent : IdRange<AgentId>(agents_.size())) ask(agent, goes_on);
      targets_ = wanted_;
      if (rule_ == Rule::gated) executor_.gate(clocks_, targets_);
      if (rule_ == Rule::coupled) executor_.couple(clocks_, targets_);
      for (const AgentId agent : IdRange<AgentId>(agents_.size())) settle(agent, now, goes_on);
      if (watch) watch(clocks_, targets_);
      clocks_.swap(targets_);
    }
    result_.all_arrived = true;
    for (const AgentId agent : IdRange<AgentId>(agents_.size()))
      if (clocks_[agent.index()] < order_.end(agent)) result_.all_arrived = false;
    return std::move(result_);
  }

 private:
  struct State {
    std::size_t next_pause = 0;
    Ticks pause = 0;            // What is left of it.
    std::int64_t fraction = 0;  // Of a tick, in millionths, that was gone before.
  };

  /// How far the agent would go by itself. One that may do so later keeps the simulation going.
  void ask(AgentId agent, bool& goes_on) {
    State& state = agents_[agent.index()];
    const AgentDelay& delay = delays_[agent];
    const Ticks clock = clocks_[agent.index()], end = order_.end(agent);
    Ticks& wanted = wanted_[agent.index()];
    wanted = clock;
    if (clock >= end) return;
    if (state.pause == 0 && state.next_pause < delay.pauses.size() &&
        delay.pauses[state.next_pause].clock <= clock)
      state.pause = delay.pauses[state.next_pause++].duration;
    if (state.pause > 0) {
      state.pause = std::max(Ticks{0}, state.pause - period_);
      goes_on = true;
      return;
    }
    const std::int64_t way = period_.value() * delay.speed + state.fraction;
    wanted = std::min(end, clock + Ticks(way / kFullSpeed));
    if (state.next_pause < delay.pauses.size())
      wanted = std::min(wanted, delay.pauses[state.next_pause].clock);
    if (wanted == clock) {  // Too slow for a tick in this period.
      state.fraction = way;
      goes_on = true;
    }
  }

  void settle(AgentId agent, Ticks now, bool& goes_on) {
    const std::size_t i = agent.index();
    if (targets_[i] > clocks_[i]) {
      goes_on = true;
      const std::int64_t way = period_.value() * delays_[agent].speed + agents_[i].fraction;
      agents_[i].fraction =
          targets_[i] == clocks_[i] + Ticks(way / kFullSpeed) ? way % kFullSpeed : 0;
      if (targets_[i] >= order_.end(agent)) result_.finish[agent] = now;
    }
    if (targets_[i] < wanted_[i])
      result_.held[agent] +=
          Ticks((wanted_[i] - targets_[i]).value() * kFullSpeed / delays_[agent].speed);
  }

  const Precedences& order_;
  const Delays& delays_;
  Rule rule_;
  Ticks period_;
  Executor executor_;
  std::vector<Ticks> clocks_, targets_, wanted_;
  std::vector<State> agents_;
  SimulationResult result_;
};

}  // namespace

std::string_view to_string(Rule rule) noexcept {
  switch (rule) {
    case Rule::naive:
      return "naive";
    case Rule::gated:
      return "gated";
    case Rule::coupled:
      break;
  }
  return "coupled";
}

std::optional<Rule> parse_rule(std::string_view text) noexcept {
  for (const Rule rule : kRules)
    if (to_string(rule) == text) return rule;
  return std::nullopt;
}

Delays draw_delays(const Precedences& order, const DelayOptions& options, std::uint64_t seed) {
  QUADRILLE_REQUIRE(options.pause_chance >= 0 && options.pause_chance <= 1 &&
                        options.longest_pause >= 1 && options.slowness >= 0 &&
                        options.slowness <= 0.95,
                    "delays in their ranges");
  Random random(seed);
  Delays delays;
  const std::int64_t slowest = std::llround(options.slowness * static_cast<double>(kFullSpeed));
  for (const auto& moves : order.moves) {
    AgentDelay delay;
    delay.speed = kFullSpeed - draw_up_to(random, slowest);
    bool goes_on = false;  // From the move before.
    for (const TimedMove& move : moves) {
      // All are drawn, so that the same seed means the same with another chance.
      const bool pauses = random.chance(options.pause_chance);
      Ticks clock = move.begin + Ticks(draw_up_to(random, (move.end - move.begin).value() - 1));
      // Nobody stops where nobody may wait, but on the way there or behind it.
      if (goes_on && clock == move.begin && move.end - move.begin > 1) clock += 1;
      goes_on = move.goes_on;
      const Ticks duration(1 + draw_up_to(random, options.longest_pause.value() - 1));
      if (pauses) delay.pauses.push_back({clock, duration});
    }
    delays.push_back(std::move(delay));
  }
  return delays;
}

Ticks SimulationResult::makespan() const {
  Ticks latest = now;
  for (const Ticks tick : finish) latest = std::max(latest, tick);
  return latest - now;
}

Ticks SimulationResult::sum_of_costs() const {
  Ticks sum = 0;
  for (const Ticks tick : finish) sum += tick - now;
  return sum;
}

SimulationResult simulate(const Precedences& order, const Delays& delays, Rule rule, Ticks period,
                          const Watch& watch) {
  QUADRILLE_REQUIRE(delays.size() == order.num_agents(), "one delay per agent");
  QUADRILLE_REQUIRE(period >= 1, "a period of a tick or more");
  return Simulation(order, delays, rule, period).run(watch);
}

}  // namespace quadrille::execution
