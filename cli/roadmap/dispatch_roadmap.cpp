// SPDX-License-Identifier: MIT
#include "roadmap/dispatch_roadmap.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "answers/delivery.hpp"
#include "answers/report.hpp"
#include "frame/arguments.hpp"
#include "frame/output.hpp"
#include "quadrille/dispatch/simulation.hpp"
#include "roadmap/roadmap_text.hpp"

namespace quadrille::cli {
namespace {

using continuous::Ticks;

constexpr std::int64_t kSteps = 1'000;
constexpr double kMilliseconds = 20;
constexpr double kShare = 0.95;

/// Of numbers: nothing of none.
std::optional<double> mean(const std::vector<double>& numbers) {
  if (numbers.empty()) return std::nullopt;
  double sum = 0;
  for (const double number : numbers) sum += number;
  return sum / static_cast<double>(numbers.size());
}
/// The least one that is no less than this share of them.
std::optional<double> quantile(std::vector<double> numbers, double share) {
  if (numbers.empty()) return std::nullopt;
  std::sort(numbers.begin(), numbers.end());
  const double at = std::ceil(share * static_cast<double>(numbers.size())) - 1;
  return numbers[static_cast<std::size_t>(std::max(at, 0.0))];
}

/// What became of all calls.
struct Tally {
  std::size_t calls = 0, served = 0, contacts = 0, waiting = 0, origins = 0, too_late = 0;
  std::vector<double> gaps, call_seconds, service_times;
};

class Run {
 public:
  Run(const DispatchArguments& arguments, const continuous::Instance& instance)
      : arguments_(arguments), instance_(instance), tick_(instance.resolution().time) {
    options_.step = whole(arguments.step.value_or(1));
    options_.pause_chance = arguments.pauses.value_or(0);
    options_.longest_pause = whole(arguments.longest.value_or(3));
    if (arguments.service.value_or(0) > 0) options_.service = whole(*arguments.service);
    options_.has_random_tasks = !arguments.has_own_tasks;
    options_.seed = static_cast<std::uint64_t>(arguments.seed.value_or(0));
    asked_.effort = Effort::nanoseconds(
        static_cast<std::int64_t>(1e6 * arguments.effort.value_or(kMilliseconds)));
    if (arguments.reach) asked_.reach = whole(*arguments.reach);
    if (arguments.patience) asked_.patience = whole(*arguments.patience);
    asked_.improves = !arguments.does_not_improve;
  }

  std::optional<Error> run() {
    const auto& given = instance_.agents();
    const std::vector<continuous::Agent> robots(given.begin(), given.end());
    auto dispatcher = dispatch::Dispatcher::make(instance_.shared_roadmap(), robots,
                                                 instance_.resolution(), asked_);
    if (!dispatcher) return dispatcher.error();
    if (arguments_.has_own_tasks)
      for (const AgentId robot : instance_.agent_ids())
        if (auto error = dispatcher->assign(
                robot, {given[robot].goals, options_.service, given[robot].deadline}))
          return error;
    dispatch::Simulation simulation(*dispatcher, instance_.shared_roadmap(), robots, options_);
    const std::int64_t steps = arguments_.steps.value_or(kSteps);
    Limits limits;
    limits.wall_s = arguments_.wall;
    for (std::int64_t step = 0; step < steps; ++step) {
      const double before = wall_seconds();
      const dispatch::News news = simulation.step(limits);
      add(news, wall_seconds() - before);
      if (arguments_.has_own_tasks && tally_.served == robots.size()) break;
    }
    tally_.contacts = simulation.num_contacts();
    for (const Ticks time : simulation.service_times()) tally_.service_times.push_back(units(time));
    time_ = units(simulation.time());
    return std::nullopt;
  }

  [[nodiscard]] bool has_contacts() const { return tally_.contacts > 0; }

  [[nodiscard]] std::string describe() const {
    const auto number = [](const std::optional<double>& value) {
      return value ? fmt::format("{:.4g}", *value) : std::string("-");
    };
    return fmt::format(
        "time       {:g}, in {} calls; seed {}\n"
        "tasks      {} done, {} per unit of time\n"
        "service    mean {}, 95 % within {}\n"
        "calls      mean {} ms, 95 % within {} ms, longest {} ms, with the simulation\n"
        "waiting    {} robots without a path in the mean\n"
        "origins    {} times planned anew for late robots; {} plans came too late\n"
        "gap        mean {} %, median {} %, 95 % within {} %\n"
        "contacts   {}\n",
        time_, tally_.calls, options_.seed, tally_.served,
        number(static_cast<double>(tally_.served) / time_), number(mean(tally_.service_times)),
        number(quantile(tally_.service_times, kShare)),
        number(milliseconds(mean(tally_.call_seconds))),
        number(milliseconds(quantile(tally_.call_seconds, kShare))),
        number(milliseconds(quantile(tally_.call_seconds, 1))),
        number(static_cast<double>(tally_.waiting) / static_cast<double>(tally_.calls)),
        tally_.origins, tally_.too_late, number(mean(tally_.gaps)),
        number(quantile(tally_.gaps, 0.5)), number(quantile(tally_.gaps, kShare)), tally_.contacts);
  }

  [[nodiscard]] std::string json() const {
    const Json report = {
        {"quadrille", "dispatch"},
        {"version", 1},
        {"robots", instance_.num_agents()},
        {"seed", options_.seed},
        {"time", time_},
        {"calls", tally_.calls},
        {"tasks_done", tally_.served},
        {"throughput", static_cast<double>(tally_.served) / time_},
        {"service_time_mean", or_null(mean(tally_.service_times))},
        {"service_time_95", or_null(quantile(tally_.service_times, kShare))},
        {"call_s_mean", or_null(mean(tally_.call_seconds))},
        {"call_s_95", or_null(quantile(tally_.call_seconds, kShare))},
        {"call_s_longest", or_null(quantile(tally_.call_seconds, 1))},
        {"waiting_mean", static_cast<double>(tally_.waiting) / static_cast<double>(tally_.calls)},
        {"new_origins", tally_.origins},
        {"plans_too_late", tally_.too_late},
        {"gap_percent_mean", or_null(mean(tally_.gaps))},
        {"gap_percent_median", or_null(quantile(tally_.gaps, 0.5))},
        {"gap_percent_95", or_null(quantile(tally_.gaps, kShare))},
        {"contacts", tally_.contacts}};
    return report.dump(2) + "\n";
  }

 private:
  /// In ticks, at least one.
  [[nodiscard]] Ticks whole(double time) const {
    return std::max(Ticks{1}, Ticks(static_cast<std::int64_t>(std::llround(time / tick_))));
  }
  [[nodiscard]] double units(Ticks ticks) const {
    return static_cast<double>(ticks.value()) * tick_;
  }
  static std::optional<double> milliseconds(const std::optional<double>& seconds) {
    return seconds ? std::optional(1e3 * *seconds) : std::nullopt;
  }

  void add(const dispatch::News& news, double seconds) {
    ++tally_.calls;
    tally_.served += news.served.size();
    tally_.waiting += news.num_waiting;
    tally_.origins += news.has_new_origin ? 1 : 0;
    tally_.too_late += news.was_too_late ? 1 : 0;
    tally_.call_seconds.push_back(seconds);
    if (news.lower_bound > 0)
      tally_.gaps.push_back(100 * static_cast<double>(news.cost - news.lower_bound) /
                            static_cast<double>(news.lower_bound));
  }

  const DispatchArguments& arguments_;
  const continuous::Instance& instance_;
  const double tick_;
  dispatch::SimulationOptions options_;
  dispatch::Options asked_;
  Tally tally_;
  double time_ = 0;
};

/// What is wrong with times; empty if nothing is.
std::string check_times(const DispatchArguments& arguments, double tick) {
  const std::pair<const char*, const std::optional<double>*> times[] = {
      {"--step", &arguments.step},
      {"--service", &arguments.service},
      {"--longest", &arguments.longest},
      {"--reach", &arguments.reach},
      {"--patience", &arguments.patience}};
  for (const auto& [option, time] : times)
    if (*time && **time / tick > 1e9) return fmt::format("{} is too long", option);
  const double steps = static_cast<double>(arguments.steps.value_or(kSteps));
  if (steps * arguments.step.value_or(1) / tick >
      static_cast<double>(geometry::kMaxDuration.value()) / 4)
    return "--steps times --step is too long";
  return "";
}

}  // namespace

ExitCode dispatch_on_roadmap(const CLI::App& app, const DispatchArguments& arguments) {
  std::string wrong = check_roadmap_options(arguments.roadmap, arguments.input, Need::tasks);
  if (wrong.empty())
    wrong = check_outputs({{"--json", &arguments.json}},
                          {&arguments.input.map, &arguments.input.scen, &arguments.input.instance,
                           &arguments.roadmap.roadmap, &arguments.roadmap.task},
                          !arguments.quiet);
  if (!wrong.empty()) return usage_error(app, wrong);
  const auto input = load_roadmap_input(arguments.roadmap, arguments.input);
  if (!input) {
    report_error(input.error());
    return ExitCode::bad_input;
  }
  wrong = check_times(arguments, input->instance.resolution().time);
  if (!wrong.empty()) return usage_error(app, wrong);
  Delivery delivery(arguments.quiet, "", arguments.json);
  if (!delivery.probe()) return ExitCode::output;
  Run run(arguments, input->instance);
  if (auto error = run.run()) {
    report_error(*error);
    return ExitCode::bad_input;
  }
  if (delivery.has_json_file()) delivery.write_json(run.json());
  delivery.print_summary(describe_input(*input) + run.describe(), "");
  return delivery.finish(run.has_contacts() ? ExitCode::internal : ExitCode::success);
}

}  // namespace quadrille::cli
