// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "campaign/answers/merged.hpp"

namespace quadrille::cli::campaign {

/// Rows of one system: a system of the manifest with one objective.
struct Series {
  std::string name;
  std::size_t style = 0;
  std::vector<std::size_t> jobs;  ///< Those that have a row.
};
[[nodiscard]] std::vector<Series> series_of(const Merged& merged);

/// The limit of CPU time, or of wall-clock time, or the largest time there is.
[[nodiscard]] double time_limit(const Merged& merged);
/// Mean CPU seconds; what was not solved counts as twice the limit. To be compared only over
/// `common_jobs`.
[[nodiscard]] double par2(const Merged& merged, const std::vector<std::size_t>& jobs);
/// Jobs by the family of their map, and by who shares goals.
[[nodiscard]] std::map<std::string, std::vector<std::size_t>> by_family(
    const Merged& merged, const std::vector<std::size_t>& jobs);
[[nodiscard]] bool is_solved(const Merged& merged, std::size_t job);

/// By series, its jobs with an instance and a seed that every series has a row of.
[[nodiscard]] std::vector<std::vector<std::size_t>> common_jobs(const Merged& merged,
                                                                const std::vector<Series>& series);

/// Figures as SVG.
/// Systems, and the solvers of the reference on the instances that are asked.
[[nodiscard]] std::string cactus_plot(const Merged& merged, const std::vector<Series>& series);
/// One for each map: how many of its scenarios are solved, by the number of agents.
[[nodiscard]] std::string ladder_plots(const Merged& merged, const std::vector<Series>& series);
/// One for each system: the share of its runs whose gap is at most a given one, over time. Empty
/// if no row has a history.
[[nodiscard]] std::string gap_plots(const Merged& merged, const std::vector<Series>& series);

}  // namespace quadrille::cli::campaign
