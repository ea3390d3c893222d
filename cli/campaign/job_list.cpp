// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "campaign/job.hpp"
#include "quadrille/core/stated_outcome.hpp"
#include "quadrille/text/text_input.hpp"

namespace quadrille::cli::campaign {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kVersion = 1;

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

template <class T>
void read_optional(const Json& json, std::optional<T>& value) {
  if (!json.is_null()) value = json.get<T>();
}

Json job_json(const Job& job) {
  return {{"job", job.name},
          {"family", job.family},
          {"scenario", job.scenario},
          {"agents", job.agents},
          {"system", job.system},
          {"objective", to_string(job.objective)},
          {"seed", job.seed},
          {"program", job.program},
          {"instance", job.instance},
          {"options", job.options},
          {"instance_id", job.instance_id},
          {"scenario_id", job.scenario_id}};
}

Job read_job(const Json& json) {
  Job job;
  json.at("job").get_to(job.name);
  json.at("family").get_to(job.family);
  json.at("scenario").get_to(job.scenario);
  json.at("agents").get_to(job.agents);
  json.at("system").get_to(job.system);
  job.objective = parse_objective(json.at("objective").get<std::string>()).value();
  json.at("seed").get_to(job.seed);
  json.at("program").get_to(job.program);
  json.at("instance").get_to(job.instance);
  json.at("options").get_to(job.options);
  json.at("instance_id").get_to(job.instance_id);
  json.at("scenario_id").get_to(job.scenario_id);
  return job;
}

Json slurm_json(const SlurmOptions& slurm) {
  return {{"partition", slurm.partition},
          {"account", slurm.account},
          {"qos", slurm.qos},
          {"time", slurm.time},
          {"chunk", slurm.chunk},
          {"parallel", slurm.parallel},
          {"array_size", slurm.array_size},
          {"options", slurm.options}};
}

SlurmOptions read_slurm(const Json& json) {
  SlurmOptions slurm;
  json.at("partition").get_to(slurm.partition);
  json.at("account").get_to(slurm.account);
  json.at("qos").get_to(slurm.qos);
  json.at("time").get_to(slurm.time);
  json.at("chunk").get_to(slurm.chunk);
  json.at("parallel").get_to(slurm.parallel);
  json.at("array_size").get_to(slurm.array_size);
  json.at("options").get_to(slurm.options);
  return slurm;
}

JobList read_list(const Json& json) {
  if (json.at("quadrille") != "campaign" || json.at("version") != kVersion)
    throw std::invalid_argument("it is no list of jobs of this version");
  JobList list;
  json.at("title").get_to(list.title);
  const Json& limits = json.at("limits");
  read_optional(limits.at("cpu_s"), list.limits.cpu_s);
  read_optional(limits.at("wall_s"), list.limits.wall_s);
  read_optional(limits.at("memory_mib"), list.limits.memory_mib);
  read_optional(limits.at("conflicts"), list.limits.conflicts);
  limits.at("grace_s").get_to(list.limits.grace_s);
  list.slurm = read_slurm(json.at("slurm"));
  json.at("reference").get_to(list.reference);
  for (const Json& job : json.at("jobs")) list.jobs.push_back(read_job(job));
  for (const Json& ladder : json.at("ladders")) {
    list.ladders.push_back({ladder.at("ladder").get<std::string>(),
                            ladder.at("level").get<std::size_t>(),
                            ladder.at("rungs").get<std::vector<std::vector<std::size_t>>>(),
                            ladder.at("allowed").get<std::size_t>()});
    for (const auto& rung : list.ladders.back().rungs)
      for (const std::size_t job : rung)
        if (job >= list.jobs.size()) throw std::invalid_argument("a ladder names no job");
  }
  return list;
}

}  // namespace

std::string describe(const Job& job) {
  const std::string agents = job.agents == 0 ? "all agents" : fmt::format("{} agents", job.agents);
  return fmt::format("{} {}, {}, {}, seed {} ({})", job.family, job.scenario, agents, job.system,
                     job.seed, job.name);
}

std::string to_json(const JobList& list) {
  const JobLimits& limits = list.limits;
  const Json head = {{"quadrille", "campaign"},
                     {"version", kVersion},
                     {"title", list.title},
                     {"limits",
                      {{"cpu_s", or_null(limits.cpu_s)},
                       {"wall_s", or_null(limits.wall_s)},
                       {"memory_mib", or_null(limits.memory_mib)},
                       {"conflicts", or_null(limits.conflicts)},
                       {"grace_s", limits.grace_s}}},
                     {"slurm", slurm_json(list.slurm)},
                     {"reference", list.reference}};
  const auto dump = [](const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
  };
  // A line for each job and each ladder.
  std::string text = dump(head);
  text.pop_back();
  text += ",\n\"jobs\":[";
  for (std::size_t i = 0; i < list.jobs.size(); ++i)
    text += (i == 0 ? "\n" : ",\n") + dump(job_json(list.jobs[i]));
  text += "\n],\"ladders\":[";
  for (std::size_t i = 0; i < list.ladders.size(); ++i) {
    const Ladder& ladder = list.ladders[i];
    text += (i == 0 ? "\n" : ",\n") + dump({{"ladder", ladder.name},
                                            {"level", ladder.level},
                                            {"allowed", ladder.allowed},
                                            {"rungs", ladder.rungs}});
  }
  return text + "\n]}\n";
}

Result<JobList> read_job_list(const std::filesystem::path& path) {
  std::ifstream in;
  if (auto error = text::open_input(path, in)) return *error;
  const auto text = text::read_all(in, path.string());
  if (!text) return text.error();
  try {
    return read_list(Json::parse(*text));
  } catch (const std::exception& error) {
    return Error{
        ErrorCode::syntax, std::string("not a list of jobs: ") + error.what(), {path.string(), 0}};
  }
}

}  // namespace quadrille::cli::campaign
