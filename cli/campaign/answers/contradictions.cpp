// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <map>
#include <utility>

#include "campaign/answers/merged.hpp"

namespace quadrille::cli::campaign {
namespace {

/// The strictest that jobs have said of one instance and objective, and who.
struct Claims {
  std::optional<std::pair<std::int64_t, std::size_t>> cost, bound;
  std::optional<std::size_t> infeasible;

  void raise(const std::optional<std::pair<std::int64_t, std::size_t>>& other) {
    if (other && (!bound || other->first > bound->first)) bound = other;
  }
  void lower(std::int64_t value, std::size_t job) {
    if (!cost || value < cost->first) cost = {value, job};
  }
};

class Comparison {
 public:
  explicit Comparison(const Merged& merged) : merged_(merged) {}

  std::vector<std::string> run() {
    for (std::size_t job = 0; job < merged_.rows.size(); ++job)
      if (merged_.rows[job]) enter(job, *merged_.rows[job]);
    for (const auto& [scenario, instances] : scenarios_) climb(instances);
    return std::move(found_);
  }

 private:
  using ByAgents = std::map<std::int64_t, Claims>;

  [[nodiscard]] std::string name(std::size_t job) const { return describe(merged_.list.jobs[job]); }

  void enter(std::size_t number, const Row& row) {
    const Job& job = merged_.list.jobs[number];
    Claims& claims = scenarios_[{job.scenario_id, job.objective}][job.agents];
    if (row.status == "infeasible") claims.infeasible = number;
    if (row.exact_bound) claims.raise(std::pair(*row.exact_bound, number));
    if (row.exact_cost) claims.lower(*row.exact_cost, number);
    if (row.status == "optimal" && row.exact_cost != row.exact_bound)
      found_.push_back(fmt::format("{} is optimal with cost {} and lower bound {}", name(number),
                                   row.cost.dump(), row.lower_bound.dump()));
    check_reference(number, row);
  }

  void check_reference(std::size_t number, const Row& row) {
    const Job& job = merged_.list.jobs[number];
    if (job.objective != Objective::sum_of_costs) return;
    const auto known = merged_.reference.costs.find(Reference::key_of(job));
    if (known == merged_.reference.costs.end()) return;
    const bool grid = !job.instance.empty() && job.instance[0] == "--map";
    // In continuous time others round otherwise.
    if (!grid) return;
    const std::int64_t cost = known->second;
    const char* what = nullptr;
    if (row.status == "infeasible") what = "says infeasible";
    if (row.exact_bound && *row.exact_bound > cost) what = "has a higher lower bound";
    if (row.exact_cost && *row.exact_cost < cost) what = "has a cheaper plan";
    if (what != nullptr)
      found_.push_back(fmt::format("{} {} than the optimal cost of the reference, {}", name(number),
                                   what, cost));
  }

  /// Whoever is left out costs nothing any more: more agents cost no less, and if the first ones
  /// have no plan, more have none.
  void climb(const ByAgents& instances) {
    Claims so_far;
    for (const auto& [agents, claims] : instances) {
      so_far.raise(claims.bound);
      if (claims.infeasible && !so_far.infeasible) so_far.infeasible = claims.infeasible;
      if (!claims.cost) continue;
      const auto [cost, plan] = *claims.cost;
      if (so_far.infeasible)
        found_.push_back(fmt::format("{} has a plan, and {} says infeasible", name(plan),
                                     name(*so_far.infeasible)));
      if (so_far.bound && so_far.bound->first > cost)
        found_.push_back(fmt::format("{} has a plan of cost {}, and {} has the lower bound {}",
                                     name(plan), cost, name(so_far.bound->second),
                                     so_far.bound->first));
    }
  }

  const Merged& merged_;
  std::map<std::pair<std::string, Objective>, ByAgents> scenarios_;
  std::vector<std::string> found_;
};

}  // namespace

std::vector<std::string> contradictions(const Merged& merged) { return Comparison(merged).run(); }

}  // namespace quadrille::cli::campaign
