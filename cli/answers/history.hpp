// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "quadrille/core/ids.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/core/progress.hpp"

namespace quadrille::cli {

/// What a search knew when: for `--history`. Time is what the limit of the search counts: CPU time
/// with a limit of CPU time, else that of the clock on the wall.
class History {
 public:
  /// The search begins now.
  void begin(const Limits& limits) {
    counts_cpu_ = limits.cpu_s.has_value();
    began_cpu_s_ = cpu_seconds();
  }
  [[nodiscard]] double cpu_s() const noexcept { return cpu_seconds() - began_cpu_s_; }
  /// "cpu" or "wall"
  [[nodiscard]] const char* clock() const noexcept { return counts_cpu_ ? "cpu" : "wall"; }

  /// Seconds since the beginning, and costs in timesteps or ticks. Kept only if it is news.
  void note(double wall_s, double cpu_s, Cost lower_bound, std::optional<Cost> cost) {
    double seconds = counts_cpu_ ? cpu_s : wall_s;
    // The search counts its own CPU time and ends with it; till then that of the process counts.
    if (!points_.empty()) seconds = std::max(seconds, points_.back()[0].get<double>());
    nlohmann::ordered_json point = {seconds, lower_bound, nullptr};
    if (cost) point[2] = *cost;
    if (!points_.empty() && points_.back()[1] == point[1] && points_.back()[2] == point[2]) return;
    points_.push_back(std::move(point));
  }
  /// [[seconds, lower bound, cost or null], ...]
  [[nodiscard]] const nlohmann::ordered_json& json() const noexcept { return points_; }

 private:
  nlohmann::ordered_json points_ = nlohmann::ordered_json::array();
  bool counts_cpu_ = false;
  double began_cpu_s_ = 0;
};

/// The keys "history" and "history_clock" of a result. `json`: JsonLines.
template <class Lines>
void add_history(Lines& json, const History& history) {
  json.add("history", history.json());
  json.add("history_clock", history.clock());
}

/// Has `options.on_progress` tell the history, and then what it told before.
template <class Options>
void keep_history(Options& options, History& history) {
  history.begin(options.limits);
  options.progress_interval_s = 0.1;
  options.on_progress = [&history, also = options.on_progress](const Progress& progress) {
    // Nothing is known before that.
    if (progress.phase != Phase::set_up)
      history.note(progress.elapsed_s, history.cpu_s(), progress.lower_bound, progress.cost);
    if (also) also(progress);
  };
}

}  // namespace quadrille::cli
