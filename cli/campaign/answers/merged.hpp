// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "campaign/jobs/job.hpp"
#include "campaign/run/results.hpp"
#include "campaign/run/row.hpp"

namespace quadrille::cli::campaign {

/// What other solvers found, from a CSV file with the columns map, scenario (or random_scen, a
/// number), agents, optimal_sum_of_costs (or cost), variant and share_goals (or none), and any
/// *_cpu_s: seconds, empty for a run that was not made, ">30" for one that was not solved.
struct Reference {
  struct Key {
    std::string family, scenario, variant, share_goals;
    std::int64_t agents;
    friend auto operator<=>(const Key&, const Key&) = default;
  };
  [[nodiscard]] static Key key_of(const Job& job) {
    return {job.family, job.scenario, job.variant, job.share_goals, job.agents};
  }
  std::vector<std::string> solvers;
  std::map<Key, std::int64_t> costs;  ///< Whole ones: those of continuous time are rounded.
  std::map<Key, std::vector<std::optional<double>>> seconds;  ///< By solver; only solved ones.
};
/// Errors (io, syntax), with file and line.
[[nodiscard]] Result<Reference> read_reference(const std::string& path);

/// All that a campaign has found.
struct Merged {
  JobList list;
  std::vector<std::optional<Row>> rows;  ///< By job; without plans.
  std::size_t missing = 0;               ///< Jobs that are yet to be run.
  Damage damage;
  std::size_t foreign = 0;
  Reference reference;
  /// By job, on grids: the motions of the agents, one line each, of plans that are the best of
  /// their instance at that time.
  std::map<std::size_t, std::string> motions;
};

/// Contradictions between answers, each a sentence that names the jobs: a bound above a cost,
/// infeasible with a plan, an optimal cost that is another than the reference's. Also between the
/// first k agents of a scenario and more of them, who cannot cost less. Empty if all is well.
[[nodiscard]] std::vector<std::string> contradictions(const Merged& merged);

/// One line per job that has a row.
[[nodiscard]] std::string csv_table(const Merged& merged);
[[nodiscard]] std::string jsonl_table(const Merged& merged);
/// For the MAPF tracker: per instance on a grid with a plan the best bound and plan.
[[nodiscard]] std::string tracker_table(const Merged& merged);
/// An HTML file that needs nothing else.
[[nodiscard]] std::string html_report(const Merged& merged);

}  // namespace quadrille::cli::campaign
