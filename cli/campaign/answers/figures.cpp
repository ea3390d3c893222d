// SPDX-License-Identifier: MIT
#include "campaign/answers/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "campaign/answers/chart.hpp"

namespace quadrille::cli::campaign {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Shorter times are all the same.
constexpr double kShortest_s = 0.01;

const Row& row_of(const Merged& merged, std::size_t job) { return *merged.rows[job]; }

/// Times of solved runs, sorted, as points of a cactus plot.
std::vector<Chart::Point> cactus_points(std::vector<double> seconds) {
  std::sort(seconds.begin(), seconds.end());
  std::vector<Chart::Point> points;
  for (std::size_t i = 0; i < seconds.size(); ++i)
    points.emplace_back(static_cast<double>(i + 1), seconds[i]);
  return points;
}

/// Gap in per cent; infinite without a plan.
double gap_of(const nlohmann::ordered_json& bound, const nlohmann::ordered_json& cost) {
  if (!bound.is_number() || !cost.is_number()) return kInfinity;
  const auto low = bound.get<double>(), high = cost.get<double>();
  if (high <= low) return 0;
  return low > 0 ? 100 * (high - low) / low : kInfinity;
}

/// The gap that was known after `seconds`.
double gap_at(const nlohmann::ordered_json& history, double seconds) {
  double gap = kInfinity;
  for (const auto& point : history) {
    if (point[0].get<double>() > seconds) break;
    gap = gap_of(point[1], point[2]);
  }
  return gap;
}

/// Histories of a series in one clock: that of the limit, if any run has it. Those of versions that
/// knew no other are in that of the wall.
struct Histories {
  std::vector<const nlohmann::ordered_json*> points;
  std::string clock;
  std::size_t left_out = 0;
};

Histories histories_of(const Merged& merged, const Series& series) {
  std::map<std::string, std::vector<const nlohmann::ordered_json*>> by_clock;
  std::size_t all = 0;
  for (const std::size_t job : series.jobs) {
    const Row& row = row_of(merged, job);
    if (row.history.is_null() || row.history.empty()) continue;
    by_clock[row.history_clock].push_back(&row.history);
    ++all;
  }
  if (all == 0) return {};
  std::string clock = merged.list.limits.cpu_s ? "cpu" : "wall";
  if (!by_clock.contains(clock)) clock = by_clock.begin()->first;
  auto& points = by_clock[clock];
  const std::size_t left_out = all - points.size();
  return {std::move(points), clock, left_out};
}

std::string gap_plot(const Merged& merged, const Series& series) {
  constexpr std::array kGaps = {0.0, 1.0, 5.0, 20.0};
  constexpr int kSteps = 60;
  const Histories histories = histories_of(merged, series);
  if (histories.points.empty()) return "";
  double limit = std::max(time_limit(merged), 10 * kShortest_s);
  for (const auto* points : histories.points)
    limit = std::max(limit, points->back()[0].get<double>());
  std::string runs = fmt::format("per cent of {} runs", histories.points.size());
  if (histories.left_out > 0)
    runs += fmt::format(", {} of another clock left out", histories.left_out);
  Chart chart(series.name,
              {histories.clock == "cpu" ? "CPU seconds" : "seconds by the clock on the wall",
               kShortest_s, limit, true},
              {runs, 0, 100});
  for (std::size_t g = 0; g < kGaps.size(); ++g) {
    std::vector<Chart::Point> points;
    for (int step = 0; step <= kSteps; ++step) {
      const double time = kShortest_s * std::pow(limit / kShortest_s, double(step) / kSteps);
      const auto closed =
          std::count_if(histories.points.begin(), histories.points.end(),
                        [&](const auto* one) { return gap_at(*one, time) <= kGaps[g]; });
      points.emplace_back(
          time, 100.0 * static_cast<double>(closed) / static_cast<double>(histories.points.size()));
    }
    chart.add_curve(kGaps[g] == 0 ? "solved" : fmt::format("gap at most {} %", kGaps[g]), g,
                    std::move(points), false);
  }
  return chart.svg(420, 276);
}

/// Times of another solver on the instances that the campaign asks.
std::vector<double> reference_seconds(const Merged& merged, std::size_t solver) {
  std::set<Reference::Key> asked;
  for (const Job& job : merged.list.jobs)
    if (job.objective == Objective::sum_of_costs) asked.insert(Reference::key_of(job));
  std::vector<double> seconds;
  for (const auto& [key, by_solver] : merged.reference.seconds)
    if (asked.contains(key) && by_solver[solver]) seconds.push_back(*by_solver[solver]);
  return seconds;
}

}  // namespace

std::vector<Series> series_of(const Merged& merged) {
  std::set<Objective> objectives;
  for (const Job& job : merged.list.jobs) objectives.insert(job.objective);
  std::vector<Series> series;
  std::map<std::string, std::size_t> numbers;
  for (std::size_t i = 0; i < merged.list.jobs.size(); ++i) {
    const Job& job = merged.list.jobs[i];
    std::string name = job.system;
    if (objectives.size() > 1) name += fmt::format(", {}", to_string(job.objective));
    const auto [at, is_new] = numbers.try_emplace(name, series.size());
    if (is_new) series.push_back({name, series.size(), {}});
    if (merged.rows[i]) series[at->second].jobs.push_back(i);
  }
  return series;
}

bool is_solved(const Merged& merged, std::size_t job) { return row_of(merged, job).solved(); }

double time_limit(const Merged& merged) {
  if (merged.list.limits.cpu_s) return *merged.list.limits.cpu_s;
  if (merged.list.limits.wall_s) return *merged.list.limits.wall_s;
  double longest = 1;
  for (const auto& row : merged.rows)
    if (row) longest = std::max(longest, row->process_cpu_s);
  return longest;
}

double par2(const Merged& merged, const std::vector<std::size_t>& jobs) {
  double sum = 0;
  for (const std::size_t job : jobs)
    sum += is_solved(merged, job) ? row_of(merged, job).process_cpu_s : 2 * time_limit(merged);
  return jobs.empty() ? 0 : sum / static_cast<double>(jobs.size());
}

std::map<std::string, std::vector<std::size_t>> by_family(const Merged& merged,
                                                          const std::vector<std::size_t>& jobs) {
  std::map<std::string, std::vector<std::size_t>> families;
  for (const std::size_t job : jobs) families[family_name(merged.list.jobs[job])].push_back(job);
  return families;
}

std::vector<std::vector<std::size_t>> common_jobs(const Merged& merged,
                                                  const std::vector<Series>& series) {
  using Key = std::pair<std::string, std::int64_t>;  // instance and seed
  const auto key = [&](std::size_t job) {
    return Key(merged.list.jobs[job].instance_id, merged.list.jobs[job].seed);
  };
  std::map<Key, std::size_t> counts;
  for (const Series& one : series)
    for (const std::size_t job : one.jobs) ++counts[key(job)];
  std::vector<std::vector<std::size_t>> common;
  for (const Series& one : series) {
    common.emplace_back();
    for (const std::size_t job : one.jobs)
      if (counts[key(job)] == series.size()) common.back().push_back(job);
  }
  return common;
}

std::string cactus_plot(const Merged& merged, const std::vector<Series>& series) {
  std::vector<std::pair<std::string, std::vector<double>>> curves;
  for (const Series& one : series) {
    curves.emplace_back(one.name, std::vector<double>());
    for (const std::size_t job : one.jobs)
      if (is_solved(merged, job)) curves.back().second.push_back(row_of(merged, job).process_cpu_s);
  }
  for (std::size_t solver = 0; solver < merged.reference.solvers.size(); ++solver)
    curves.emplace_back(merged.reference.solvers[solver] + " (reference)",
                        reference_seconds(merged, solver));
  std::size_t most = 1;
  double longest = std::max(time_limit(merged), 10 * kShortest_s);
  for (const auto& [name, seconds] : curves) {
    most = std::max(most, seconds.size());
    for (const double time : seconds) longest = std::max(longest, time);
  }
  Chart chart("instances solved within a time", {"instances solved", 0, static_cast<double>(most)},
              {"CPU seconds", kShortest_s, longest, true});
  for (std::size_t style = 0; style < curves.size(); ++style)
    chart.add_curve(curves[style].first, style, cactus_points(std::move(curves[style].second)),
                    false);
  return chart.svg(640, 380);
}

std::string ladder_plots(const Merged& merged, const std::vector<Series>& series) {
  // By map and system: by the number of agents, how many are solved.
  std::map<std::string, std::map<std::size_t, std::map<std::int64_t, int>>> maps;
  std::map<std::string, int> scenarios;
  for (const Series& one : series)
    for (const std::size_t job : one.jobs) {
      const Job& asked = merged.list.jobs[job];
      if (asked.agents == 0) continue;
      const std::string family = family_name(asked);
      int& solved = maps[family][one.style][asked.agents];
      if (is_solved(merged, job)) ++solved;
      scenarios[family] = std::max(scenarios[family], solved);
    }
  std::string text;
  for (const auto& [map, systems] : maps) {
    std::int64_t most = 1;
    for (const auto& [style, solved] : systems) most = std::max(most, solved.rbegin()->first);
    Chart chart(map, {"agents", 0, static_cast<double>(most)},
                {"scenarios solved", 0, std::max(1.0, static_cast<double>(scenarios[map]))});
    for (const auto& [style, solved] : systems) {
      std::vector<Chart::Point> points;
      for (const auto& [agents, count] : solved)
        points.emplace_back(static_cast<double>(agents), count);
      chart.add_curve(series[style].name, style, std::move(points), true);
    }
    text += chart.svg(320, 220);
  }
  return text;
}

std::string gap_plots(const Merged& merged, const std::vector<Series>& series) {
  std::string text;
  for (const Series& one : series) text += gap_plot(merged, one);
  return text;
}

}  // namespace quadrille::cli::campaign
