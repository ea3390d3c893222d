// SPDX-License-Identifier: MIT
#include <ostream>
#include <utility>

#include "formats/json_numbers.hpp"
#include "formats/plan_codecs.hpp"
#include "quadrille/continuous/quantise.hpp"
#include "quadrille/text/document.hpp"
#include "quadrille/text/plan_header.hpp"

namespace quadrille::continuous {
namespace {

using text::Document;
using Node = Document::Node;

class JsonPlanReader {
 public:
  JsonPlanReader(const Document& document, const Instance& instance)
      : document_(document), check_(document), header_(document, check_), instance_(instance) {}

  Result<PlanFile> run() {
    std::optional<Node> resolution, ticks, bound_ticks;
    std::optional<Node> unread[5];  // Of a result.
    Node paths = Document::kRoot;
    if (!header_.read({{"resolution", &resolution},
                       {"cost_ticks", &ticks, false},
                       {"lower_bound_ticks", &bound_ticks, false},
                       {"claim", &unread[0], false},
                       {"bodies", &unread[1], false},
                       {"least_clearance", &unread[2], false},
                       {"second_opinion", &unread[3], false},
                       {"duration_error", &unread[4], false}},
                      file_.stated) ||
        !header_.plan(paths) || !check_resolution(*resolution) || !read_costs(ticks, bound_ticks) ||
        !read_paths(paths) || !header_.agents(file_.plan.paths.size()))
      return check_.error();
    return std::move(file_);
  }

 private:
  bool check_resolution(Node node) {
    Resolution value;
    if (!read_resolution(document_, check_, node, value)) return false;
    if (value == instance_.resolution()) return true;
    return check_.fail(
        node, ErrorCode::invalid_plan,
        "the resolution of the instance is " + resolution_json(instance_.resolution()));
  }

  bool read_costs(std::optional<Node> cost_ticks, std::optional<Node> bound_ticks) {
    StatedOutcome& stated = file_.stated;
    return read_cost(
               "cost", header_.cost(), cost_ticks,
               stated.objective == Objective::makespan ? stated.makespan : stated.sum_of_costs) &&
           read_cost("lower bound", header_.lower_bound(), bound_ticks, stated.lower_bound);
  }

  /// `time` and `ticks`, the same in two units.
  bool read_cost(const std::string& name, std::optional<Node> time, std::optional<Node> ticks,
                 std::optional<Cost>& cost) {
    if (header_.is_null(ticks) && header_.is_null(time)) return true;
    if (header_.is_null(ticks))
      return check_.fail(*time, "a " + name + " needs the key '" +
                                    (name == "cost" ? "cost_ticks" : "lower_bound_ticks") + "'");
    return header_.needs_objective(*ticks, "a " + name) &&
           check_.integer(*ticks, 0, INT64_MAX, cost.emplace()) &&
           (header_.is_null(time) || agrees(*time, *cost));
  }

  /// A cost, a time or a coordinate that is stated beside its whole units.
  template <class Units>
  bool agrees(Node node, Units units) {
    double value = 0;
    if (!check_.number(node, value)) return false;
    if (is_about(value, units, instance_.resolution())) return true;
    return check_.fail(node, ErrorCode::invalid_plan,
                       "this is not " + std::to_string(count(units)) + " times the resolution");
  }
  static std::int64_t count(Cost ticks) { return ticks; }
  template <class Unit>
  static std::int64_t count(Quantity<Unit> units) {
    return units.value();
  }

  bool read_paths(Node plan) {
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
    if (!read_tick(*arrive_ticks, stop.arrive)) return false;
    if (arrive && !agrees(*arrive, stop.arrive)) return false;
    stop.depart = stop.arrive;
    if (is_last) {
      if (!depart && !depart_ticks) return true;
      return check_.fail(depart ? *depart : *depart_ticks, ErrorCode::invalid_plan,
                         "an agent stays at its last stop for ever");
    }
    if (!read_tick(*depart_ticks, stop.depart)) return false;
    return !depart || agrees(*depart, stop.depart);
  }

  bool read_tick(Node node, Ticks& tick) {
    std::int64_t count = 0;
    if (!check_.integer(node, 0, kMaxTick.value(), count)) return false;
    tick = Ticks(count);
    return true;
  }

  bool read_place(Node node, const Point& point) {
    // In the plane the height may be missing.
    const std::size_t least = instance_.roadmap().is_flat() ? 2 : 3;
    if (!check_.array(node, "coordinates")) return false;
    std::size_t found = 0;
    for (Node c = document_.first(node); c < document_.next(node); c = document_.next(c)) ++found;
    if (found != 3 && !check_.array(node, "coordinates", least)) return false;
    Node at = document_.first(node);
    for (const Length coordinate : {point.x, point.y, point.z}) {
      if (at == document_.next(node)) break;
      if (!agrees(at, coordinate)) return false;
      at = document_.next(at);
    }
    return true;
  }

  const Document& document_;
  text::Checker check_;
  text::PlanHeader header_;
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
  const auto number = [&](auto units) {
    return json_number(in_input_units(units, instance.resolution()));
  };
  std::string text = "[";
  for (const Path& path : plan.paths) {
    text += text.size() > 1 ? ",\n    [" : "\n    [";
    for (std::size_t k = 0; k < path.size(); ++k) {
      const Stop& stop = path[k];
      const Point& at = instance.roadmap().position(stop.vertex);
      text += (k == 0 ? "{" : ", {");
      text += "\"vertex\": " + std::to_string(stop.vertex.index()) +
              ", \"at\": " + point_json(at, instance.roadmap().is_flat(), instance.resolution()) +
              ", \"arrive\": " + number(stop.arrive) +
              ", \"arrive_ticks\": " + std::to_string(stop.arrive.value());
      if (k + 1 < path.size())
        text += ", \"depart\": " + number(stop.depart) +
                ", \"depart_ticks\": " + std::to_string(stop.depart.value());
      text += "}";
    }
    text += "]";
  }
  return text + (text.size() > 1 ? "\n  ]" : "]");
}

void write_json_plan(std::ostream& out, const Instance& instance, const Plan& plan) {
  out << "{\n  \"quadrille\": \"plan\",\n  \"version\": " << text::kPlanJsonVersion
      << ",\n  \"resolution\": " << resolution_json(instance.resolution())
      << ",\n  \"plan\": " << plan_to_json(instance, plan) << "\n}\n";
}

}  // namespace quadrille::continuous
