// SPDX-License-Identifier: MIT
#include "campaign/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "campaign/chart.hpp"

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

/// After so many seconds.
double gap_at(const nlohmann::ordered_json& history, double seconds) {
  double gap = kInfinity;
  for (const auto& point : history) {
    if (point[0].get<double>() > seconds) break;
    gap = gap_of(point[1], point[2]);
  }
  return gap;
}

bool is_history(const nlohmann::ordered_json& json) {
  return json.is_array() && std::all_of(json.begin(), json.end(), [](const auto& point) {
           return point.is_array() && point.size() == 3 && point[0].is_number();
         });
}

std::string gap_plot(const Merged& merged, const Series& series) {
  constexpr std::array kGaps = {0.0, 1.0, 5.0, 20.0};
  constexpr int kSteps = 60;
  std::vector<const nlohmann::ordered_json*> histories;
  for (const std::size_t job : series.jobs)
    if (is_history(row_of(merged, job).history)) histories.push_back(&row_of(merged, job).history);
  if (histories.empty()) return "";
  const double limit = std::max(time_limit(merged), 10 * kShortest_s);
  Chart chart(series.name, {"seconds", kShortest_s, limit, true}, {"per cent of runs", 0, 100});
  for (std::size_t g = 0; g < kGaps.size(); ++g) {
    std::vector<Chart::Point> points;
    for (int step = 0; step <= kSteps; ++step) {
      const double time = kShortest_s * std::pow(limit / kShortest_s, double(step) / kSteps);
      const auto closed = std::count_if(histories.begin(), histories.end(), [&](const auto* one) {
        return gap_at(*one, time) <= kGaps[g];
      });
      points.emplace_back(
          time, 100.0 * static_cast<double>(closed) / static_cast<double>(histories.size()));
    }
    chart.add_curve(kGaps[g] == 0 ? "solved" : fmt::format("gap at most {} %", kGaps[g]), g,
                    std::move(points), false);
  }
  return chart.svg(420, 340);
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
  for (const std::size_t job : jobs) families[merged.list.jobs[job].family].push_back(job);
  return families;
}

std::string cactus_plot(const Merged& merged, const std::vector<Series>& series) {
  std::vector<std::pair<const Series*, std::vector<Chart::Point>>> curves;
  std::size_t most = 1;
  for (const Series& one : series) {
    std::vector<double> seconds;
    for (const std::size_t job : one.jobs)
      if (is_solved(merged, job)) seconds.push_back(row_of(merged, job).process_cpu_s);
    most = std::max(most, seconds.size());
    curves.emplace_back(&one, cactus_points(std::move(seconds)));
  }
  Chart chart("instances solved within a time", {"instances solved", 0, static_cast<double>(most)},
              {"CPU seconds", kShortest_s, std::max(time_limit(merged), 10 * kShortest_s), true});
  for (auto& [one, points] : curves)
    chart.add_curve(one->name, one->style, std::move(points), false);
  return chart.svg(640, 380 + 16 * static_cast<double>(series.size()));
}

std::string ladder_plots(const Merged& merged, const std::vector<Series>& series) {
  // By map and system: by the number of agents, how many are solved.
  std::map<std::string, std::map<std::size_t, std::map<std::int64_t, int>>> maps;
  std::map<std::string, int> scenarios;
  for (const Series& one : series)
    for (const std::size_t job : one.jobs) {
      const Job& asked = merged.list.jobs[job];
      if (asked.agents == 0) continue;
      int& solved = maps[asked.family][one.style][asked.agents];
      if (is_solved(merged, job)) ++solved;
      scenarios[asked.family] = std::max(scenarios[asked.family], solved);
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
    text += chart.svg(320, 220 + 16 * static_cast<double>(systems.size()));
  }
  return text;
}

std::string gap_plots(const Merged& merged, const std::vector<Series>& series) {
  std::string text;
  for (const Series& one : series) text += gap_plot(merged, one);
  return text;
}

}  // namespace quadrille::cli::campaign
