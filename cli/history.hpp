// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "quadrille/core/ids.hpp"
#include "quadrille/core/progress.hpp"

namespace quadrille::cli {

/// What a search knew when: for `--history`.
class History {
 public:
  /// Costs in timesteps or ticks. Kept only if it is news.
  void note(double seconds, Cost lower_bound, std::optional<Cost> cost) {
    nlohmann::ordered_json point = {seconds, lower_bound, nullptr};
    if (cost) point[2] = *cost;
    if (!points_.empty() && points_.back()[1] == point[1] && points_.back()[2] == point[2]) return;
    points_.push_back(std::move(point));
  }
  /// [[seconds, lower bound, cost or null], ...]
  [[nodiscard]] const nlohmann::ordered_json& json() const noexcept { return points_; }

 private:
  nlohmann::ordered_json points_ = nlohmann::ordered_json::array();
};

/// Has `options.on_progress` tell the history, and then what it told before.
template <class Options>
void keep_history(Options& options, History& history) {
  options.progress_interval_s = 0.1;
  options.on_progress = [&history, also = options.on_progress](const Progress& progress) {
    // Nothing is known before that.
    if (progress.phase != Phase::set_up)
      history.note(progress.elapsed_s, progress.lower_bound, progress.cost);
    if (also) also(progress);
  };
}

}  // namespace quadrille::cli
