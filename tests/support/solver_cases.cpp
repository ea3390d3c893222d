// SPDX-License-Identifier: MIT
#include "support/solver_cases.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "quadrille/discrete/verify.hpp"
#include "support/case_text.hpp"
#include "support/environment.hpp"

namespace quadrille::discrete::support {
namespace {

using Kind = CheckSchedule::Kind;

/// Nothing that is compared with the oracle needs a tenth of this; a search that does is a fault.
constexpr double kPatience = 60;

TunedOptions make_options(Objective objective, System system, CheckSchedule check = {}) {
  TunedOptions options;
  options.objective = objective;
  options.system = system;
  options.mdd.check = std::move(check);
  options.limits.wall_s = kPatience;
  options.first_plan = false;
  return options;
}

CheckSchedule random_fractions(Random& random) {
  static const std::vector<std::vector<CheckSchedule::Fraction>> kPublished = {
      {{1, 3}, {2, 3}}, {{1, 2}, {3, 4}}, {{2, 3}}, {{1, 10}}, {{9, 10}}};
  if (random.percent(60)) return {Kind::fractions, random.pick(kPublished)};
  CheckSchedule schedule{Kind::fractions, {}};
  const auto denominator = static_cast<std::int32_t>(random.between(2, 12));
  for (std::int32_t numerator = 1; numerator < denominator; ++numerator)
    if (random.percent(40)) schedule.fractions.push_back({numerator, denominator});
  if (schedule.fractions.empty()) schedule.fractions.push_back({1, denominator});
  return schedule;
}

void randomise(Random& random, std::vector<TunedOptions>& systems) {
  for (TunedOptions& options : systems) {
    options.seed = random.percent(50) ? 0 : static_cast<std::uint32_t>(random.below(2'000'000'001));
    if (options.seed % 2 == 1)
      options.first_explicit = static_cast<std::int64_t>(options.seed / 2 % 8);
    options.mdd.growth = random.percent(50) ? MddGrowth::on_demand : MddGrowth::full;
    if (random.percent(50))
      options.cost_search = random.percent(50) ? CostSearch::iterative : CostSearch::core_guided;
    options.debug.audit = random.percent(30);
    options.first_plan = random.percent(30);
    options.lazy.forbid_first = random.percent(30);
    if (random.percent(60)) options.lazy.chronological = random.percent(50);
    if (random.percent(50)) options.first_turn = 1 + static_cast<std::int64_t>(random.below(20));
    if (random.percent(50)) options.open = random.percent(80);
    if (random.percent(15)) {
      options.threads = 2 + random.below(3);
      options.race = random.percent(50);
      if (random.percent(80)) options.round = 1 + static_cast<std::int64_t>(random.below(3000));
    }
    if (random.percent(30)) options.debug.known_plan = Plan();  // replaced by the oracle's
    if (random.percent(15)) options.initial_plan = Plan();      // by the same, or one that waits
  }
}

std::string describe(const SolveOutcome& outcome) {
  std::string text(to_string(outcome.status));
  if (outcome.cost) text += ", cost " + std::to_string(*outcome.cost);
  text += ", lower bound " + std::to_string(outcome.lower_bound);
  if (outcome.stop != StopReason::none)
    text += ", stopped by " + std::string(to_string(outcome.stop));
  if (outcome.internal_error) text += ", internal error: " + outcome.internal_error->to_string();
  return text;
}

std::string describe(const JointAnswer& answer) {
  std::string text(to_string(answer.status));
  if (answer.status == Status::optimal) text += ", cost " + std::to_string(answer.cost);
  return text;
}

std::string find_fault_of_plan(const Instance& instance, Objective objective,
                               const SolveOutcome& outcome) {
  if (std::string fault = replay(instance, *outcome.plan); !fault.empty()) return fault;
  const VerifyReport report = verify(instance, *outcome.plan);
  if (!report.valid()) return "verify: " + report.violations[0].message;
  const Cost cost = outcome.plan->cost(objective);
  if (!outcome.cost || *outcome.cost != cost) return "the plan costs " + std::to_string(cost);
  const bool sum = objective == Objective::sum_of_costs;
  if ((sum ? report.sum_of_costs : report.makespan) != cost) return "verify counts another cost";
  Plan trimmed = *outcome.plan;
  trim(trimmed);
  if (trimmed != *outcome.plan) return "the plan is not trimmed";
  return "";
}

/// The instance without a vertex that is nobody's start or only goal; nullopt if it is.
std::optional<Instance> without_vertex(const Instance& instance, VertexId vertex) {
  const Graph& graph = instance.graph();
  if (!instance.is_plain()) return std::nullopt;
  for (const Agent& task : instance.agents())
    if (task.start == vertex || task.goals == Goals(vertex)) return std::nullopt;
  const auto renumber = [vertex](VertexId v) { return v < vertex ? v : VertexId(v.index() - 1); };
  std::vector<Agent> tasks;
  for (const Agent& task : instance.agents()) {
    std::vector<VertexId> goals;
    for (const VertexId goal : task.goals.vertices())
      if (goal != vertex) goals.push_back(renumber(goal));
    tasks.push_back({renumber(task.start), Goals(std::move(goals))});
  }
  // Two agents may be left with the same goal and no other one.
  const auto make = [&](Graph smaller) -> std::optional<Instance> {
    auto made = Instance::make(std::move(smaller), tasks);
    if (!made) return std::nullopt;
    return std::move(made).value();
  };
  if (graph.layout()) {
    const GridLayout& layout = *graph.layout();
    std::vector<bool> passable;
    for (std::int32_t y = 0; y < layout.height(); ++y)
      for (std::int32_t x = 0; x < layout.width(); ++x) {
        const auto v = layout.vertex_at({x, y});
        passable.push_back(v && *v != vertex);
      }
    return make(Graph::grid(layout.width(), layout.height(), passable));
  }
  std::vector<Graph::Edge> edges;
  for (const VertexId v : IdRange<VertexId>(graph.num_vertices()))
    for (const VertexId w : graph.neighbours(v))
      if (v < w && v != vertex && w != vertex) edges.emplace_back(renumber(v), renumber(w));
  return make(Graph::make(graph.num_vertices() - 1, edges).value());
}

SolveOutcome solve_noted(const Instance& instance, const TunedOptions& options,
                         const std::string& origin) {
  const quadrille::support::AbortNote note("# aborted: " + origin + "\n" + instance_text(instance) +
                                           options_text(options));
  return solve(instance, options).value();
}

}  // namespace

std::vector<TunedOptions> all_systems(Objective objective) {
  // Elsewhere a lucky first plan could spare the search that is to be tested.
  TunedOptions with_first_plan = make_options(objective, System::dpll);
  with_first_plan.first_plan = true;
  return {with_first_plan,
          make_options(objective, System::dpll),
          make_options(objective, System::dpll_mdd, {Kind::watch, {}}),
          make_options(objective, System::dpll_mdd, {Kind::propagate, {}}),
          make_options(objective, System::dpll_mdd, {Kind::fractions, {{1, 3}, {2, 3}}}),
          make_options(objective, System::dpll_mdd, {Kind::fractions, {{1, 2}, {3, 4}}}),
          make_options(objective, System::dpll_mdd, {Kind::fractions, {{2, 3}}}),
          make_options(objective, System::smt_cbs),
          make_options(objective, System::mdd_sat)};
}

std::vector<TunedOptions> random_systems(Random& random, Objective objective) {
  std::vector<TunedOptions> systems{
      make_options(objective, System::dpll),
      make_options(objective, System::dpll_mdd, {Kind::watch, {}}),
      make_options(objective, System::dpll_mdd, {Kind::propagate, {}}),
      make_options(objective, System::dpll_mdd, random_fractions(random)),
      make_options(objective, System::smt_cbs),
      make_options(objective, System::mdd_sat)};
  randomise(random, systems);
  return systems;
}

std::string find_inconsistency(const Instance& instance, const TunedOptions& options,
                               const SolveOutcome& outcome) {
  if (outcome.internal_error) return "an internal error";
  // The other systems have all that they need inside the solver: it may not call collisions a
  // model.
  if (options.system != System::smt_cbs && outcome.statistics.rejected_models > 0)
    return "a model with collisions";
  const bool has_plan = outcome.status == Status::optimal || outcome.status == Status::feasible;
  if (outcome.plan.has_value() != has_plan) return "status and plan do not fit";
  if (outcome.cost.has_value() != has_plan) return "status and cost do not fit";
  if (has_plan) {
    if (std::string fault = find_fault_of_plan(instance, options.objective, outcome);
        !fault.empty())
      return fault;
    const bool met = *outcome.cost == outcome.lower_bound;
    if (met != (outcome.status == Status::optimal) || outcome.lower_bound > *outcome.cost)
      return "status and bounds do not fit";
  }
  if (outcome.status == Status::infeasible && outcome.explanation.empty())
    return "infeasible without an explanation";
  const bool proved = outcome.status == Status::optimal || outcome.status == Status::infeasible;
  if (!proved && outcome.stop == StopReason::none) return "no proof, but no limit either";
  if (outcome.status == Status::unknown && outcome.explanation.empty())
    return "unknown without an explanation";
  return "";
}

std::string find_fault(const Instance& instance, const TunedOptions& options,
                       const SolveOutcome& outcome, const JointAnswer& expected) {
  if (std::string fault = find_inconsistency(instance, options, outcome); !fault.empty())
    return fault;
  if (outcome.status != expected.status) return "wrong status";
  if (outcome.status == Status::optimal && *outcome.cost != expected.cost) return "wrong cost";
  if (outcome.stop != StopReason::none) return "a limit although the search completed";
  return "";
}

/// The same, after everybody has waited for some timesteps.
Plan delayed(Plan plan, std::size_t timesteps) {
  for (Path& path : plan.paths) path.insert(path.begin(), timesteps, path.front());
  return plan;
}

std::string solve_and_compare(const Instance& instance, const TunedOptions& options,
                              const JointAnswer& expected, const std::string& origin) {
  std::string fault;
  SolveOutcome outcome;
  JointAnswer answer = expected;
  const auto fails = [&](const Instance& candidate) {
    TunedOptions complete = options;
    if (complete.debug.known_plan) {
      complete.debug.known_plan.reset();
      if (answer.status == Status::optimal) complete.debug.known_plan = answer.plan;
    }
    if (complete.initial_plan) {
      complete.initial_plan.reset();
      if (answer.status == Status::optimal)
        complete.initial_plan = delayed(answer.plan, options.seed % 3);
    }
    outcome = solve_noted(candidate, complete, origin);
    fault = answer.status == Status::unknown ? find_inconsistency(candidate, options, outcome)
                                             : find_fault(candidate, options, outcome, answer);
    return !fault.empty();
  };
  if (!fails(instance)) return "";
  // A search that does not end would be repeated for each smaller candidate.
  const bool endless = outcome.stop != StopReason::none;
  const std::size_t num_vertices = instance.graph().num_vertices();
  const Instance smallest = shrink(instance, [&](const Instance& candidate) {
    if (endless) return false;
    answer = joint_search(candidate, options.objective);
    return fails(candidate);
  });
  // Once more, for the description of what was kept.
  answer = joint_search(smallest, options.objective);
  if (answer.status == Status::unknown && smallest.graph().num_vertices() == num_vertices &&
      smallest.num_agents() == instance.num_agents())
    answer = expected;
  fails(smallest);
  return "# " + origin + "\n# " + fault + "\n# expected: " + describe(answer) +
         "\n# answered: " + describe(outcome) + "\n" + instance_text(smallest) +
         options_text(options);
}

Instance without_agent(const Instance& instance, AgentId agent) {
  std::vector<Agent> tasks;
  for (const AgentId i : instance.agent_ids())
    if (i != agent) tasks.push_back(instance.agents()[i]);
  return instance.with_agents(std::move(tasks)).value();
}

Instance shrink(Instance instance, const std::function<bool(const Instance&)>& fails) {
  bool smaller = true;
  while (smaller) {
    smaller = false;
    for (std::size_t i = instance.num_agents(); i-- > 0;)
      if (Instance candidate = without_agent(instance, AgentId(i)); fails(candidate)) {
        instance = std::move(candidate);
        smaller = true;
      }
    for (std::size_t v = instance.graph().num_vertices(); v-- > 0;)
      if (auto candidate = without_vertex(instance, VertexId(v)); candidate && fails(*candidate)) {
        instance = std::move(*candidate);
        smaller = true;
      }
  }
  return instance;
}

}  // namespace quadrille::discrete::support
