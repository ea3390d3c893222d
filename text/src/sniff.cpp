// SPDX-License-Identifier: MIT
#include "quadrille/text/sniff.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "quadrille/text/text_input.hpp"

namespace quadrille::text {
namespace {

constexpr std::string_view kSpace = " \t\r\n";

struct Words {
  FileKind kind;
  std::string_view what, where;
};

constexpr std::string_view kMap = "it belongs to --map, or to --roadmap";
constexpr std::string_view kScen = "it belongs to --scen, or to --task";
constexpr std::string_view kInstance = "it belongs to --instance";
constexpr std::string_view kRoadmap = "it belongs to --roadmap";
constexpr std::string_view kTask = "it belongs to --task";
constexpr std::string_view kPlan = "a plan that verify, view and convert take";
constexpr std::string_view kGridPlan =
    "a plan on a grid or a graph, which verify, view and convert take with --map or --instance";

constexpr Words kWords[] = {
    {FileKind::movingai_map, "a map of MovingAI's", kMap},
    {FileKind::movingai_scenario, "a scenario of MovingAI's", kScen},
    {FileKind::own_instance, "an instance in our own JSON", kInstance},
    {FileKind::own_roadmap, "a roadmap with agents in our own JSON", kInstance},
    {FileKind::own_plan, "a plan or a result in our own JSON", kPlan},
    {FileKind::own_export, "a file of samples that export --to csv writes", "no command reads it"},
    {FileKind::lif, "a layout in VDMA's LIF", kRoadmap},
    {FileKind::geojson, "GeoJSON, as Nav2's route server has it", kRoadmap},
    {FileKind::gml, "a graph in GML", kRoadmap},
    {FileKind::graphml, "a graph in GraphML", kRoadmap},
    {FileKind::node_link, "networkx's node-link JSON",
     "no command reads it; networkx.write_graphml and write_gml make files for --roadmap"},
    {FileKind::ccbs_grid, "a grid in CCBS's XML", kRoadmap},
    {FileKind::ccbs_task, "a task in CCBS's XML", kTask},
    {FileKind::ccbs_log, "a log of CCBS",
     "a plan on a roadmap, which verify, view and convert take with --roadmap"},
    {FileKind::ccbs_settings, "a configuration of CCBS",
     "options take their place: --radius, --neighbourhood, --cpu-limit"},
    {FileKind::nav_graph, "a nav graph of Open-RMF", kRoadmap},
    {FileKind::building, "a building of Open-RMF's traffic editor, in pixels",
     "'building_map_generator nav FILE FOLDER' of rmf_building_map_tools makes nav graphs of it, "
     "which belong to --roadmap"},
    {FileKind::rmf_scenario, "a scenario of Open-RMF's mapf", "no command reads it"},
    {FileKind::libmrp_instance, "an instance of libMultiRobotPlanning", kInstance},
    {FileKind::libmrp_roadmap, "a roadmap with agents of libMultiRobotPlanning", kInstance},
    {FileKind::libmrp_schedule, "a schedule of libMultiRobotPlanning", kGridPlan},
    {FileKind::lacam_result, "a result file of lacam", kGridPlan},
    {FileKind::visualizer_plan, "a plan of mapf-visualizer", kGridPlan},
    {FileKind::cbsh2_paths, "a file of paths of CBSH2, EECBS or LNS2", kGridPlan},
    {FileKind::tracker_csv, "a CSV of the MAPF tracker", kGridPlan},
    {FileKind::planviz, "an output of the League of Robot Runners, for PlanViz", kGridPlan},
    {FileKind::lorr_problem, "a problem of the League of Robot Runners", kInstance},
    {FileKind::lorr_locations, "robots or tasks of the League of Robot Runners",
     "the problem that names it belongs to --instance"},
    {FileKind::vda5050, "a message of VDA 5050", "states belong to export --states"},
    {FileKind::occupancy_yaml, "the description of a picture of a map, for ROS",
     "no command reads it; --map takes maps of MovingAI's"},
    {FileKind::boox, "a map or an instance of boOX", "no command reads it"},
    {FileKind::asprilo, "an instance or a plan of asprilo", "no command reads it"},
};

const Words* find_words(FileKind kind) {
  for (const Words& words : kWords)
    if (words.kind == kind) return &words;
  return nullptr;
}

/// The keys on top of a JSON or YAML file, and the short texts that belong to some of them.
class TopKeys {
 public:
  void add(std::string_view key, std::string_view value = {}) {
    constexpr std::size_t kMost = 64, kLongest = 40;
    if (keys_.size() < kMost)
      keys_.emplace_back(key.substr(0, kLongest), value.substr(0, kLongest));
  }
  [[nodiscard]] bool has(std::string_view key) const { return find(key) != nullptr; }
  template <class... Keys>
  [[nodiscard]] bool has_all(Keys... keys) const {
    return (has(keys) && ...);
  }
  template <class... Keys>
  [[nodiscard]] bool has_any(Keys... keys) const {
    return (has(keys) || ...);
  }
  [[nodiscard]] bool is(std::string_view key, std::string_view value) const {
    const auto* const found = find(key);
    return found != nullptr && found->second == value;
  }

 private:
  using Entry = std::pair<std::string, std::string>;
  [[nodiscard]] const Entry* find(std::string_view key) const {
    for (const Entry& entry : keys_)
      if (entry.first == key) return &entry;
    return nullptr;
  }
  std::vector<Entry> keys_;
};

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

/// From an opening quote to behind the closing one.
std::size_t end_of_quote(std::string_view text, std::size_t begin) {
  const char quote = text[begin];
  for (std::size_t at = begin + 1; at < text.size(); ++at) {
    if (text[at] == '\\')
      ++at;
    else if (text[at] == quote)
      return at + 1;
  }
  return text.size();
}

std::string_view unquoted(std::string_view text) {
  if (text.size() >= 2 && (text.front() == '"' || text.front() == '\'') &&
      text.back() == text.front())
    return text.substr(1, text.size() - 2);
  return text;
}

/// Of a text that begins with {, in JSON or in YAML's flow style.
TopKeys keys_in_braces(std::string_view text) {
  TopKeys keys;
  std::size_t depth = 0, word = 0, word_end = 0;  // The word read last on the first level.
  std::string_view key;
  const auto end_of_member = [&] {
    if (!key.empty()) keys.add(key, unquoted(text.substr(word, word_end - word)));
    key = {};
    word = word_end = 0;
  };
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    if (c == '"' || c == '\'') {
      const std::size_t end = end_of_quote(text, at);
      if (depth == 1) word = at, word_end = end;
      at = end;
      continue;
    }
    ++at;
    if (c == '{' || c == '[') ++depth;
    if (c == '}' || c == ']') {
      if (depth == 1) end_of_member();
      if (depth <= 1) break;
      --depth;
    }
    if (depth != 1) continue;
    if (c == ':' && key.empty()) {
      key = unquoted(text.substr(word, word_end - word));
      word = word_end = at;
    } else if (c == ',') {
      end_of_member();
    } else if (kSpace.find(c) == std::string_view::npos && c != '{' && c != '}' && c != ']') {
      if (word_end != at - 1) word = at - 1;
      word_end = at;
    }
  }
  end_of_member();
  return keys;
}

/// Of block style: what stands before a colon on lines that are not indented.
TopKeys keys_of_lines(std::string_view text) {
  TopKeys keys;
  LineReader lines(text);
  while (const auto line = lines.next()) {
    if (line->empty() || line->front() == '#' || kSpace.find(line->front()) != std::string::npos)
      continue;
    const auto colon = line->find(':');
    if (colon == std::string_view::npos) continue;
    if (colon + 1 < line->size() && (*line)[colon + 1] != ' ') continue;
    keys.add(unquoted(trimmed(line->substr(0, colon))), unquoted(trimmed(line->substr(colon + 1))));
  }
  return keys;
}

/// Whether a line, however far it is indented, begins with one of these keys.
bool has_line_with(std::string_view text, std::initializer_list<std::string_view> keys) {
  LineReader lines(text);
  while (const auto line = lines.next()) {
    const std::string_view inner = trimmed(*line);
    for (const std::string_view key : keys)
      if (inner.starts_with(key) && inner.substr(key.size()).starts_with(':')) return true;
  }
  return false;
}

FileKind own_kind(const TopKeys& keys) {
  if (keys.has("roadmap") && !keys.has("status")) return FileKind::own_roadmap;
  if (keys.has_any("grid", "graph") && !keys.has("status")) return FileKind::own_instance;
  if (keys.has_any("plan", "status") || keys.is("quadrille", "plan")) return FileKind::own_plan;
  if (keys.is("quadrille", "instance")) return FileKind::own_instance;
  return FileKind::unknown;
}

/// What both styles have in common: by the keys on top.
FileKind by_keys(const TopKeys& keys, std::string_view text) {
  if (keys.has("quadrille")) return own_kind(keys);
  if (keys.has("layouts") && keys.has("metaInformation")) return FileKind::lif;
  if (keys.is("type", "FeatureCollection") || keys.is("type", "Feature")) return FileKind::geojson;
  if (keys.has_any("actionModel", "actualPaths", "plannerPaths")) return FileKind::planviz;
  if (keys.has("mapFile") && keys.has_any("agentFile", "taskFile")) return FileKind::lorr_problem;
  if (keys.has_any("orderId", "lastNodeId") && keys.has_any("serialNumber", "nodes"))
    return FileKind::vda5050;
  if (keys.has("nodes") && keys.has_any("links", "edges") && keys.has_any("directed", "multigraph"))
    return FileKind::node_link;
  if (keys.has("levels")) {
    const bool is_building =
        !keys.has("building_name") &&
        (keys.has_any("coordinate_system", "crowd_sim", "graphs", "reference_level_name") ||
         has_line_with(text, {"measurements", "walls", "floors", "fiducials", "elevation"}));
    return is_building ? FileKind::building : FileKind::nav_graph;
  }
  if (keys.has_all("image", "resolution", "origin")) return FileKind::occupancy_yaml;
  if (keys.has("agents") && keys.has_any("occupancy", "cell_size")) return FileKind::rmf_scenario;
  if (keys.has("roadmap") && keys.has("agents")) return FileKind::libmrp_roadmap;
  if (keys.has("schedule")) return FileKind::libmrp_schedule;
  if (keys.has("map") && keys.has("agents")) return FileKind::libmrp_instance;
  if (keys.has("plan") && keys.has_any("status", "version")) return FileKind::own_plan;
  return FileKind::unknown;
}

/// By the root element and, under <root>, the first of its children that tells.
FileKind by_elements(std::string_view text) {
  const auto begins_element = [&](std::size_t at, std::string_view name) {
    return text.substr(at + 1).starts_with(name) && at + 1 + name.size() < text.size() &&
           (kSpace.find(text[at + 1 + name.size()]) != std::string_view::npos ||
            text[at + 1 + name.size()] == '>' || text[at + 1 + name.size()] == '/');
  };
  bool in_root = false;
  FileKind found = FileKind::unknown;
  for (auto at = text.find('<'); at != std::string_view::npos; at = text.find('<', at + 1)) {
    if (text.substr(at).starts_with("<!--")) {
      at = std::min(text.find("-->", at), text.size() - 1);
      continue;
    }
    if (at + 1 >= text.size() || text[at + 1] == '?' || text[at + 1] == '!') continue;
    if (!in_root) {
      if (begins_element(at, "graphml")) return FileKind::graphml;
      if (!begins_element(at, "root")) return FileKind::unknown;
      in_root = true;
    } else if (begins_element(at, "log")) {
      return FileKind::ccbs_log;
    } else if (begins_element(at, "map")) {
      found = FileKind::ccbs_grid;
    } else if (begins_element(at, "agent") && found == FileKind::unknown) {
      found = FileKind::ccbs_task;
    } else if (begins_element(at, "algorithm") && found == FileKind::unknown) {
      found = FileKind::ccbs_settings;
    }
  }
  return found;
}

bool has_field(std::string_view line, std::string_view name) {
  while (true) {
    const auto comma = line.find(',');
    if (unquoted(trimmed(line.substr(0, comma))) == name) return true;
    if (comma == std::string_view::npos) return false;
    line.remove_prefix(comma + 1);
  }
}

bool is_step(std::string_view line) {
  const auto end = line.find_first_not_of("0123456789");
  return end != 0 && end != std::string_view::npos && line.substr(end).starts_with(":(");
}

/// By the first line that says something.
FileKind by_line(std::string_view line) {
  for (const std::string_view name : {"agents=", "map_file=", "solver=", "solution="})
    if (line.starts_with(name)) return FileKind::lacam_result;
  if (line.starts_with("type ") || line.starts_with("height ")) return FileKind::movingai_map;
  if (line.starts_with("version ")) return FileKind::movingai_scenario;
  if (line.starts_with("Agent ")) return FileKind::cbsh2_paths;
  if (line.starts_with("# version for LoRR")) return FileKind::lorr_locations;
  if (line.starts_with("Locations:") || line.starts_with("V =")) return FileKind::boox;
  if (line.starts_with("init(object(") || line.starts_with("occurs(object("))
    return FileKind::asprilo;
  if (line.starts_with("agent,time,x,y")) return FileKind::own_export;
  if (has_field(line, "solution_plan")) return FileKind::tracker_csv;
  if (is_step(line)) return FileKind::visualizer_plan;
  for (const std::string_view name : {"graph", "Creator", "Version"})
    if (line.starts_with(name)) {
      const std::string_view rest = trimmed(line.substr(name.size()));
      if (rest.starts_with('[') || (name != "graph" && rest.starts_with('"')) ||
          (name == "graph" && rest.empty()))
        return FileKind::gml;
    }
  return FileKind::unknown;
}

}  // namespace

FileKind sniff(std::string_view text) {
  const auto first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return FileKind::unknown;
  text.remove_prefix(first);
  if (text.front() == '<') return by_elements(text);
  if (text.front() == '{') return by_keys(keys_in_braces(text), text);
  LineReader lines(text);
  while (const auto line = lines.next()) {
    const std::string_view inner = trimmed(*line);
    const bool is_comment = inner.starts_with('%') ||
                            (inner.starts_with('#') && !inner.starts_with("# version for LoRR"));
    if (inner.empty() || is_comment || inner == "---") continue;
    if (const FileKind kind = by_line(inner); kind != FileKind::unknown) return kind;
    break;
  }
  return by_keys(keys_of_lines(text), text);
}

std::string_view in_words(FileKind kind) noexcept {
  const Words* const words = find_words(kind);
  return words == nullptr ? std::string_view() : words->what;
}

std::string_view where_it_belongs(FileKind kind) noexcept {
  const Words* const words = find_words(kind);
  return words == nullptr ? std::string_view() : words->where;
}

std::string describe(FileKind kind) {
  return "this is " + std::string(in_words(kind)) + ": " + std::string(where_it_belongs(kind));
}

std::optional<Error> refuse_other(FileKind kind, const std::string& file,
                                  std::initializer_list<FileKind> read) {
  if (kind == FileKind::unknown || std::find(read.begin(), read.end(), kind) != read.end())
    return std::nullopt;
  return Error{ErrorCode::syntax, describe(kind), {file, 1}};
}

}  // namespace quadrille::text
