// SPDX-License-Identifier: MIT
#include <ostream>
#include <utility>

#include "formats/json_numbers.hpp"
#include "formats/plan_codecs.hpp"
#include "quadrille/continuous/quantise.hpp"
#include "quadrille/text/document.hpp"
#include "quadrille/text/text_input.hpp"

namespace quadrille::continuous {
namespace {

using text::Document;
using Node = Document::Node;
constexpr std::int64_t kPlanJsonVersion = 1;
/// Later times are none that a plan could have.
constexpr Ticks kMaxTick = Ticks{1} << 60;

class JsonPlanReader {
 public:
  JsonPlanReader(const Document& document, const Instance& instance)
      : document_(document), check_(document), instance_(instance) {}

  Result<PlanFile> run() {
    std::optional<Node> kind, version, resolution, objective, cost, ticks, plan, agents, status;
    std::optional<Node> bound, bound_ticks;
    // Of a result; not read.
    std::optional<Node> unread[9];
    if (!check_.members(Document::kRoot, {{"quadrille", &kind, false},
                                          {"version", &version, false},
                                          {"resolution", &resolution},
                                          {"objective", &objective, false},
                                          {"cost", &cost, false},
                                          {"cost_ticks", &ticks, false},
                                          {"plan", &plan, false},
                                          {"agents", &agents, false},
                                          {"status", &status, false},
                                          {"lower_bound", &bound, false},
                                          {"lower_bound_ticks", &bound_ticks, false},
                                          {"statistics", &unread[0], false},
                                          {"seed", &unread[1], false},
                                          {"options", &unread[2], false},
                                          {"stop_reason", &unread[3], false},
                                          {"internal_error", &unread[4], false},
                                          {"explanation", &unread[5], false},
                                          {"claim", &unread[6], false},
                                          {"radii", &unread[7], false},
                                          {"least_clearance", &unread[8], false}}) ||
        !read_kind(kind, version, status) || !read_resolution(*resolution) ||
        !read_cost(objective, cost, ticks) || !read_bound(objective, bound, bound_ticks))
      return check_.error();
    if (!plan || document_.kind(*plan) == Document::Kind::null) {
      check_.fail(plan.value_or(Document::kRoot), ErrorCode::invalid_plan, "there is no plan");
      return check_.error();
    }
    if (!read_paths(*plan) || (agents && !read_agents(*agents))) return check_.error();
    return std::move(file_);
  }

 private:
  /// A plan states its own version; a result has a status, and the version is the program's.
  bool read_kind(std::optional<Node> kind, std::optional<Node> version,
                 std::optional<Node> status) {
    std::string_view name = status ? "result" : "plan";
    std::int64_t number = 0;
    if (kind && !check_.text(*kind, name)) return false;
    if (status && !read_status(*status)) return false;
    if (name == "result") return true;
    if (name != "plan")
      return check_.fail(*kind, "expected 'plan' or 'result', found " + text::in_quotes(name));
    if (!version) return check_.fail(Document::kRoot, "the key 'version' is missing");
    return check_.integer(*version, kPlanJsonVersion, kPlanJsonVersion, number);
  }

  bool read_resolution(Node node) {
    double value = 0;
    if (!check_.number(node, value)) return false;
    if (value == instance_.resolution()) return true;
    return check_.fail(node, ErrorCode::invalid_plan,
                       "the resolution of the instance is " + json_number(instance_.resolution()));
  }

  [[nodiscard]] bool is_null(const std::optional<Node>& node) const {
    return !node || document_.kind(*node) == Document::Kind::null;
  }

  bool read_status(Node node) {
    std::string_view text;
    if (!check_.text(node, text)) return false;
    file_.stated.status = parse_status(text);
    return file_.stated.status ||
           check_.fail(node, "expected 'optimal', 'feasible', 'infeasible' or 'unknown', found " +
                                 text::in_quotes(text));
  }

  bool read_cost(std::optional<Node> objective, std::optional<Node> cost,
                 std::optional<Node> ticks) {
    std::string_view name;
    if (objective && !check_.text(*objective, name)) return false;
    const auto known = parse_objective(name);
    if (objective && !known)
      return check_.fail(*objective,
                         "expected 'sum-of-costs' or 'makespan', found " + text::in_quotes(name));
    if (known) file_.stated.objective = *known;
    if (is_null(ticks) && is_null(cost)) return true;
    if (is_null(ticks)) return check_.fail(*cost, "a cost needs the key 'cost_ticks'");
    if (!objective) return check_.fail(*ticks, "a cost needs the key 'objective'");
    Cost value = 0;
    if (!check_.integer(*ticks, 0, INT64_MAX, value)) return false;
    if (!is_null(cost) && !agrees(*cost, value)) return false;
    (*known == Objective::makespan ? file_.stated.makespan : file_.stated.sum_of_costs) = value;
    return true;
  }

  bool read_bound(std::optional<Node> objective, std::optional<Node> bound,
                  std::optional<Node> ticks) {
    if (is_null(ticks) && is_null(bound)) return true;
    if (is_null(ticks))
      return check_.fail(*bound, "a lower bound needs the key 'lower_bound_ticks'");
    if (!objective) return check_.fail(*ticks, "a lower bound needs the key 'objective'");
    Cost value = 0;
    if (!check_.integer(*ticks, 0, INT64_MAX, value)) return false;
    file_.stated.lower_bound = value;
    return is_null(bound) || agrees(*bound, value);
  }

  /// A time that is stated beside its ticks.
  bool agrees(Node node, std::int64_t units) {
    double value = 0;
    if (!check_.number(node, value)) return false;
    if (is_about(value, units, instance_.resolution())) return true;
    return check_.fail(node, ErrorCode::invalid_plan,
                       "this is not " + std::to_string(units) + " times the resolution");
  }

  bool read_paths(Node plan) {
    if (!check_.array(plan, "paths")) return false;
    for (Node p = document_.first(plan); p < document_.next(plan); p = document_.next(p)) {
      if (!check_.array(p, "stops")) return false;
      Path path;
      for (Node s = document_.first(p); s < document_.next(p); s = document_.next(s)) {
        path.emplace_back();
        if (!read_stop(s, document_.next(s) == document_.next(p), path.back())) return false;
      }
      if (path.empty()) return check_.fail(p, ErrorCode::invalid_plan, "the path is empty");
      file_.plan.paths.push_back(std::move(path));
    }
    return true;
  }

  bool read_stop(Node node, bool is_last, Stop& stop) {
    std::optional<Node> vertex, at, arrive, arrive_ticks, depart, depart_ticks;
    std::int64_t number = 0;
    if (!check_.members(node, {{"vertex", &vertex},
                               {"at", &at, false},
                               {"arrive", &arrive, false},
                               {"arrive_ticks", &arrive_ticks},
                               {"depart", &depart, false},
                               {"depart_ticks", &depart_ticks, !is_last}}) ||
        !check_.integer(*vertex, 0, INT64_MAX, number))
      return false;
    if (number >= static_cast<std::int64_t>(instance_.roadmap().num_vertices()))
      return check_.fail(*vertex, ErrorCode::invalid_plan,
                         "there is no vertex " + std::to_string(number) + " among " +
                             std::to_string(instance_.roadmap().num_vertices()));
    stop.vertex = VertexId(static_cast<std::size_t>(number));
    if (at && !read_place(*at, instance_.roadmap().position(stop.vertex))) return false;
    if (!check_.integer(*arrive_ticks, 0, kMaxTick, stop.arrive)) return false;
    if (arrive && !agrees(*arrive, stop.arrive)) return false;
    stop.depart = stop.arrive;
    if (is_last) {
      if (!depart && !depart_ticks) return true;
      return check_.fail(depart ? *depart : *depart_ticks, ErrorCode::invalid_plan,
                         "an agent stays at its last stop for ever");
    }
    if (!check_.integer(*depart_ticks, 0, kMaxTick, stop.depart)) return false;
    return !depart || agrees(*depart, stop.depart);
  }

  bool read_place(Node node, const Point& point) {
    if (!check_.array(node, "coordinates", 2)) return false;
    const Node x = document_.first(node);
    return agrees(x, point.x) && agrees(document_.next(x), point.y);
  }

  bool read_agents(Node agents) {
    std::int64_t count = 0;
    if (!check_.integer(agents, 0, INT64_MAX, count)) return false;
    if (count == static_cast<std::int64_t>(file_.plan.paths.size())) return true;
    return check_.fail(agents, ErrorCode::invalid_plan,
                       std::to_string(count) + " agents, but " +
                           std::to_string(file_.plan.paths.size()) + " paths");
  }

  const Document& document_;
  text::Checker check_;
  const Instance& instance_;
  PlanFile file_;
};

}  // namespace

Result<PlanFile> read_json_plan(const std::string& text, const std::string& file,
                                const Instance& instance) {
  const auto document = text::parse_json(text, file);
  if (!document) return document.error();
  return JsonPlanReader(*document, instance).run();
}

std::string plan_to_json(const Instance& instance, const Plan& plan) {
  const auto number = [&](std::int64_t units) {
    return json_number(in_input_units(units, instance.resolution()));
  };
  std::string text = "[";
  for (const Path& path : plan.paths) {
    text += text.size() > 1 ? ",\n    [" : "\n    [";
    for (std::size_t k = 0; k < path.size(); ++k) {
      const Stop& stop = path[k];
      const Point& at = instance.roadmap().position(stop.vertex);
      text += (k == 0 ? "{" : ", {");
      text += "\"vertex\": " + std::to_string(stop.vertex.index()) + ", \"at\": [" + number(at.x) +
              ", " + number(at.y) + "], \"arrive\": " + number(stop.arrive) +
              ", \"arrive_ticks\": " + std::to_string(stop.arrive);
      if (k + 1 < path.size())
        text += ", \"depart\": " + number(stop.depart) +
                ", \"depart_ticks\": " + std::to_string(stop.depart);
      text += "}";
    }
    text += "]";
  }
  return text + (text.size() > 1 ? "\n  ]" : "]");
}

void write_json_plan(std::ostream& out, const Instance& instance, const Plan& plan) {
  out << "{\n  \"quadrille\": \"plan\",\n  \"version\": " << kPlanJsonVersion
      << ",\n  \"resolution\": " << json_number(instance.resolution())
      << ",\n  \"plan\": " << plan_to_json(instance, plan) << "\n}\n";
}

}  // namespace quadrille::continuous
