// SPDX-License-Identifier: MIT
#include "quadrille/exports/naming.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <utility>

#include "quadrille/text/document.hpp"
#include "quadrille/text/text_input.hpp"

namespace quadrille::exports {
namespace {

using text::Document;

Error wrong_names(const std::string& message) { return {ErrorCode::invalid_instance, message, {}}; }

Error called_alike(const std::string& things, std::size_t one, std::size_t other,
                   const std::string& name) {
  return wrong_names(things + " " + std::to_string(one) + " and " + std::to_string(other) +
                     " are both called " + text::in_quotes(name));
}

class NamingReader {
 public:
  NamingReader(const Document& document, Naming naming)
      : document_(document), check_(document), naming_(std::move(naming)) {}

  Result<Naming> run(std::size_t num_agents, std::size_t num_vertices) {
    std::optional<Document::Node> manufacturer, map, agents, vertices;
    if (!check_.members(Document::kRoot, {{"manufacturer", &manufacturer, false},
                                          {"map", &map, false},
                                          {"agents", &agents, false},
                                          {"vertices", &vertices, false}}) ||
        !read_text(manufacturer, naming_.manufacturer) || !read_text(map, naming_.map) ||
        !read_agents(agents, num_agents) || !read_vertices(vertices, num_vertices))
      return check_.error();
    return std::move(naming_);
  }

 private:
  bool read_text(const std::optional<Document::Node>& node, std::string& name) {
    std::optional<std::string> read;
    if (!node) return true;
    if (!text::read_name(check_, document_, *node, read)) return false;
    name = *read;
    return !name.empty() || check_.fail(*node, "the name is empty");
  }
  bool read_agents(const std::optional<Document::Node>& node, std::size_t num_agents) {
    if (!node) return true;
    auto& agents = naming_.names.agents;
    agents.clear();
    if (!text::read_names(check_, document_, *node, agents)) return false;
    return agents.size() <= num_agents ||
           check_.fail(*node, ErrorCode::invalid_instance,
                       std::to_string(agents.size()) + " names, but " + std::to_string(num_agents) +
                           " agents");
  }
  bool read_vertices(const std::optional<Document::Node>& node, std::size_t num_vertices) {
    if (!node) return true;
    naming_.names.vertices.clear();
    return text::read_vertex_names(check_, document_, *node, num_vertices, naming_.names.vertices);
  }

  const Document& document_;
  text::Checker check_;
  Naming naming_;
};

/// A text without its quotes; what else is a name as it stands.
std::string node_name(const text::Names& names, VertexId v) {
  if (v.index() >= names.vertices.size()) return "v" + std::to_string(v.value());
  const std::string& name = names.vertices[v.index()];
  return name.starts_with('"') ? nlohmann::json::parse(name).get<std::string>() : name;
}

bool is_serial_number(const std::string& text) {
  const auto is_part = [](unsigned char c) {
    return c < 0x80 &&
           (std::isalnum(c) != 0 ||
            std::string_view("_.:-").find(static_cast<char>(c)) != std::string_view::npos);
  };
  return !text.empty() && std::all_of(text.begin(), text.end(), is_part);
}

/// Of the vertices that the plan goes to.
Result<IdVector<VertexId, std::string>> node_names(const text::Names& names,
                                                   const continuous::Plan& plan,
                                                   const continuous::Roadmap& roadmap) {
  IdVector<VertexId, std::string> nodes(roadmap.num_vertices());
  std::map<std::string, VertexId> known;
  for (const continuous::Path& path : plan.paths)
    for (const continuous::Stop& stop : path) {
      const VertexId v = stop.vertex;
      if (!nodes[v].empty()) continue;
      nodes[v] = node_name(names, v);
      if (nodes[v].empty())
        return wrong_names("the name of vertex " + std::to_string(v.value()) + " is empty");
      const auto [other, is_new] = known.emplace(nodes[v], v);
      if (!is_new && roadmap.position(other->second) != roadmap.position(v))
        return called_alike("vertices", other->second.value(), v.value(), nodes[v]);
    }
  return nodes;
}

}  // namespace

Result<RobotNames> robot_names(const text::Names& names, std::size_t num_agents) {
  RobotNames robots;
  std::map<std::string, AgentId> known;
  for (const AgentId agent : IdRange<AgentId>(num_agents)) {
    const std::string* const given = names.agent(agent.index());
    robots.push_back(given != nullptr ? *given : "agent" + std::to_string(agent.value()));
    const auto [other, is_new] = known.emplace(robots[agent], agent);
    if (!is_new) return called_alike("agents", other->second.value(), agent.value(), robots[agent]);
  }
  return robots;
}

Result<Naming> parse_naming(std::string_view text, const std::string& file, Naming own,
                            std::size_t num_agents, std::size_t num_vertices) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  const bool is_json = begin != std::string_view::npos && text[begin] == '{';
  const auto document = is_json ? text::parse_json(text, file) : text::parse_yaml(text, file);
  if (!document) return document.error();
  own.source = file;
  return NamingReader(*document, std::move(own)).run(num_agents, num_vertices);
}

Result<OrderNames> order_names(const Naming& naming, const continuous::Plan& plan,
                               const continuous::Roadmap& roadmap, const std::string& order) {
  OrderNames names;
  names.manufacturer = naming.manufacturer;
  names.map = naming.map;
  auto robots = robot_names(naming.names, plan.paths.size());
  auto nodes = node_names(naming.names, plan, roadmap);
  std::optional<Error> wrong;
  if (!robots) wrong = robots.error();
  if (!wrong && !nodes) wrong = nodes.error();
  if (wrong) {
    wrong->where.file = naming.source;
    return *std::move(wrong);
  }
  names.robots = std::move(robots).value();
  names.nodes = std::move(nodes).value();
  for (const std::string& robot : names.robots) {
    if (!is_serial_number(robot))
      return Error{ErrorCode::invalid_instance,
                   text::in_quotes(robot) +
                       " is no serial number of VDA 5050: A-Z a-z 0-9 _ . : - (--names has others)",
                   {naming.source, 0}};
    names.orders.push_back(order.empty() ? robot : order + "-" + robot);
  }
  return names;
}

bool is_time_stamp(std::string_view text) {
  constexpr std::string_view kForm = "0000-00-00T00:00:00.000Z";
  if (text.size() != kForm.size()) return false;
  for (std::size_t k = 0; k < kForm.size(); ++k)
    if (kForm[k] == '0' ? text[k] < '0' || text[k] > '9' : text[k] != kForm[k]) return false;
  const auto two = [&](std::size_t at) { return 10 * (text[at] - '0') + (text[at + 1] - '0'); };
  const int year = 100 * two(0) + two(2), month = two(5), day = two(8);
  const bool is_leap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
  constexpr int kDays[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  if (month < 1 || month > 12 || day < 1) return false;
  if (day > kDays[month - 1] + (month == 2 && is_leap ? 1 : 0)) return false;
  return two(11) < 24 && two(14) < 60 && two(17) < 60;
}

}  // namespace quadrille::exports
