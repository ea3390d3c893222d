// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "answers/delivery.hpp"
#include "answers/report.hpp"
#include "commands/executing.hpp"
#include "frame/arguments.hpp"
#include "frame/subcommands.hpp"
#include "quadrille/execution/simulation.hpp"

namespace quadrille::cli {
namespace {

using execution::Rule;

constexpr const char* kFooter =
    "Agents pause on some of their moves and are slower than planned; the same delays for each\n"
    "rule. naive: each goes by its own clock. gated: a move begins when those that lead it have\n"
    "ended. coupled: clocks with slack (docs/execution.md).\n"
    "\n"
    "Example:\n"
    "  quadrille simulate --instance discs.json --delays 0.2 --longest 3 --slow 0.1 plan.json\n"
    "\n";

constexpr std::int64_t kMaxRuns = 1'000'000;
constexpr double kMaxSlowness = 0.95;
/// Periods in the plan where none is given.
constexpr std::int64_t kPeriods = 500;

struct SimulateArguments {
  ExecutionArguments execution;
  std::optional<Rule> rule;
  std::optional<double> chance, longest, slowness, period;
  std::optional<std::int64_t> runs, seed;
  std::string view;
};

/// What became of all runs under one rule.
struct Tally {
  Rule rule;
  std::size_t runs = 0, colliding_runs = 0, colliding_pairs = 0, endless = 0;
  double makespan = 0, sum_of_costs = 0, held = 0;  // Of the runs that ended, in all.
  std::optional<double> clearance;

  [[nodiscard]] double mean(double sum) const {
    const std::size_t ended = runs - endless;
    return ended == 0 ? 0 : sum / static_cast<double>(ended);
  }
};

/// What the agents of one run do, for the page.
class RunRecorder {
 public:
  explicit RunRecorder(const ExecutionCase& c) : case_(c) {
    if (!c.page) return;
    for (std::size_t i = 0; i < c.starts.size(); ++i)
      recorder_.add(i, c.order.now.value() * c.page_ticks, c.position(c.starts[i]));
    time_ = c.order.now;
  }

  /// Clocks have run evenly from one time to the other, in so many ticks.
  void add(std::span<const Ticks> before, std::span<const Ticks> after, Ticks period) {
    for (std::size_t i = 0; i < before.size(); ++i) {
      const auto& moves = case_.order.moves[AgentId(i)];
      // Where they begin and end moves they may turn.
      for (const execution::TimedMove& move : moves)
        for (const Ticks at : {move.begin, move.end})
          if (before[i] < at && at < after[i]) {
            const double share = static_cast<double>((at - before[i]).value()) /
                                 static_cast<double>((after[i] - before[i]).value());
            add(i, at, share, period);
          }
      add(i, after[i], 1, period);
    }
    time_ += period;
  }

  [[nodiscard]] const std::vector<view::Track>& tracks() const { return recorder_.tracks(); }

 private:
  void add(std::size_t agent, Ticks clock, double share, Ticks period) {
    const double since = share * static_cast<double>((period * case_.page_ticks).value());
    recorder_.add(agent, time_.value() * case_.page_ticks + std::llround(since),
                  place(agent, clock));
  }
  [[nodiscard]] TrackRecorder::Place place(std::size_t agent, Ticks clock) const {
    VertexId at = case_.starts[agent];
    for (const execution::TimedMove& move : case_.order.moves[AgentId(agent)]) {
      if (clock <= move.begin) break;
      if (clock < move.end) {
        const double share = static_cast<double>((clock - move.begin).value()) /
                             static_cast<double>((move.end - move.begin).value());
        const auto from = case_.position(move.from), to = case_.position(move.to);
        TrackRecorder::Place place{from.x + share * (to.x - from.x),
                                   from.y + share * (to.y - from.y),
                                   from.z + share * (to.z - from.z)};
        if (from.heading && to.heading)
          place.heading = *from.heading + share * std::remainder(*to.heading - *from.heading, 360);
        return place;
      }
      at = move.to;
    }
    return case_.position(at);
  }

  const ExecutionCase& case_;
  TrackRecorder recorder_;
  Ticks time_ = 0;
};

class Simulator {
 public:
  Simulator(const SimulateArguments& arguments, const ExecutionCase& c) : case_(c) {
    delays_.pause_chance = arguments.chance.value_or(delays_.pause_chance);
    delays_.slowness = arguments.slowness.value_or(delays_.slowness);
    delays_.longest_pause = whole(arguments.longest.value_or(3));
    for (const AgentId agent : IdRange<AgentId>(c.order.num_agents())) {
      const Ticks cost = c.order.end(agent) - c.order.now;
      plan_makespan_ = std::max(plan_makespan_, cost);
      plan_cost_ += cost;
    }
    if (!c.has_timesteps)
      period_ = arguments.period ? whole(*arguments.period)
                                 : std::max(Ticks{1}, plan_makespan_ / kPeriods);
    runs_ = static_cast<std::size_t>(arguments.runs.value_or(20));
    seed_ = static_cast<std::uint64_t>(arguments.seed.value_or(0));
    for (const Rule rule : {Rule::naive, Rule::gated, Rule::coupled})
      if (!arguments.rule || rule == *arguments.rule) {
        tallies_.emplace_back();
        tallies_.back().rule = rule;
      }
  }

  void run() {
    for (std::size_t k = 0; k < runs_; ++k) {
      const auto delays = draw_delays(case_.order, delays_, seed_ + k);
      for (Tally& tally : tallies_) add_run(delays, tally);
    }
  }

  [[nodiscard]] std::string describe() const {
    std::string text = fmt::format(
        "delays     pauses on {:g} % of the moves, up to {}; up to {:g} % slow; {} run{}, seed {}\n"
        "period     {}\n"
        "plan       makespan {}, sum of costs {}\n\n",
        100 * delays_.pause_chance, case_.time(delays_.longest_pause), 100 * delays_.slowness,
        runs_, runs_ == 1 ? "" : "s", seed_, case_.time(period_), case_.time(plan_makespan_),
        case_.time(plan_cost_));
    text += fmt::format("{:<10} {:>9} {:>9} {:>9} {:>10} {:>12} {:>9} {:>10}\n", "rule",
                        "colliding", "colliding", "runs that", "mean", "mean sum", "mean", "least");
    text += fmt::format("{:<10} {:>9} {:>9} {:>9} {:>10} {:>12} {:>9} {:>10}\n", "", "runs",
                        "pairs", "never end", "makespan", "of costs", "held", "clearance");
    for (const Tally& tally : tallies_) text += line(tally);
    return text;
  }

  /// Of the run that is shown. Requires a case with a page.
  [[nodiscard]] std::string page() const { return case_.page(tracks_); }

  [[nodiscard]] std::string json() const {
    Json rules = Json::array();
    for (const Tally& tally : tallies_)
      rules.push_back({{"rule", to_string(tally.rule)},
                       {"colliding_runs", tally.colliding_runs},
                       {"colliding_pairs", tally.colliding_pairs},
                       {"endless_runs", tally.endless},
                       {"mean_makespan", tally.mean(tally.makespan)},
                       {"mean_sum_of_costs", tally.mean(tally.sum_of_costs)},
                       {"mean_held", tally.mean(tally.held)},
                       {"least_clearance", or_null(tally.clearance)}});
    const Json report = {{"quadrille", "simulation"},
                         {"version", 1},
                         {"runs", runs_},
                         {"seed", seed_},
                         {"delays", delays_.pause_chance},
                         {"longest", units(delays_.longest_pause)},
                         {"slow", delays_.slowness},
                         {"period", units(period_)},
                         {"plan_makespan", units(plan_makespan_)},
                         {"plan_sum_of_costs", units(plan_cost_)},
                         {"rules", rules}};
    return report.dump(2) + "\n";
  }

 private:
  [[nodiscard]] double units(Ticks ticks) const {
    return static_cast<double>(ticks.value()) * case_.tick;
  }
  /// In ticks, at least one. `time` is small enough.
  [[nodiscard]] Ticks whole(double time) const {
    return std::max(Ticks{1}, Ticks(static_cast<std::int64_t>(std::llround(time / case_.tick))));
  }

  void add_run(const execution::Delays& delays, Tally& tally) {
    const auto watch = case_.watch();
    // The first run by the last rule is shown: the coupled one, unless another one is asked for.
    const bool is_shown = tally.runs == 0 && &tally == &tallies_.back() && case_.page;
    RunRecorder recorder(case_);
    const auto result = simulate(case_.order, delays, tally.rule, period_,
                                 [&](std::span<const Ticks> before, std::span<const Ticks> after) {
                                   watch->add(before, after);
                                   if (is_shown) recorder.add(before, after, period_);
                                 });
    if (is_shown) tracks_ = recorder.tracks();
    ++tally.runs;
    tally.colliding_pairs += watch->contacts();
    if (watch->contacts() > 0) ++tally.colliding_runs;
    if (const auto clearance = watch->clearance())
      tally.clearance = std::min(tally.clearance.value_or(*clearance), *clearance);
    if (!result.all_arrived) {
      ++tally.endless;
      return;
    }
    tally.makespan += units(result.makespan());
    tally.sum_of_costs += units(result.sum_of_costs());
    for (const Ticks held : result.held) tally.held += units(held);
  }

  [[nodiscard]] std::string line(const Tally& tally) const {
    const bool ended = tally.endless < tally.runs;
    const auto number = [&](double sum) {
      return ended ? fmt::format("{:.6g}", tally.mean(sum)) : std::string("-");
    };
    return fmt::format("{:<10} {:>9} {:>9} {:>9} {:>10} {:>12} {:>9} {:>10}\n",
                       to_string(tally.rule), tally.colliding_runs, tally.colliding_pairs,
                       tally.endless, number(tally.makespan), number(tally.sum_of_costs),
                       number(tally.held),
                       tally.clearance ? fmt::format("{:.4g}", *tally.clearance) : "-");
  }

  const ExecutionCase& case_;
  execution::DelayOptions delays_;
  Ticks period_ = 1, plan_makespan_ = 0, plan_cost_ = 0;
  std::size_t runs_ = 0;
  std::uint64_t seed_ = 0;
  std::vector<Tally> tallies_;
  std::vector<view::Track> tracks_;
};

ExitCode simulate_plan(const CLI::App& app, SimulateArguments& arguments) {
  if (arguments.slowness.value_or(0) > kMaxSlowness)
    return usage_error(app, fmt::format("--slow is at most {}", kMaxSlowness));
  const auto loaded = load_execution(app, arguments.execution);
  if (const auto* code = std::get_if<ExitCode>(&loaded)) return *code;
  const auto& c = std::get<ExecutionCase>(loaded);
  if (c.has_timesteps && arguments.period)
    return usage_error(app, "--period is for roadmaps; a period is a timestep here");
  for (const auto& [option, time] :
       {std::pair("--longest", arguments.longest), std::pair("--period", arguments.period)})
    if (time && *time / c.tick > static_cast<double>(geometry::kMaxDuration.value()))
      return usage_error(app, fmt::format("{} is too long", option));
  if (!arguments.view.empty() && !c.page)
    return usage_error(app, "--view needs vertices with places: a grid, or a roadmap");
  Delivery delivery(arguments.execution.quiet, "", arguments.execution.json, arguments.view);
  if (!delivery.probe()) return ExitCode::output;
  Simulator simulator(arguments, c);
  simulator.run();
  if (delivery.has_json_file()) delivery.write_json(simulator.json());
  if (delivery.has_view_file()) delivery.write_view(Result<std::string>(simulator.page()));
  delivery.print_summary(c.description + simulator.describe(), "");
  return delivery.finish(ExitCode::success);
}

}  // namespace

Subcommand add_simulate(CLI::App& program) {
  CLI::App* app = program.add_subcommand("simulate", "Let a plan run under random delays");
  const auto arguments = std::make_shared<SimulateArguments>();
  add_execution_options(*app, arguments->execution);
  const auto rule = [arguments](const std::string& text) {
    arguments->rule = execution::parse_rule(text);
    if (!arguments->rule) refuse_value("--rule", text, "naive, gated or coupled");
  };
  app->add_option_function<std::string>(
         "--rule", rule, "naive, gated or coupled; default: all, one after the other")
      ->type_name("NAME");
  add_share(*app, "--delays", arguments->chance,
            "Share of the moves on which an agent pauses;\n"
            "default 0.1");
  add_positive(*app, "--longest", arguments->longest,
               "Longest pause, in the instance's unit of time; default 3");
  add_share(*app, "--slow", arguments->slowness,
            "Agents are up to this share slower than planned, at most 0.95; default 0.15");
  add_positive(*app, "--period", arguments->period,
               "With a roadmap: time between two decisions; default: the 500th part of the\n"
               "plan's makespan");
  add_integer(*app, "--runs", arguments->runs, 1, kMaxRuns, "Runs; default 20");
  add_integer(*app, "--seed", arguments->seed, 0, 2'000'000'000,
              "Seed of the first run; default 0");
  add_file(*app, "--view", arguments->view,
           "Write a page that plays the first run, under the last rule; - is standard output");
  app->footer(std::string(kFooter) + kExitCodesHelp);
  return {app, [app, arguments] { return simulate_plan(*app, *arguments); }};
}

}  // namespace quadrille::cli
