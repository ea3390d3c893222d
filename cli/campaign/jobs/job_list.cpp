// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <concepts>
#include <cstdint>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <utility>

#include "campaign/jobs/job.hpp"
#include "campaign/jobs/whole.hpp"
#include "quadrille/core/stated_outcome.hpp"
#include "quadrille/core/terminal_text.hpp"
#include "quadrille/text/document.hpp"
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
  if (json.is_null()) return;
  if constexpr (std::integral<T>)
    value = require_whole<T>(json);
  else
    value = json.get<T>();
}

Json job_json(const Job& job) {
  return {{"job", job.name},
          {"family", job.family},
          {"scenario", job.scenario},
          {"variant", job.variant},
          {"share_goals", job.share_goals},
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

/// What is wrong with a list; what() says it.
struct Wrong : std::runtime_error {
  using std::runtime_error::runtime_error;
};

void require(bool condition, const char* otherwise) {
  if (!condition) throw Wrong(otherwise);
}

bool is_name(const std::string& name) {
  return name.size() == 16 && name.find_first_not_of("0123456789abcdef") == std::string::npos;
}

Job read_job(const Json& json) {
  Job job;
  json.at("job").get_to(job.name);
  json.at("family").get_to(job.family);
  json.at("scenario").get_to(job.scenario);
  job.variant = json.value("variant", "");  // Older lists have none, of both.
  job.share_goals = json.value("share_goals", "");
  job.agents = require_whole<std::int64_t>(json.at("agents"));
  json.at("system").get_to(job.system);
  const auto objective = parse_objective(json.at("objective").get<std::string>());
  job.seed = require_whole<std::int64_t>(json.at("seed"));
  json.at("program").get_to(job.program);
  json.at("instance").get_to(job.instance);
  json.at("options").get_to(job.options);
  json.at("instance_id").get_to(job.instance_id);
  json.at("scenario_id").get_to(job.scenario_id);
  require(is_name(job.name), "a name has 16 hexadecimal digits");
  require(job.agents >= 0, "the number of agents is none");
  require(objective.has_value(), "the objective is none");
  job.objective = *objective;
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
  slurm.chunk = require_whole<std::int64_t>(json.at("chunk"));
  slurm.parallel = require_whole<std::int64_t>(json.at("parallel"));
  slurm.array_size = require_whole<std::int64_t>(json.at("array_size"));
  json.at("options").get_to(slurm.options);
  require(slurm.chunk >= 1 && slurm.parallel >= 0 && slurm.array_size >= 1,
          "a number of tasks is too small");
  return slurm;
}

JobLimits read_limits(const Json& json) {
  constexpr double kMost_s = 1e9;
  JobLimits limits;
  read_optional(json.at("cpu_s"), limits.cpu_s);
  read_optional(json.at("wall_s"), limits.wall_s);
  read_optional(json.at("memory_mib"), limits.memory_mib);
  read_optional(json.at("conflicts"), limits.conflicts);
  json.at("grace_s").get_to(limits.grace_s);
  for (const double seconds : {limits.cpu_s.value_or(1), limits.wall_s.value_or(1), limits.grace_s})
    require(seconds >= 0 && seconds <= kMost_s, "a limit of time is none");
  require(limits.memory_mib.value_or(0) >= 0 && limits.conflicts.value_or(0) >= 0,
          "a limit is below 0");
  return limits;
}

/// Reads a list, and knows where in the file it is when something is wrong.
class ListReader {
 public:
  JobList read(const Json& json) {
    require(json.is_object() && json.value("quadrille", Json()) == "campaign" &&
                json.value("version", Json()) == kVersion,
            "it is none of this version");
    at(
        "title", [&](const Json& value) { value.get_to(list_.title); }, json);
    at(
        "limits", [&](const Json& value) { list_.limits = read_limits(value); }, json);
    at(
        "slurm", [&](const Json& value) { list_.slurm = read_slurm(value); }, json);
    at(
        "reference", [&](const Json& value) { value.get_to(list_.reference); }, json);
    // Older lists have neither of the two.
    if (json.contains("manifest"))
      at(
          "manifest", [&](const Json& value) { value.get_to(list_.manifest); }, json);
    if (json.contains("inputs"))
      each(
          "inputs",
          [&](const Json& value) {
            list_.inputs.push_back(
                {value.at("file").get<std::string>(), value.at("hash").get<std::string>()});
          },
          json);
    each(
        "jobs", [&](const Json& value) { add_job(value); }, json);
    each(
        "ladders", [&](const Json& value) { add_ladder(value); }, json);
    return std::move(list_);
  }
  /// The key of the list, and the number in it, of what is being read.
  [[nodiscard]] const std::string& key() const { return key_; }
  [[nodiscard]] std::size_t index() const { return index_; }

 private:
  template <class Read>
  void at(const char* key, const Read& read, const Json& json) {
    key_ = key;
    index_ = 0;
    read(json.at(key));
  }
  template <class Read>
  void each(const char* key, const Read& read, const Json& json) {
    key_ = key;
    index_ = 0;
    require(json.at(key).is_array(), "it is no list");
    for (const Json& value : json.at(key)) {
      read(value);
      ++index_;
    }
  }

  void add_job(const Json& json) {
    list_.jobs.push_back(read_job(json));
    require(names_.insert(list_.jobs.back().name).second, "two jobs have the same name");
  }
  void add_ladder(const Json& json) {
    Ladder ladder;
    json.at("ladder").get_to(ladder.name);
    ladder.level = require_whole<std::size_t>(json.at("level"));
    ladder.allowed = require_whole<std::size_t>(json.at("allowed"));
    const Json& rungs = json.at("rungs");
    require(rungs.is_array() && !rungs.empty(), "a ladder has no rungs");
    for (const Json& rung : rungs) {
      require(rung.is_array() && !rung.empty(), "a rung has no jobs");
      auto& jobs = ladder.rungs.emplace_back();
      for (const Json& number : rung) {
        const auto job = require_whole<std::size_t>(number);
        require(job < list_.jobs.size(), "a rung names a job that is not in the list");
        require(placed_.insert(job).second, "a job stands in two places");
        jobs.push_back(job);
      }
    }
    list_.ladders.push_back(std::move(ladder));
  }

  JobList list_;
  std::set<std::string> names_;
  std::set<std::size_t> placed_;  // jobs on ladders
  std::string key_;
  std::size_t index_ = 0;
};

/// The line of the value with that key and, in a list, that number; else of the document.
long line_of(const text::Document& document, const std::string& key, std::size_t index) {
  using text::Document;
  long line = 1;
  const Document::Node end = document.next(Document::kRoot);
  for (Document::Node name = document.first(Document::kRoot); name < end;) {
    const Document::Node value = document.next(name);
    if (document.text(name) == key) {
      line = document.line(value);
      Document::Node item = document.first(value);
      if (document.kind(value) != Document::Kind::array) return line;
      while (index > 0 && item < document.next(value)) {
        item = document.next(item);
        --index;
      }
      return item < document.next(value) ? document.line(item) : line;
    }
    name = document.next(value);
  }
  return line;
}

}  // namespace

std::string family_name(const std::string& family, const std::string& variant,
                        const std::string& share_goals) {
  const std::string name = variant.empty() ? family : family + " " + variant;
  if (share_goals.empty()) return name;
  return name + ", goals shared by " + (share_goals == "all" ? "" : "each ") + share_goals;
}

std::string family_name(const Job& job) {
  return family_name(job.family, job.variant, job.share_goals);
}

std::string describe(const Job& job) {
  const std::string agents = job.agents == 0 ? "all agents" : fmt::format("{} agents", job.agents);
  const std::string shared = family_name("", job.variant, job.share_goals);
  return terminal_line(fmt::format("{} {}{}, {}, {}, seed {} ({})", job.family, job.scenario,
                                   shared, agents, job.system, job.seed, job.name));
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
                     {"reference", list.reference},
                     {"manifest", list.manifest}};
  const auto dump = [](const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
  };
  // A line for each file, job and ladder.
  const auto lines = [&](const auto& items, const auto& to_json) {
    std::string joined;
    for (const auto& item : items) joined += (joined.empty() ? "\n" : ",\n") + dump(to_json(item));
    return "[" + joined + "\n]";
  };
  std::string text = dump(head);
  text.pop_back();
  text += ",\n\"inputs\":" + lines(list.inputs, [](const InputFile& input) {
            return Json{{"file", input.path}, {"hash", input.hash}};
          });
  text += ",\n\"jobs\":" + lines(list.jobs, job_json);
  text += ",\n\"ladders\":" + lines(list.ladders, [](const Ladder& ladder) {
            return Json{{"ladder", ladder.name},
                        {"level", ladder.level},
                        {"allowed", ladder.allowed},
                        {"rungs", ladder.rungs}};
          });
  return text + "}\n";
}

Result<JobList> read_job_list(const std::filesystem::path& path) {
  std::ifstream in;
  if (auto error = text::open_input(path, in)) return *error;
  const auto text = text::read_all(in, path.string());
  if (!text) return text.error();
  // For the lines; it refuses what is no JSON, too.
  const auto document = text::parse_json(*text, path.string());
  if (!document) return document.error();
  ListReader reader;
  try {
    return reader.read(Json::parse(*text));
  } catch (const std::exception& error) {
    const bool object = document->kind(text::Document::kRoot) == text::Document::Kind::object;
    return Error{ErrorCode::syntax,
                 std::string("not a list of jobs: ") + error.what(),
                 {path.string(), object ? line_of(*document, reader.key(), reader.index()) : 1}};
  }
}

}  // namespace quadrille::cli::campaign
