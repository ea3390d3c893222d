// SPDX-License-Identifier: MIT
// Two discs in continuous time: they have to pass each other on a road with one siding.
#include <iostream>
#include <memory>
#include <quadrille/continuous/quantise.hpp>
#include <quadrille/continuous/solver.hpp>
#include <quadrille/continuous/verify.hpp>

using namespace quadrille;
using namespace quadrille::continuous;

namespace {

constexpr double kResolution = 0.001;  // a length unit is a millimetre, a tick a millisecond

Point metres(double x, double y) {
  return {*quantise_coordinate(x, kResolution), *quantise_coordinate(y, kResolution)};
}

Result<Instance> make_instance() {
  const VertexId west(0), junction(1), east(2), siding(3);
  std::vector<Edge> edges;
  for (const VertexId end : {west, east, siding}) {
    edges.push_back({end, junction, std::nullopt});  // one way each; durations follow from lengths
    edges.push_back({junction, end, std::nullopt});
  }
  auto roadmap =
      Roadmap::make({metres(0, 0), metres(1, 0), metres(2, 0), metres(1, 0.8)}, std::move(edges));
  if (!roadmap) return roadmap.error();
  const Length radius = *quantise_radius(0.3, kResolution);
  return Instance::make(
      std::make_shared<const Roadmap>(std::move(roadmap).value()),
      {{west, east, Disc{radius}, kUnitSpeed}, {east, west, Disc{radius}, kUnitSpeed}},
      kResolution);
}

}  // namespace

int main() {
  const auto instance = make_instance();
  if (!instance) {
    std::cerr << instance.error().to_string() << "\n";
    return 1;
  }
  const SolveOutcome outcome = solve(*instance, {}).value();
  std::cout << to_string(outcome.status) << ", sum of costs " << outcome.cost.value_or(-1)
            << " ms, lower bound " << outcome.lower_bound << " ms\n";
  if (!outcome.plan) return 1;

  // How long each agent waits in all; where and when, Path has: stops with arrival and departure.
  Ticks waits = 0;
  for (const Path& path : outcome.plan->paths)
    for (const Stop& stop : path) waits += stop.depart - stop.arrive;
  std::cout << "waits " << waits << " ms in all\n";

  // `solve` has replayed the plan already; this is how to check one from elsewhere.
  const VerifyReport report = verify(*instance, *outcome.plan);
  for (const Violation& violation : report.violations) std::cout << violation.message << "\n";
  for (const Clearance& clearance : report.clearances)
    std::cout << "agents " << clearance.agent.value() << " and " << clearance.other.value()
              << " come nearest: "
              << (clearance.gap < 1 ? "within a millimetre\n" : "more than a millimetre apart\n");
  return report.valid() ? 0 : 1;
}
