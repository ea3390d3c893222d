// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <utility>

#include "campaign/jobs/glob.hpp"
#include "campaign/jobs/job.hpp"
#include "campaign/jobs/manifest_yaml.hpp"
#include "campaign/jobs/stable_hash.hpp"
#include "quadrille/core/stated_outcome.hpp"
#include "quadrille/text/text_input.hpp"

namespace quadrille::cli::campaign {
namespace {

namespace fs = std::filesystem;

/// What the names of jobs and ladders need to know of a file.
struct FileFacts {
  std::string hash;         ///< Of its contents.
  std::int64_t agents = 0;  ///< Rows of a scenario, agents of a task.
};

/// A scenario, task or file, with its map if it has one.
struct Source {
  std::string family, scenario;
  std::vector<std::string> options;  ///< That name the files.
  std::string id;                    ///< Hash of the contents, and of the options of the instance.
  std::int64_t agents = 0;
  std::string share_goals;
  std::string variant = {};  ///< The options of the instance.
};

std::int64_t count_agents(const std::string& text, const std::string& name) {
  if (name.ends_with(".scen")) {
    std::int64_t rows = -1;  // the line "version"
    text::LineReader lines(text);
    while (const auto line = lines.next())
      if (line->find_first_not_of(" \t") != std::string_view::npos) ++rows;
    return std::max<std::int64_t>(rows, 0);
  }
  std::int64_t agents = 0;
  for (std::size_t at = 0; (at = text.find("<agent ", at)) != std::string::npos; ++at) ++agents;
  return agents;
}

/// "map" and "task" are no names; that of the folder is.
std::string name_of_map(const fs::path& file) {
  const std::string stem = file.stem().string();
  return stem == "map" ? file.parent_path().filename().string() : stem;
}

Objective objective_of(const std::vector<std::string>& options) {
  Objective objective = Objective::sum_of_costs;
  for (std::size_t i = 0; i < options.size(); ++i) {
    std::string value;
    if (options[i] == "--objective" && i + 1 < options.size()) value = options[i + 1];
    if (options[i].starts_with("--objective=")) value = options[i].substr(12);
    objective = parse_objective(value).value_or(objective);
  }
  return objective;
}

class Expansion {
 public:
  explicit Expansion(const Manifest& manifest) : manifest_(manifest), yaml_(manifest.file) {}

  JobList run() {
    list_.title = manifest_.title;
    list_.manifest = manifest_.hash;
    list_.limits = manifest_.limits;
    list_.slurm = manifest_.slurm;
    if (!manifest_.reference.empty()) list_.reference = absolute(manifest_.reference.string());
    for (const InstanceSet& set : manifest_.instances) {
      const auto sources = find_sources(set);
      for (const SystemSpec& system : manifest_.systems)
        for (const std::int64_t seed : manifest_.seeds) add_ladders(set, sources, system, seed);
    }
    return std::move(list_);
  }

 private:
  static std::string absolute(const std::string& path) {
    return fs::absolute(path).lexically_normal().string();
  }

  const FileFacts& facts(const InstanceSet& set, const std::string& path) {
    const auto [at, is_new] = facts_.try_emplace(path);
    if (!is_new) return at->second;
    std::ifstream in;
    if (auto error = text::open_input(path, in)) throw Refused{*error};
    const auto text = text::read_all(in, path);
    if (!text) yaml_.refuse(set.line, text.error().to_string());
    at->second.hash = StableHash().add(*text).hex();
    at->second.agents = count_agents(*text, path);
    list_.inputs.push_back({absolute(path), at->second.hash});
    return at->second;
  }

  std::vector<std::string> files(const InstanceSet& set, const std::string& pattern) {
    const fs::path path(pattern);
    auto found = matching_files(path.is_absolute() ? pattern : (manifest_.data / path).string());
    if (!found) yaml_.refuse(set.line, found.error().message);
    return *std::move(found);
  }

  void add_source(const InstanceSet& set, Source source, const std::string& graph,
                  const std::string& agents) {
    StableHash hash;
    hash.add("instance");
    if (!graph.empty()) hash.add(facts(set, graph).hash);
    hash.add(facts(set, agents).hash);
    source.options.insert(source.options.end(), set.options.begin(), set.options.end());
    for (const std::string& option : set.options) {
      hash.add(option);
      source.variant += (source.variant.empty() ? "" : " ") + option;
    }
    if (!source.share_goals.empty())
      for (const std::string& option : {std::string("--share-goals"), source.share_goals}) {
        hash.add(option);
        source.options.push_back(option);
      }
    source.id = hash.hex();
    source.agents = facts(set, agents).agents;
    sources_.push_back(std::move(source));
  }

  std::vector<Source> find_sources(const InstanceSet& set) {
    sources_.clear();
    if (!set.files.empty())
      for (const std::string& file : files(set, set.files))
        add_source(set,
                   {fs::path(file).stem().string(), "", {"--instance", absolute(file)}, "", 0, ""},
                   "", file);
    const bool grid = !set.maps.empty();
    const std::vector<std::string> own{""};
    for (const std::string& share_goals : set.share_goals.empty() ? own : set.share_goals)
      if (grid || !set.roadmaps.empty())
        for (const std::string& graph : files(set, grid ? set.maps : set.roadmaps))
          add_sources_of(set, grid, graph, share_goals);
    return std::move(sources_);
  }

  void add_sources_of(const InstanceSet& set, bool grid, const std::string& graph,
                      const std::string& share_goals) {
    const std::string family = name_of_map(graph);
    std::string pattern = grid ? set.scenarios : set.tasks;
    pattern = substitute(std::move(pattern), "map", family);
    pattern = substitute(std::move(pattern), "folder", absolute(fs::path(graph).parent_path()));
    for (const std::string& tasks : files(set, pattern)) {
      std::string scenario = fs::path(tasks).stem().string();
      if (scenario.starts_with(family + "-")) scenario = scenario.substr(family.size() + 1);
      add_source(set,
                 {family,
                  scenario,
                  {grid ? "--map" : "--roadmap", absolute(graph), grid ? "--scen" : "--task",
                   absolute(tasks)},
                  "",
                  0,
                  share_goals},
                 graph, tasks);
    }
  }

  std::vector<std::string> options_of(const SystemSpec& system, std::int64_t seed) {
    std::vector<std::string> options = system.options;
    const auto add = [&](const char* name, const std::string& value) {
      options.emplace_back(name);
      options.push_back(value);
    };
    const JobLimits& limits = manifest_.limits;
    add("--seed", std::to_string(seed));
    if (limits.cpu_s) add("--cpu-limit", fmt::format("{}", *limits.cpu_s));
    if (limits.wall_s) add("--time-limit", fmt::format("{}", *limits.wall_s));
    if (limits.memory_mib) add("--memory-limit", std::to_string(*limits.memory_mib));
    if (limits.conflicts) add("--conflict-limit", std::to_string(*limits.conflicts));
    return options;
  }

  std::size_t add_job(const InstanceSet& set, const Source& source, std::int64_t agents,
                      const SystemSpec& system, std::int64_t seed) {
    Job job;
    job.family = source.family;
    job.scenario = source.scenario;
    job.variant = source.variant;
    job.share_goals = source.share_goals;
    job.agents = agents;
    job.system = system.name;
    job.seed = seed;
    job.program = system.program;
    job.instance = source.options;
    if (agents > 0) {
      job.instance.emplace_back("--agents");
      job.instance.push_back(std::to_string(agents));
    }
    job.options = options_of(system, seed);
    job.objective = objective_of(job.options);
    job.instance_id = StableHash().add(source.id).add(agents).hex();
    job.scenario_id = source.share_goals.empty() ? source.id : job.instance_id;
    StableHash hash;
    hash.add("job").add(job.instance_id).add(job.program);
    for (const std::string& option : job.options) hash.add(option);
    job.name = hash.hex();
    const auto [other, is_new] = numbers_.emplace(job.name, list_.jobs.size());
    if (!is_new)
      yaml_.refuse(std::max(set.line, system.line),
                   fmt::format("{} asks the same as {}", describe(job),
                               describe(list_.jobs[other->second])));
    list_.jobs.push_back(std::move(job));
    return list_.jobs.size() - 1;
  }

  void add_ladders(const InstanceSet& set, const std::vector<Source>& sources,
                   const SystemSpec& system, std::int64_t seed) {
    // Scenarios of one map climb together if the rule is about them.
    const bool together = set.stop == StopRule::half || set.stop == StopRule::none;
    for (std::size_t i = 0; i < sources.size();) {
      std::size_t end = i + 1;
      const auto& first = sources[i];
      while (together && end < sources.size() && sources[end].family == first.family &&
             sources[end].share_goals == first.share_goals)
        ++end;
      add_ladder(set, {sources.data() + i, sources.data() + end}, system, seed);
      i = end;
    }
  }

  void add_ladder(const InstanceSet& set, std::pair<const Source*, const Source*> sources,
                  const SystemSpec& system, std::int64_t seed) {
    std::map<std::int64_t, std::vector<std::size_t>> rungs;  // by the number of agents
    for (const Source* source = sources.first; source != sources.second; ++source) {
      if (set.agents.all) {
        // An instance file says how many; `solve` wants to be told of a scenario.
        const std::int64_t agents = set.files.empty() ? source->agents : 0;
        rungs[agents].push_back(add_job(set, *source, agents, system, seed));
        continue;
      }
      const auto numbers = set.agents.rungs(source->agents);
      if (numbers.empty() || numbers.back() > source->agents)
        yaml_.refuse(set.agents.line, fmt::format("{} {} has {} agents only", source->family,
                                                  source->scenario, source->agents));
      for (const std::int64_t agents : numbers)
        rungs[agents].push_back(add_job(set, *source, agents, system, seed));
    }
    const auto count = static_cast<std::size_t>(sources.second - sources.first);
    Ladder ladder;
    if (set.stop == StopRule::half) ladder.allowed = count / 2;
    if (set.stop == StopRule::none) ladder.allowed = count - 1;
    std::size_t level = 0;
    for (auto& [agents, jobs] : rungs) {
      if (ladder.rungs.empty()) {
        ladder.name = list_.jobs[jobs.front()].name;
        ladder.level = level;
      }
      ladder.rungs.push_back(std::move(jobs));
      ++level;
      if (set.stop != StopRule::never) continue;
      list_.ladders.push_back(std::exchange(ladder, {}));
    }
    if (!ladder.rungs.empty()) list_.ladders.push_back(std::move(ladder));
  }

  const Manifest& manifest_;
  YamlAccess yaml_;
  JobList list_;
  std::vector<Source> sources_;
  std::map<std::string, FileFacts> facts_;
  std::map<std::string, std::size_t> numbers_;
};

}  // namespace

Result<JobList> expand(const Manifest& manifest) {
  try {
    return Expansion(manifest).run();
  } catch (const Refused& refused) {
    return refused.error;
  }
}

}  // namespace quadrille::cli::campaign
