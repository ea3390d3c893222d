// SPDX-License-Identifier: MIT
#include "solve/portfolio.hpp"

#include <cstddef>

#include "solve/cost_run.hpp"

namespace quadrille::continuous {
namespace {

SolveOptions options_of(const SolveOptions& options, std::size_t worker) {
  SolveOptions other = options;
  other.seed = static_cast<std::uint32_t>((options.seed + worker) % (SolveOptions::kMaxSeed + 1));
  return other;
}

}  // namespace

void search_side_by_side(Scene& scene, const SolveOptions& options,
                         const std::shared_ptr<ResourceAccount>& account, const Desk& desk,
                         const solve::Pace& pace, const WarmStart& warm) {
  const auto role_of = [](std::size_t worker, bool is_second_missing) {
    if (worker > 1) return Role::cores;
    if (worker == 1) return Role::plans;
    return is_second_missing ? Role::all : Role::bound;
  };
  const auto search_as = [&](std::size_t worker, const Desk& own) {
    const SolveOptions own_options = options_of(options, worker);
    if (worker == 0) return search_costs(scene, own_options, own, warm);
    Scene own_scene(scene.instance(), own.limits, nullptr, options.settings);
    if (own_scene.is_complete()) search_costs(own_scene, own_options, own);
  };
  solve::Portfolio<Plan, Message>(options, account, pace, role_of, search_as).run(desk);
}

}  // namespace quadrille::continuous
