// SPDX-License-Identifier: MIT
#include "campaign/jobs/manifest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <set>
#include <string_view>

#include "campaign/jobs/manifest_yaml.hpp"
#include "campaign/jobs/stable_hash.hpp"
#include "quadrille/text/document.hpp"
#include "quadrille/text/text_input.hpp"

namespace quadrille::cli::campaign {
namespace {

using YAML::Node;

constexpr std::int64_t kMaxAgents = 1'000'000;
constexpr std::int64_t kMaxSeed = 2'000'000'000;
constexpr std::int64_t kMaxNumbers = 100'000;

/// Options of `solve` that the campaign gives itself.
constexpr std::array kReserved = {
    "--map",        "--scen",         "--instance",     "--roadmap",
    "--task",       "--agents",       "--plan",         "--plan-format",
    "--plan-every", "--json",         "--quiet",        "--seed",
    "--time-limit", "--cpu-limit",    "--memory-limit", "--conflict-limit",
    "--known-plan", "--initial-plan", "--known-bound",  "--share-goals"};

std::optional<std::int64_t> natural(std::string_view text) {
  const text::Natural number = text::parse_natural(text, kMaxSeed);
  if (number.fault != text::NumberFault::none) return std::nullopt;
  return number.value;
}

/// One part between commas: N, A-B or FIRST:LAST:STEP.
bool add_part(std::string_view part, std::vector<std::int64_t>& numbers) {
  std::int64_t step = 1;
  std::optional<std::int64_t> first, last;
  if (const auto dash = part.find('-'); dash != std::string_view::npos) {
    first = natural(part.substr(0, dash));
    last = natural(part.substr(dash + 1));
  } else if (const auto colon = part.find(':'); colon != std::string_view::npos) {
    const auto second = part.find(':', colon + 1);
    if (second == std::string_view::npos) return false;
    first = natural(part.substr(0, colon));
    last = natural(part.substr(colon + 1, second - colon - 1));
    step = natural(part.substr(second + 1)).value_or(0);
  } else {
    first = last = natural(part);
  }
  if (!first || !last || step < 1 || (*last - *first) / step > kMaxNumbers) return false;
  for (std::int64_t n = *first; n <= *last; n += step) numbers.push_back(n);
  return true;
}

class ManifestReader {
 public:
  explicit ManifestReader(const std::string& file) : yaml_(file) { manifest_.file = file; }

  Manifest read(const Node& root, const std::string& data) {
    manifest_.title = std::filesystem::path(manifest_.file).stem().string();
    StopRule stop = StopRule::first;
    std::string own_data = ".", reference;
    // What instances inherit may stand below them.
    Node instances;
    yaml_.members(
        root, "a manifest",
        {{"title", [&](const Node& n) { manifest_.title = yaml_.text(n, "the title"); }},
         {"data", [&](const Node& n) { own_data = yaml_.text(n, "the data folder"); }},
         {"instances", [&](const Node& n) { instances = n; }},
         {"systems", [&](const Node& n) { read_systems(n); }},
         {"seeds", [&](const Node& n) { manifest_.seeds = numbers(n, "seeds", true); }},
         {"stop", [&](const Node& n) { stop = read_stop(n); }},
         {"limits", [&](const Node& n) { read_limits(n); }},
         {"slurm", [&](const Node& n) { read_slurm(n); }},
         {"reference", [&](const Node& n) { reference = yaml_.text(n, "the reference"); }}});
    const auto folder = std::filesystem::path(manifest_.file).parent_path();
    manifest_.data = data.empty() ? folder / own_data : std::filesystem::path(data);
    const bool is_beside = reference.starts_with("./") || reference.starts_with("../");
    if (!reference.empty()) manifest_.reference = (is_beside ? folder : manifest_.data) / reference;
    if (!instances.IsDefined() || instances.IsNull()) yaml_.refuse(root, "there are no instances");
    if (!instances.IsSequence()) yaml_.refuse(instances, "the instances have to be a list");
    for (const Node& node : instances) read_instances(node, stop);
    if (manifest_.instances.empty()) yaml_.refuse(instances, "there are no instances");
    if (manifest_.systems.empty()) manifest_.systems.push_back({0, "dpll", "", {}});
    if (manifest_.seeds.empty()) manifest_.seeds = {0};
    return std::move(manifest_);
  }

 private:
  std::vector<std::int64_t> numbers(const Node& node, const std::string& what, bool zero) {
    std::string joined = node.IsScalar() ? node.Scalar() : "";
    if (node.IsSequence())
      for (const Node& n : node)
        joined += (joined.empty() ? "" : ",") + yaml_.text(n, "each of the " + what);
    auto parsed = parse_numbers(joined, zero);
    if (!parsed)
      yaml_.refuse(node,
                   "the " + what + " have to be ascending numbers, such as 4,6,10-12,20:60:10");
    return *std::move(parsed);
  }

  std::vector<std::string> options(const Node& node) {
    auto words = yaml_.words(node, "options");
    for (const std::string& word : words) {
      const std::string name = word.substr(0, word.find('='));
      if (std::find(kReserved.begin(), kReserved.end(), name) != kReserved.end())
        yaml_.refuse(node, fmt::format("the option {} is the campaign's own", name));
    }
    return words;
  }

  std::vector<std::string> share_goals(const Node& node) {
    std::vector<std::string> values;
    const auto add = [&](const Node& n) {
      const std::string text = n.IsScalar() ? n.Scalar() : "";
      if (text != "all" && natural(text).value_or(0) < 1)
        yaml_.refuse(n,
                     "share-goals has to be all, or a whole number from 1 on, or a list of both");
      if (std::find(values.begin(), values.end(), text) != values.end())
        yaml_.refuse(n, "share-goals has the same value twice");
      values.push_back(text);
    };
    if (node.IsSequence())
      for (const Node& n : node) add(n);
    else
      add(node);
    return values;
  }

  StopRule read_stop(const Node& node) {
    const std::string text = yaml_.text(node, "stop");
    if (text == "first") return StopRule::first;
    if (text == "half") return StopRule::half;
    if (text == "none") return StopRule::none;
    if (text == "never") return StopRule::never;
    yaml_.refuse(node, "stop has to be first, half, none or never");
  }

  AgentSteps read_agents(const Node& node) {
    AgentSteps steps;
    steps.line = YamlAccess::line(node);
    if (!node.IsMap()) {
      if (node.IsScalar() && node.Scalar() == "all")
        steps.all = true;
      else
        steps.numbers = numbers(node, "numbers of agents", false);
      return steps;
    }
    const auto agents = [&](const Node& n, const char* what) {
      return yaml_.natural(n, what, 1, kMaxAgents);
    };
    yaml_.members(
        node, "agents",
        {{"from", [&](const Node& n) { steps.from = agents(n, "from"); }},
         {"to", [&](const Node& n) { steps.to = agents(n, "to"); }},
         {"step", [&](const Node& n) { steps.step = agents(n, "step"); }},
         {"factor", [&](const Node& n) { steps.factor = yaml_.number(n, "factor", 1); }}});
    if ((steps.step == 0) == (steps.factor == 0))
      yaml_.refuse(node, "agents need either a step or a factor");
    return steps;
  }

  void read_instances(const Node& node, StopRule stop) {
    InstanceSet set;
    set.line = YamlAccess::line(node);
    set.stop = stop;
    set.agents.all = true;
    const auto pattern = [&](const char* key, std::string& target) {
      return YamlAccess::Member{key, [&, key](const Node& n) { target = yaml_.text(n, key); }};
    };
    yaml_.members(node, "an entry of instances",
                  {pattern("maps", set.maps),
                   pattern("scenarios", set.scenarios),
                   pattern("roadmaps", set.roadmaps),
                   pattern("tasks", set.tasks),
                   pattern("files", set.files),
                   {"agents", [&](const Node& n) { set.agents = read_agents(n); }},
                   {"stop", [&](const Node& n) { set.stop = read_stop(n); }},
                   {"share-goals", [&](const Node& n) { set.share_goals = share_goals(n); }},
                   {"options", [&](const Node& n) { set.options = options(n); }}});
    const bool maps = !set.maps.empty() && !set.scenarios.empty();
    const bool roadmaps = !set.roadmaps.empty() && !set.tasks.empty();
    const int given = (set.maps.empty() ? 0 : 1) + (set.scenarios.empty() ? 0 : 1) +
                      (set.roadmaps.empty() ? 0 : 1) + (set.tasks.empty() ? 0 : 1) +
                      (set.files.empty() ? 0 : 1);
    if (given != (set.files.empty() ? 2 : 1) || (set.files.empty() && !maps && !roadmaps))
      yaml_.refuse(node, "instances are maps with scenarios, or roadmaps with tasks, or files");
    if (!set.files.empty() && !set.agents.all)
      yaml_.refuse(set.agents.line, "the agents of files are in the files");
    if (!set.files.empty() && !set.share_goals.empty())
      yaml_.refuse(set.line, "the goals of files are in the files");
    manifest_.instances.push_back(std::move(set));
  }

  void read_systems(const Node& node) {
    if (!node.IsMap()) yaml_.refuse(node, "systems have to be a list of 'name: options'");
    std::set<std::string> names;
    for (const auto& entry : node) {
      SystemSpec system;
      system.line = YamlAccess::line(entry.first);
      system.name = yaml_.text(entry.first, "the name of a system");
      if (!names.insert(system.name).second)
        yaml_.refuse(entry.first, "the system " + text::in_quotes(system.name) + " is there twice");
      if (entry.second.IsMap())
        yaml_.members(
            entry.second, "a system",
            {{"options", [&](const Node& n) { system.options = options(n); }},
             {"program", [&](const Node& n) { system.program = yaml_.text(n, "program"); }}});
      else
        system.options = options(entry.second);
      manifest_.systems.push_back(std::move(system));
    }
  }

  void read_limits(const Node& node) {
    JobLimits& limits = manifest_.limits;
    yaml_.members(
        node, "limits",
        {{"cpu", [&](const Node& n) { limits.cpu_s = yaml_.number(n, "cpu", 0); }},
         {"wall", [&](const Node& n) { limits.wall_s = yaml_.number(n, "wall", 0); }},
         {"memory",
          [&](const Node& n) { limits.memory_mib = yaml_.natural(n, "memory", 1, 1 << 30); }},
         {"conflicts",
          [&](const Node& n) { limits.conflicts = yaml_.natural(n, "conflicts", 0, INT64_MAX); }},
         {"grace", [&](const Node& n) { limits.grace_s = yaml_.number(n, "grace", 0); }}});
  }

  void read_slurm(const Node& node) {
    SlurmOptions& slurm = manifest_.slurm;
    const auto word = [&](const char* key, std::string& target) {
      return YamlAccess::Member{key, [&, key](const Node& n) { target = yaml_.text(n, key); }};
    };
    const auto count = [&](const char* key, std::int64_t& target, std::int64_t least) {
      return YamlAccess::Member{key, [&, key, least](const Node& n) {
                                  target = yaml_.natural(n, key, least, kMaxAgents);
                                }};
    };
    yaml_.members(node, "slurm",
                  {word("partition", slurm.partition),
                   word("account", slurm.account),
                   word("qos", slurm.qos),
                   word("time", slurm.time),
                   count("chunk", slurm.chunk, 1),
                   count("parallel", slurm.parallel, 0),
                   count("array-size", slurm.array_size, 1),
                   {"options", [&](const Node& n) { slurm.options = yaml_.words(n, "options"); }}});
  }

  YamlAccess yaml_;
  Manifest manifest_;
};

}  // namespace

std::optional<std::vector<std::int64_t>> parse_numbers(std::string_view text, bool zero) {
  std::vector<std::int64_t> numbers;
  while (true) {
    const auto comma = text.find(',');
    std::string_view part = text.substr(0, comma);
    while (part.starts_with(' ')) part.remove_prefix(1);
    if (!add_part(part, numbers)) return std::nullopt;
    if (comma == std::string_view::npos) break;
    text.remove_prefix(comma + 1);
  }
  const bool ascending =
      std::adjacent_find(numbers.begin(), numbers.end(), std::greater_equal<>()) == numbers.end();
  if (numbers.empty() || !ascending || (numbers.front() == 0 && !zero)) return std::nullopt;
  return numbers;
}

std::vector<std::int64_t> AgentSteps::rungs(std::int64_t agents_in_file) const {
  if (!numbers.empty()) return numbers;
  if (all) return {agents_in_file};
  const std::int64_t end = std::min(to.value_or(agents_in_file), agents_in_file);
  std::vector<std::int64_t> rungs;
  double exact = static_cast<double>(from);
  for (std::int64_t next = from; next <= end;) {
    rungs.push_back(next);
    exact = std::min(exact * factor, 1e9);
    next =
        step > 0 ? next + step : std::max(next + 1, static_cast<std::int64_t>(std::floor(exact)));
  }
  if (step == 0 && !rungs.empty() && rungs.back() < end) rungs.push_back(end);
  return rungs;
}

Result<Manifest> read_manifest(const std::string& file, const std::string& data) {
  std::ifstream in;
  if (auto error = text::open_input(file, in)) return *error;
  const auto text = text::read_all(in, file);
  if (!text) return text.error();
  // The limits of all YAML: depth and size, no anchors and aliases. What passes is a tree.
  if (const auto checked = text::parse_yaml(*text, file); !checked) return checked.error();
  try {
    Manifest manifest = ManifestReader(file).read(YAML::Load(*text), data);
    manifest.hash = StableHash().add(*text).hex();
    return manifest;
  } catch (const Refused& refused) {
    return refused.error;
  } catch (const YAML::Exception& error) {
    const long line = error.mark.is_null() ? 0 : error.mark.line + 1;
    return Error{
        ErrorCode::syntax, "not valid YAML: " + text::printable(error.msg, 200), {file, line}};
  }
}

}  // namespace quadrille::cli::campaign
