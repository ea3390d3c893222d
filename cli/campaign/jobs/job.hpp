// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "campaign/jobs/manifest.hpp"
#include "quadrille/core/outcome.hpp"
#include "quadrille/core/result.hpp"

namespace quadrille::cli::campaign {

/// One run of a solver.
struct Job {
  /// 16 hexadecimal digits: a hash of the contents of the instance's files, the number of agents,
  /// all options, the seed, the limits, and the program as the manifest names it. Where the files
  /// are does not count.
  std::string name;
  std::string family;       ///< Of the map: "empty-8-8".
  std::string scenario;     ///< "random-1".
  std::string variant;      ///< Options of its entry: "--neighbourhood 3"; empty without.
  std::string share_goals;  ///< "all" or a number, of --share-goals; empty without.
  std::int64_t agents = 0;  ///< 0: all of the file.
  std::string system;
  Objective objective = Objective::sum_of_costs;
  std::int64_t seed = 0;
  std::string program;                ///< Empty: this one.
  std::vector<std::string> instance;  ///< Options of the command line that name it.
  std::vector<std::string> options;   ///< The others: system, seed and limits.
  /// Equal for the jobs on one instance, whatever solves it and what is minimised.
  std::string instance_id;
  /// Equal for the instances that are the first agents of the same scenario. With goals that are
  /// shared more agents bring more goals, and may cost less: then it is that of the instance.
  std::string scenario_id;
};

/// Jobs in the order in which they are done: the rungs one after the other, the next one only if
/// enough of the last one were solved.
struct Ladder {
  std::string name;       ///< Of its first job.
  std::size_t level = 0;  ///< Of its first rung; ladders of a list that never stops have one rung.
  std::vector<std::vector<std::size_t>> rungs;  ///< Numbers of jobs.
  /// A rung is the last one if more of its jobs than this are not solved.
  std::size_t allowed = 0;
};

/// A file that jobs rest on, as it was when they were made.
struct InputFile {
  std::string path;  ///< As options of jobs name it.
  std::string hash;  ///< Of its contents: StableHash.
};

/// All that a campaign asks.
struct JobList {
  std::string title;
  JobLimits limits;
  SlurmOptions slurm;
  std::string reference;  ///< A file; empty: none.
  std::string manifest;   ///< Hash of its contents; empty in lists of older versions.
  /// Maps, scenarios, roadmaps, tasks and instances; empty in the same lists.
  std::vector<InputFile> inputs;
  std::vector<Job> jobs;
  std::vector<Ladder> ladders;
};

/// The family, its variant, and who shares goals: "empty-8-8 --leave", "empty-8-8, goals shared by
/// all", or "... by each 10".
[[nodiscard]] std::string family_name(const std::string& family, const std::string& variant,
                                      const std::string& share_goals);
[[nodiscard]] std::string family_name(const Job& job);

/// "empty-8-8 random-1, 12 agents, dpll, seed 0 (0123456789abcdef)"
[[nodiscard]] std::string describe(const Job& job);

/// The list as a file, so that tasks on other machines need not expand the manifest again.
[[nodiscard]] std::string to_json(const JobList& list);
/// Errors, with file and line: io, syntax.
[[nodiscard]] Result<JobList> read_job_list(const std::filesystem::path& path);

/// An error that names a file which is not what it was when the list was made: the manifest, if one
/// is named, or an input of the jobs numbered, of all jobs without numbers. Nullopt: none is known
/// to have changed. O(size of the files).
[[nodiscard]] std::optional<Error> find_change(
    const JobList& list, const std::string& manifest,
    const std::optional<std::vector<std::size_t>>& jobs = std::nullopt);

/// The jobs of a manifest. `limits` and seeds become options. Errors, with file and line: a pattern
/// that matches nothing, a file that cannot be read, a list of agents that a scenario does not
/// have, two jobs that ask the same.
[[nodiscard]] Result<JobList> expand(const Manifest& manifest);

}  // namespace quadrille::cli::campaign
