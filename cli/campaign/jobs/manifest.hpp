// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "quadrille/core/result.hpp"

namespace quadrille::cli::campaign {

/// When a ladder of agents ends: at the first instance that is not solved; when less than half of a
/// map's scenarios are, or none; or with its last rung.
enum class StopRule { first, half, none, never };

/// Numbers of agents: a list, or what becomes one when the size of the scenario is known.
struct AgentSteps {
  long line = 0;
  bool all = false;                   ///< All agents of the file, and no ladder.
  std::vector<std::int64_t> numbers;  ///< Ascending. Empty: from, to, step or factor.
  std::int64_t from = 1;
  std::optional<std::int64_t> to;  ///< Else, and beyond it: all agents of the file.
  std::int64_t step = 0;           ///< 0: geometric, by the factor, and with `to` as its last rung.
  double factor = 0;               ///< > 1.

  /// The rungs for a file with this number of agents. A list is given as it is.
  [[nodiscard]] std::vector<std::int64_t> rungs(std::int64_t agents_in_file) const;
};

/// Instances of one entry of the manifest. Patterns are those of the shell, with {map} for the name
/// of the map and {folder} for its folder.
struct InstanceSet {
  long line = 0;
  std::string maps, scenarios;  ///< Or roadmaps and their tasks, or files.
  std::string roadmaps, tasks;
  std::string files;
  AgentSteps agents;
  StopRule stop = StopRule::first;
  std::vector<std::string> options;  ///< Of the instance, such as --passable S.
  /// Values of --share-goals, each of which makes instances of its own; empty: each agent has the
  /// goal of its row.
  std::vector<std::string> share_goals;
};

struct SystemSpec {
  long line = 0;
  std::string name;
  std::string program;  ///< Empty: this program.
  std::vector<std::string> options;
};

/// Of each job. Without a wall-clock limit a job ends after 20 times its CPU limit and a minute, if
/// it has one.
struct JobLimits {
  std::optional<double> cpu_s, wall_s;
  std::optional<std::int64_t> memory_mib, conflicts;
  double grace_s = 10;  ///< After a limit, before the job is ended from outside.
};

struct SlurmOptions {
  std::string partition, account, qos, time;
  std::int64_t chunk = 1;          ///< Ladders per task of an array.
  std::int64_t parallel = 0;       ///< Tasks of an array that run at a time; 0: any number.
  std::int64_t array_size = 1000;  ///< Tasks of an array at most, the cluster's MaxArraySize.
  std::vector<std::string> options;
};

struct Manifest {
  std::string file;
  std::string hash;  ///< Of its contents: StableHash.
  std::string title;
  std::filesystem::path data;  ///< What patterns are relative to.
  std::vector<InstanceSet> instances;
  std::vector<SystemSpec> systems;
  std::vector<std::int64_t> seeds;
  JobLimits limits;
  SlurmOptions slurm;
  /// A CSV file with optimal costs and other solvers' times; empty: none.
  std::filesystem::path reference;
};

/// Reads a manifest; docs/campaign.md describes it. Errors (io, syntax, out_of_range), with file
/// and line: whatever is not a key, or not a value of its key. `data`: overrules that of the
/// manifest.
[[nodiscard]] Result<Manifest> read_manifest(const std::string& file, const std::string& data);

/// "10:60:10", "4,6,10-12" -> ascending positive numbers (or 0 with `zero`); nullopt if it is none.
[[nodiscard]] std::optional<std::vector<std::int64_t>> parse_numbers(std::string_view text,
                                                                     bool zero);

}  // namespace quadrille::cli::campaign
