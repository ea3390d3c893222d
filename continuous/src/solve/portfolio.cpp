// SPDX-License-Identifier: MIT
#include "solve/portfolio.hpp"

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

#include "solve/cost_run.hpp"

namespace quadrille::continuous {
namespace {

SolveOptions options_of(const SolveOptions& options, std::size_t worker) {
  SolveOptions other = options;
  other.seed = static_cast<std::uint32_t>((options.seed + worker) % (SolveOptions::kMaxSeed + 1));
  return other;
}

bool is_better(const ProofDraft& a, const ProofDraft& b) {
  const auto rank = [](const ProofDraft& draft) {
    return std::tuple(!draft.fault.empty(), draft.is_exhausted, draft.bound);
  };
  return rank(a) > rank(b);
}

}  // namespace

void search_side_by_side(Scene& scene, const SolveOptions& options,
                         const std::shared_ptr<ResourceAccount>& account, const Desk& desk,
                         const solve::Pace& pace, const WarmStart& warm,
                         std::optional<ProofDraft>& proof) {
  const auto role_of = [](std::size_t worker, bool is_second_missing) {
    if (worker > 1) return Role::cores;
    if (worker == 1) return Role::plans;
    return is_second_missing ? Role::all : Role::bound;
  };
  std::vector<std::optional<ProofDraft>> proofs(std::max<std::size_t>(1, options.threads));
  const auto search_as = [&](std::size_t worker, const Desk& own) {
    const SolveOptions own_options = options_of(options, worker);
    if (worker == 0) return search_costs(scene, own_options, own, warm, proofs[0]);
    Scene own_scene(scene.instance(), own.limits, nullptr, options.settings);
    own_scene.set_fees(scene.fees());
    if (own_scene.is_complete()) search_costs(own_scene, own_options, own, {}, proofs[worker]);
  };
  solve::Portfolio<Plan, Message>(options, account, pace, role_of, search_as).run(desk);
  for (auto& draft : proofs)
    if (draft && (!proof || is_better(*draft, *proof))) proof = std::move(draft);
}

}  // namespace quadrille::continuous
