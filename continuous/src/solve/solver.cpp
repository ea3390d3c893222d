// SPDX-License-Identifier: MIT
#include "quadrille/continuous/solver.hpp"

#include <memory>

#include "certificate/certify.hpp"
#include "feasibility/goal_reach.hpp"
#include "joint/joint_groups.hpp"
#include "model/parked.hpp"
#include "model/since_now.hpp"
#include "quadrille/continuous/free_cost.hpp"
#include "quadrille/continuous/verify.hpp"
#include "quadrille/solve/apart.hpp"
#include "quadrille/solve/frame.hpp"
#include "quadrille/solve/time_origin.hpp"
#include "solve/phases.hpp"
#include "solve/priced_search.hpp"
#include "solve/warm_start.hpp"

namespace quadrille::continuous {
namespace {

/// What solve::search_from_0 asks for.
class Border {
 public:
  explicit Border(const Instance& instance) : instance_(instance) {}

  [[nodiscard]] bool begins_at_0() const { return instance_.now() == 0; }
  [[nodiscard]] const Instance& instance() const { return instance_; }
  [[nodiscard]] Instance since_now() const { return continuous::since_now(instance_); }
  [[nodiscard]] VerifyReport verify(const Plan& plan) const {
    return continuous::verify(instance_, plan);
  }
  void enter(Plan& plan) const { shift(plan, -instance_.now()); }
  void leave(Plan& plan) const { shift(plan, instance_.now()); }
  [[nodiscard]] Cost now() const { return as_cost(instance_.now()); }

 private:
  const Instance& instance_;
};

/// The same of agents that overlap at their starts: inside, these are places of their own.
class ParkedBorder {
 public:
  ParkedBorder(const Instance& instance, const PrivateStarts& starts)
      : instance_(instance), starts_(starts) {}

  [[nodiscard]] bool begins_at_0() const { return starts_.is_empty(); }
  [[nodiscard]] const Instance& instance() const { return instance_; }
  [[nodiscard]] const Instance& since_now() const { return starts_.instance(); }
  [[nodiscard]] VerifyReport verify(const Plan& plan) const {
    return continuous::verify(instance_, plan);
  }
  void enter(Plan& plan) const { starts_.enter(plan); }
  void leave(Plan& plan) const { starts_.leave(plan); }
  [[nodiscard]] static Cost now() { return 0; }

 private:
  const Instance& instance_;
  const PrivateStarts& starts_;
};

/// Copies are called what they are copies of.
void rename_places(SolveOutcome& outcome, const PrivateStarts& starts) {
  for (VertexId& v : outcome.bottleneck) v = starts.original(v);
  if (!outcome.attribution) return;
  for (CollisionSite& site : outcome.attribution->sites)
    for (Place* const place : {&site.place, site.other ? &*site.other : nullptr})
      if (place != nullptr) {
        place->from = starts.original(place->from);
        place->to = starts.original(place->to);
      }
}

Result<SolveOutcome> solve_parked(const Instance& instance, const SolveOptions& options) {
  if (instance.parked_pairs().empty()) return solve_from_0(instance, options, WarmStart{});
  const PrivateStarts starts(instance);
  auto outcome = solve::search_from_0(ParkedBorder(instance, starts), options,
                                      [](const Instance& inner, const SolveOptions& asked) {
                                        return solve_from_0(inner, asked, WarmStart{});
                                      });
  if (outcome) rename_places(*outcome, starts);
  return outcome;
}

/// What solve::Frame asks for.
class Domain {
 public:
  using Plan = continuous::Plan;
  using Options = SolveOptions;
  using Outcome = SolveOutcome;
  using Apart = solve::Apart<Domain>;

  Domain(const Instance& instance, const SolveOptions& options, const WarmStart& warm)
      : instance_(instance), options_(options), warm_(warm) {
    QUADRILLE_REQUIRE(instance.now() == 0, "searches begin at 0");
  }

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
    account_ = account;
    if (auto crowd = find_crowd(instance_, limits); !crowd.empty()) {
      std::string why = describe_crowd(crowd);
      known.infeasible = solve::Infeasibility{std::move(why), std::move(crowd), {}};
      return;
    }
    // What a session leaves to its next solve is about all agents.
    // And a certificate is one for all.
    if (options_.system == System::dpll && warm_.store == nullptr && !options_.proof &&
        is_worth_parting()) {
      store_ = std::make_unique<SceneStore>(instance_.shared_roadmap());
      const auto groups = groups_of(limits);
      if (groups.size() > 1) {
        Apart(*this, options_, account, limits, known, pulse).run(groups);
        return;
      }
    }
    Exchange alone;
    const Desk desk{limits, known, pulse, alone};
    // What a session leaves to its next solve is told without prices.
    const auto priced =
        warm_.store == nullptr ? price_goals(instance_, options_, limits) : std::nullopt;
    if (priced)
      search_with_prices(instance_, *priced, options_, account, desk);
    else
      Phases(instance_, options_, warm_, account, desk, proof_).run();
    if (known.has_floor) floor_ = known.floor;
  }

  // What solve::Apart asks for.
  [[nodiscard]] Apart::Search search_of(const std::vector<AgentId>& agents) const {
    std::vector<Agent> tasks;
    for (const AgentId i : agents) tasks.push_back(instance_.agent(i));
    return [this, part = instance_.with_agents(std::move(tasks)).value()](
               const SolveOptions& options, LimitMonitor& limits, Knowledge& known,
               solve::Pulse<Plan>& pulse) {
      Exchange alone;
      const Desk desk{limits, known, pulse, alone};
      if (const auto priced = price_goals(part, options, limits))
        return search_with_prices(part, *priced, options, account_, desk);
      store_->adopt(part);
      WarmStart warm;
      warm.store = store_.get();
      std::optional<ProofDraft> none;
      Phases(part, options, warm, account_, desk, none).run();
    };
  }
  [[nodiscard]] solve::Infeasibility told(solve::Infeasibility infeasibility) const {
    return infeasibility.blocked.empty()
               ? infeasibility
               : continuous::infeasibility(instance_, infeasibility.blocked);
  }

  /// Into the outcome, which is complete otherwise.
  void certify(SolveOutcome& outcome) {
    const bool is_exhausted = proof_ && proof_->is_exhausted;
    if (outcome.internal_error || (proof_ && !proof_->fault.empty())) {
      outcome.no_certificate =
          outcome.internal_error ? outcome.internal_error->message : std::move(proof_->fault);
    } else if (outcome.status == Status::infeasible && !is_exhausted) {
      outcome.no_certificate =
          "clauses did not show that there is no plan, and certificates know of nothing else";
    } else {
      if (!proof_)
        proof_ = draft_without_search(instance_, floor_.value_or(bound_without_claim(outcome)));
      outcome.certificate =
          continuous::certify(instance_, options_.objective, *proof_, outcome.plan);
    }
  }

 private:
  /// Of a solve that a limit ended before the search began.
  [[nodiscard]] Cost bound_without_claim(const SolveOutcome& outcome) const {
    return options_.known_lower_bound ? 0 : outcome.lower_bound;
  }
  /// Questions what is near an edge, for each pair of classes, to find groups: some microseconds
  /// each, where the search may need only a few of them.
  static constexpr std::size_t kMostNear = 200'000;

  [[nodiscard]] bool is_worth_parting() const {
    const std::size_t num_classes = instance_.num_classes();
    return num_classes * num_classes * instance_.roadmap().num_edges() <= kMostNear &&
           !are_in_one_component(instance_);
  }
  [[nodiscard]] AgentGroups groups_of(LimitMonitor& limits) {
    store_->adopt(instance_);
    Scene scene(instance_, limits, store_.get(), options_.settings);
    if (!scene.is_complete()) throw LimitReached{};
    AgentGroups groups;
    for (JointGroup& group : independent_groups(scene)) groups.push_back(std::move(group.agents));
    return solve::with_lone_agents_together(std::move(groups));
  }

  const Instance& instance_;
  const SolveOptions& options_;
  const WarmStart& warm_;
  std::shared_ptr<ResourceAccount> account_;  // of the search
  std::unique_ptr<SceneStore> store_;         // of groups
  std::optional<ProofDraft> proof_;
  std::optional<Cost> floor_;  // what agents cost when each is alone
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
  return search_from_0(instance, options, solve_parked);
}

Result<SolveOutcome> search_from_0(const Instance& instance, const SolveOptions& options,
                                   const SearchFrom0& search) {
  return solve::search_from_0(Border(instance), options, search);
}

Result<SolveOutcome> solve_from_0(const Instance& instance, const SolveOptions& options,
                                  const WarmStart& warm) {
  if (options.proof)
    if (const std::string what = why_no_certificate(instance); !what.empty())
      return Error{ErrorCode::out_of_range, "certificates have no rule yet for " + what, {}};
  Domain domain(instance, options, warm);
  auto outcome = solve::Frame<Domain>(domain, options).solve();
  if (outcome && options.proof) domain.certify(outcome.value());
  return outcome;
}

}  // namespace quadrille::continuous
