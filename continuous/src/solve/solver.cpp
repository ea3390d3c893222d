// SPDX-License-Identifier: MIT
#include "quadrille/continuous/solver.hpp"

#include <memory>

#include "quadrille/continuous/free_cost.hpp"
#include "quadrille/continuous/verify.hpp"
#include "quadrille/solve/frame.hpp"
#include "solve/phases.hpp"
#include "solve/warm_start.hpp"

namespace quadrille::continuous {
namespace {

/// What solve::Frame asks for.
class Domain {
 public:
  using Plan = continuous::Plan;
  using Outcome = SolveOutcome;

  Domain(const Instance& instance, const SolveOptions& options, const WarmStart& warm)
      : instance_(instance), options_(options), warm_(warm) {}

  [[nodiscard]] VerifyReport verify(const Plan& plan) const {
    return continuous::verify(instance_, plan);
  }
  [[nodiscard]] static Cost cost(const Plan& plan, Objective objective) {
    return continuous::cost(plan, objective);
  }
  [[nodiscard]] static Cost cost_of(const Plan& plan, AgentId agent) {
    return continuous::cost(plan.paths[agent]);
  }
  static void tidy(const Plan&) {}
  [[nodiscard]] IdRange<AgentId> agents() const { return instance_.agent_ids(); }
  [[nodiscard]] Cost free_cost(AgentId agent) const {
    return as_cost(continuous::free_cost(instance_, agent).value());
  }

  void search(LimitMonitor& limits, const std::shared_ptr<ResourceAccount>& account,
              Knowledge& known, solve::Pulse<Plan>& pulse) {
    Exchange alone;
    Phases(instance_, options_, warm_, account, {limits, known, pulse, alone}).run();
  }

 private:
  const Instance& instance_;
  const SolveOptions& options_;
  const WarmStart& warm_;
};

}  // namespace

std::string_view to_string(System system) noexcept {
  return system == System::dpll ? "dpll" : "smt-cbs";
}

std::optional<System> parse_system(std::string_view text) noexcept {
  for (const System system : {System::dpll, System::smt_cbs})
    if (text == to_string(system)) return system;
  return std::nullopt;
}

Result<SolveOutcome> solve(const Instance& instance, const SolveOptions& options) {
  return solve(instance, options, WarmStart{});
}

Result<SolveOutcome> solve(const Instance& instance, const SolveOptions& options,
                           const WarmStart& warm) {
  Domain domain(instance, options, warm);
  return solve::Frame<Domain>(domain, options).solve();
}

}  // namespace quadrille::continuous
