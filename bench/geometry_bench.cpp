// SPDX-License-Identifier: MIT
// Answers per second of geometry/, for pairs of motions that the broad phase lets through: edges of
// a random roadmap, up to about three units long, and moves on a grid, where exact contacts are
// common. The unit has a million length units, as in the default resolution.
#include <benchmark/benchmark.h>

#include <cmath>
#include <random>

#include "quadrille/geometry/body_pair.hpp"
#include "quadrille/geometry/swept_volumes.hpp"

namespace quadrille::geometry {
namespace {

constexpr std::int64_t kUnit = 1000000;
constexpr Length kRadius = 353553;  // sqrt(2) / 4, rounded down.

// Pairs whose swept volumes are near each other: what the broad phase lets through.
struct Pair {
  Motion a;
  Motion b;
};

std::vector<Motion> roadmap(std::size_t count, bool grid) {
  std::mt19937_64 random(1);
  const auto draw = [&](std::int64_t first, std::int64_t last) {
    return Length(
        first + static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(last - first + 1)));
  };
  const auto side = static_cast<std::int64_t>(std::sqrt(static_cast<double>(count)));
  const std::int64_t step = grid ? kUnit : 1;
  std::vector<Motion> motions;
  while (motions.size() < count) {
    const Point from{draw(0, side * kUnit / step) * step, draw(0, side * kUnit / step) * step};
    const std::int64_t reach = (grid ? 1 : 3 * kUnit);
    const Point to{from.x + draw(-reach, reach) * step, from.y + draw(-reach, reach) * step};
    if (from == to) continue;
    const double length = std::hypot(static_cast<double>((to.x - from.x).value()),
                                     static_cast<double>((to.y - from.y).value()));
    motions.push_back({from, to, std::max(Ticks{1}, Ticks(std::llround(length)))});
  }
  return motions;
}

// A disc, a rectangle, or a polygon of 64 corners, all in the same disc.
Body body(std::int64_t kind) {
  if (kind == 0) return Disc{kRadius};
  const Length r = kRadius;
  if (kind == 1)
    return ConvexPolygon::make({{-r, -r / 2}, {r, -r / 2}, {r, r / 2}, {-r, r / 2}}).value();
  std::vector<Point> corners;
  for (int k = 0; k < 64; ++k) {
    const double angle = k * std::acos(-1) / 32, size = static_cast<double>(r.value());
    corners.push_back({Length(std::llround(size * std::cos(angle))),
                       Length(std::llround(size * std::sin(angle)))});
  }
  return ConvexPolygon::make(corners).value();
}

std::vector<Pair> near_pairs(const Body& shape, bool grid) {
  const SweptVolumes volumes(roadmap(2000, grid));
  const BodyPair bodies(shape, shape);
  std::vector<Pair> pairs;
  for (const Motion& a : volumes.motions())
    for (const auto& [k, is_sure] : volumes.near(a, bodies))
      if (bodies.can_meet(a, volumes.motions()[k])) pairs.push_back({a, volumes.motions()[k]});
  return pairs;
}

void unsafe_offsets(benchmark::State& state) {
  const Body shape = body(state.range(0));
  const BodyPair pair(shape, shape);
  const std::vector<Pair> pairs = near_pairs(shape, state.range(1) != 0);
  std::size_t next = 0;
  for ([[maybe_unused]] auto _ : state) {
    const Pair& at = pairs[next++ % pairs.size()];
    benchmark::DoNotOptimize(pair.unsafe_offsets(at.a, at.b));
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(unsafe_offsets)->ArgNames({"body", "grid"})->ArgsProduct({{0, 1, 2}, {0, 1}});

void collide(benchmark::State& state) {
  const Body shape = body(state.range(0));
  const BodyPair pair(shape, shape);
  const std::vector<Pair> pairs = near_pairs(shape, state.range(1) != 0);
  std::size_t next = 0;
  for ([[maybe_unused]] auto _ : state) {
    const Pair& at = pairs[next % pairs.size()];
    const auto range = (at.a.duration + at.b.duration).value();
    const Ticks offset = Ticks(static_cast<std::int64_t>(next++) * 7919 % range) - at.b.duration;
    benchmark::DoNotOptimize(pair.collide(at.a, at.b, offset));
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(collide)->ArgNames({"body", "grid"})->ArgsProduct({{0, 1, 2}, {0, 1}});

void contact_window(benchmark::State& state) {
  const Body shape = body(state.range(0));
  const BodyPair pair(shape, shape);
  const std::vector<Pair> pairs = near_pairs(shape, state.range(1) != 0);
  std::size_t next = 0;
  for ([[maybe_unused]] auto _ : state) {
    const Pair& at = pairs[next++ % pairs.size()];
    benchmark::DoNotOptimize(pair.contact_window(at.a, at.b.from));
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(contact_window)->ArgNames({"body", "grid"})->ArgsProduct({{0, 1, 2}, {0, 1}});

void can_meet(benchmark::State& state) {
  const Body shape = body(state.range(0));
  const BodyPair pair(shape, shape);
  const std::vector<Pair> pairs = near_pairs(shape, state.range(1) != 0);
  std::size_t next = 0;
  for ([[maybe_unused]] auto _ : state) {
    const Pair& at = pairs[next++ % pairs.size()];
    benchmark::DoNotOptimize(pair.can_meet(at.a, at.b));
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(can_meet)->ArgNames({"body", "grid"})->ArgsProduct({{0, 1, 2}, {0, 1}});

// Each motion's neighbours, with the exact test of those in doubt, and how many pairs each stage
// settles.
void swept_volumes(benchmark::State& state) {
  const std::vector<Motion> motions =
      roadmap(static_cast<std::size_t>(state.range(0)), state.range(1) != 0);
  const BodyPair bodies(body(state.range(2)), body(state.range(2)));
  SweptVolumes::Tally tally;
  std::size_t num_exact = 0;
  for ([[maybe_unused]] auto _ : state) {
    const SweptVolumes volumes(motions);
    tally = {};
    num_exact = 0;
    for (const Motion& motion : motions)
      for (const auto& [k, is_sure] : volumes.near(motion, bodies, &tally))
        if (!is_sure && bodies.can_meet(motion, motions[k])) ++num_exact;
  }
  state.counters["by_boxes"] = static_cast<double>(tally.by_boxes);
  state.counters["apart"] = static_cast<double>(tally.apart);
  state.counters["by_nearest"] = static_cast<double>(tally.by_nearest);
  state.counters["by_hulls"] = static_cast<double>(tally.by_hulls);
  state.counters["sure"] = static_cast<double>(tally.sure);
  state.counters["doubtful"] = static_cast<double>(tally.doubtful);
  state.counters["of_these_meet"] = static_cast<double>(num_exact);
}
BENCHMARK(swept_volumes)
    ->ArgNames({"motions", "grid", "body"})
    ->ArgsProduct({{1000, 10000}, {0, 1}, {0, 1, 2}})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace quadrille::geometry

BENCHMARK_MAIN();
