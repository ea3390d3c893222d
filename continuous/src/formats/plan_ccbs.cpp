// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "formats/json_numbers.hpp"
#include "formats/plan_codecs.hpp"
#include "formats/xml_input.hpp"
#include "quadrille/continuous/quantise.hpp"
#include "quadrille/text/text_input.hpp"

namespace quadrille::continuous {
namespace {

/// Lengths of edges are rounded coordinates apart here, and not in the log of another program.
constexpr Ticks kMoveTolerance = 2;

/// What the last digit of a number stands for: 0.01 for "1.25", 10 for "1.2e2". Requires a number.
double last_digit(std::string_view text) {
  const auto exponent = text.find_first_of("eE");
  const std::string_view mantissa = text.substr(0, exponent);
  const auto point = mantissa.find('.');
  const auto digits = static_cast<std::int64_t>(
      point == std::string_view::npos
          ? 0
          : std::count_if(mantissa.begin() + static_cast<std::ptrdiff_t>(point), mantissa.end(),
                          [](char c) { return c >= '0' && c <= '9'; }));
  const std::int64_t power =
      exponent == std::string_view::npos
          ? 0
          : parse_integer(text.substr(exponent + (text[exponent + 1] == '+' ? 2 : 1)), -400, 400)
                .value_or(0);
  return std::pow(10.0, static_cast<double>(power - digits));
}

/// What a move of `ticks` in a log stands for: exactly what its edge takes, if it is about that.
Ticks move_duration(const Instance& instance, AgentId agent, VertexId from, VertexId to,
                    Ticks ticks) {
  const ClassId c = instance.class_of(agent);
  for (const EdgeId e : instance.out_edges(c, from)) {
    if (instance.roadmap().to(e) != to) continue;
    const Ticks exact = instance.duration(c, e);
    if (abs(exact - ticks) <= kMoveTolerance) return exact;
  }
  return ticks;
}

/// Whether a duration is the same as a number and back.
bool is_number(Ticks ticks, const Resolution& resolution) {
  return std::llround(in_input_units(ticks, resolution) / resolution.time) == ticks.value();
}

class LogReader {
 public:
  /// `has_agents`: those of the instance; otherwise the log says alone who there is.
  LogReader(const XmlFile& xml, const Instance& instance, const GridRoadmap* grid, bool has_agents)
      : xml_(xml), instance_(instance), grid_(grid), has_agents_(has_agents) {}

  Result<PlanFile> run() {
    if (std::string_view(xml_.root().name()) != "root")
      return xml_.error(xml_.root(), "there is no <log> in <root>");
    // CCBS repeats map and tasks in the file: agents with a start and a goal beside the log.
    if (auto error = xml_.misplaced({{"root"},
                                     {"root", "log"},
                                     {"root", "log", "summary"},
                                     {"root", "log", "agent"},
                                     {"root", "agent"},
                                     {"root", "log", "agent", "path"},
                                     {"root", "log", "agent", "path", "section"}}))
      return *error;
    const auto log = xml_.only_child(xml_.root(), "log");
    if (!log) return log.error();
    if (!*log) return xml_.error(xml_.root(), "there is no <log> in <root>");
    for (const pugi::xml_node agent : log->children("agent"))
      if (auto error = read_agent(agent)) return *error;
    if (file_.plan.paths.empty() && instance_.num_agents() > 0)
      return xml_.error(*log, "there is no plan", ErrorCode::invalid_plan);
    if (!has_agents_) return std::move(file_);
    if (auto error = read_summary(*log)) return *error;
    return std::move(file_);
  }

 private:
  std::optional<Error> read_summary(const pugi::xml_node& log) {
    const auto summary = xml_.only_child(log, "summary");
    if (!summary) return summary.error();
    if (auto error =
            read_cost(*summary, "flowtime", Objective::sum_of_costs, file_.stated.sum_of_costs))
      return error;
    return read_cost(*summary, "makespan", Objective::makespan, file_.stated.makespan);
  }

  std::optional<Error> read_cost(const pugi::xml_node& summary, const char* name,
                                 Objective objective, std::optional<Cost>& cost) const {
    const pugi::xml_attribute attribute = summary.attribute(name);
    if (!attribute) return std::nullopt;
    const auto seconds = parse_number(attribute.value());
    const double units = seconds ? *seconds / instance_.resolution().time : -1;
    if (!(units >= 0 && units <= static_cast<double>(kMaxTick.value())))
      return xml_.error(summary, "the " + std::string(name) + " is " + quoted(attribute.value()) +
                                     ", not a time");
    // Rounded as a whole there and section by section here.
    const Cost actual = quadrille::continuous::cost(file_.plan, objective);
    const double tolerance = last_digit(attribute.value()) / instance_.resolution().time +
                             static_cast<double>(((kMoveTolerance + 1) * num_sections_).value());
    const bool agrees = std::abs(units - static_cast<double>(actual)) <= tolerance;
    cost = agrees ? actual : static_cast<Cost>(std::llround(units));
    return std::nullopt;
  }

  std::optional<Error> read_agent(const pugi::xml_node& node) {
    const std::size_t index = file_.plan.paths.size();
    const auto number = parse_integer(node.attribute("number").value(), 0, INT64_MAX);
    if (number != static_cast<std::int64_t>(index))
      return xml_.error(node, "agent " + quoted(node.attribute("number").value()) + " where " +
                                  std::to_string(index) + " is due");
    if (has_agents_ && index >= instance_.num_agents())
      return xml_.error(node,
                        "agent " + std::to_string(index) + ", but the instance has " +
                            std::to_string(instance_.num_agents()) + " agents",
                        ErrorCode::invalid_plan);
    const auto way = xml_.only_child(node, "path");
    if (!way) return way.error();
    if (!*way) return xml_.error(node, "there is no <path>");
    Path path{{VertexId(0), 0, 0}};
    bool is_first = true;
    for (const pugi::xml_node section : way->children("section")) {
      if (auto error = read_section(section, AgentId(index), is_first, path)) return error;
      is_first = false;
      ++num_sections_;
    }
    if (is_first) return xml_.error(*way, "the path is empty", ErrorCode::invalid_plan);
    // Waiting at the end is no departure.
    path.back().depart = path.back().arrive;
    file_.plan.paths.push_back(std::move(path));
    return std::nullopt;
  }

  std::optional<Error> read_section(const pugi::xml_node& node, AgentId agent, bool is_first,
                                    Path& path) {
    std::array<VertexId, 2> ends;
    const auto before = is_first ? std::nullopt : std::optional(path.back().vertex);
    if (auto error = read_vertex(node, "start", Near{agent, before, false}, ends[0])) return error;
    if (auto error = read_vertex(node, "goal", Near{agent, ends[0], true}, ends[1])) return error;
    const auto seconds = parse_number(node.attribute("duration").value());
    const double units = seconds ? *seconds / instance_.resolution().time : -1;
    if (!(units >= 0 && units <= static_cast<double>((kMaxTick - path.back().depart).value())))
      return xml_.error(
          node, "the duration is " + quoted(node.attribute("duration").value()) + ", not a time");
    if (is_first) path.back().vertex = ends[0];
    if (path.back().vertex != ends[0])
      return xml_.error(node, "the section does not begin where the one before it ends",
                        ErrorCode::invalid_plan);
    const Ticks ticks(std::llround(units));
    if (ends[0] == ends[1]) {
      path.back().depart += ticks;
    } else {
      const Ticks arrive =
          path.back().depart +
          (has_agents_ ? move_duration(instance_, agent, ends[0], ends[1], ticks) : ticks);
      path.push_back({ends[1], arrive, arrive});
    }
    return std::nullopt;
  }

  /// What helps where several vertices have one place.
  struct Near {
    AgentId agent;
    std::optional<VertexId> before;  ///< Where the agent was before.
    bool moves;                      ///< Whether it may have moved since.
  };

  std::optional<Error> read_vertex(const pugi::xml_node& node, const std::string& end,
                                   const Near& near, VertexId& vertex) {
    const std::string_view x = node.attribute((end + "_i").c_str()).value();
    const std::string_view y = node.attribute((end + "_j").c_str()).value();
    const bool has_id = node.attribute((end + "_id").c_str());
    // Cells of grids are rows and columns; of roadmaps CCBS writes coordinates.
    if (grid_ != nullptr || has_id) return read_number(node, end, vertex);
    const auto at_x = parse_number(x), at_y = parse_number(y);
    if (!at_x || !at_y)
      return xml_.error(node, "a <section> has " + end + "_id, or " + end + "_i and " + end + "_j");
    const auto found = choose(vertices_at(*at_x, *at_y), near);
    if (!found)
      return xml_.error(node,
                        "the " + end + " of a section, (" + text::printable(x, 40) + ", " +
                            text::printable(y, 40) + "), is no vertex of the roadmap",
                        ErrorCode::invalid_plan);
    vertex = *found;
    return std::nullopt;
  }

  /// The vertices in the nearest place, which differs by less than six digits tell.
  std::vector<VertexId> vertices_at(double x, double y) {
    constexpr double kSixDigits = 5e-6;
    const std::vector<Point>& positions = instance_.roadmap().positions();
    const auto at = [&](VertexId v) {
      const Point& point = positions[v.index()];
      return std::pair{static_cast<double>(point.x.value()), static_cast<double>(point.y.value())};
    };
    if (by_x_.empty()) {
      for (const VertexId v : IdRange<VertexId>(positions.size())) by_x_.push_back(v);
      std::stable_sort(by_x_.begin(), by_x_.end(),
                       [&](VertexId v, VertexId w) { return at(v).first < at(w).first; });
    }
    x /= instance_.resolution().length;
    y /= instance_.resolution().length;
    const double most_x = 1 + kSixDigits * std::abs(x), most_y = 1 + kSixDigits * std::abs(y);
    double least = std::numeric_limits<double>::infinity();
    std::vector<VertexId> found;
    for (auto v = std::partition_point(by_x_.begin(), by_x_.end(),
                                       [&](VertexId w) { return at(w).first < x - most_x; });
         v != by_x_.end() && at(*v).first <= x + most_x; ++v) {
      const double distance = std::hypot(at(*v).first - x, at(*v).second - y);
      if (std::abs(at(*v).second - y) > most_y || distance > least) continue;
      if (distance < least) found.clear();
      least = distance;
      found.push_back(*v);
    }
    return found;
  }

  /// The one that fits: where the agent was, or else where it can go from there; of a first start
  /// its own one.
  [[nodiscard]] std::optional<VertexId> choose(const std::vector<VertexId>& found,
                                               const Near& near) const {
    const auto has = [&](VertexId v) {
      return std::find(found.begin(), found.end(), v) != found.end();
    };
    if (!near.before && !has_agents_) return found.empty() ? std::nullopt : std::optional(found[0]);
    const VertexId expected = near.before ? *near.before : instance_.agent(near.agent).start;
    if (has(expected)) return expected;
    if (near.moves)
      for (const EdgeId e : instance_.roadmap().out_edges(expected))
        if (has(instance_.roadmap().to(e))) return instance_.roadmap().to(e);
    if (found.empty()) return std::nullopt;
    return found.front();
  }

  std::optional<Error> read_number(const pugi::xml_node& node, const std::string& end,
                                   VertexId& vertex) const {
    constexpr std::int64_t kMax = INT32_MAX;
    const auto id = parse_integer(node.attribute((end + "_id").c_str()).value(), 0, kMax);
    const auto row = parse_integer(node.attribute((end + "_i").c_str()).value(), 0, kMax);
    const auto column = parse_integer(node.attribute((end + "_j").c_str()).value(), 0, kMax);
    if (id.has_value() == (row && column))
      return xml_.error(node, "a <section> has " + end + "_id, or " + end + "_i and " + end + "_j");
    std::optional<VertexId> found;
    if (grid_ != nullptr) {
      const std::int64_t width = grid_->width();
      const auto cell = id ? std::pair(*id % width, *id / width) : std::pair(*column, *row);
      found = grid_->vertex(
          {static_cast<std::int32_t>(cell.first), static_cast<std::int32_t>(cell.second)});
    } else if (id && *id < static_cast<std::int64_t>(instance_.roadmap().num_vertices())) {
      found = VertexId(static_cast<std::size_t>(*id));
    }
    if (!found)
      return xml_.error(node, "the " + end + " of a section is no vertex of the roadmap",
                        ErrorCode::invalid_plan);
    vertex = *found;
    return std::nullopt;
  }

  const XmlFile& xml_;
  const Instance& instance_;
  const GridRoadmap* grid_;
  const bool has_agents_;
  PlanFile file_;
  std::vector<VertexId> by_x_;  // Once coordinates are asked for.
  std::int64_t num_sections_ = 0;
};

}  // namespace

Result<PlanFile> read_ccbs_log(const std::string& text, const std::string& file,
                               const Instance& instance, const GridRoadmap* grid) {
  const auto xml = XmlFile::parse(text, file);
  if (!xml) return xml.error();
  return LogReader(*xml, instance, grid, true).run();
}

Result<Plan> read_log_alone(std::istream& in, const std::string& file, const Instance& roadmap,
                            const GridRoadmap* grid) {
  const auto text = text::read_all(in, file);
  if (!text) return text.error();
  const auto xml = XmlFile::parse(*text, file);
  if (!xml) return xml.error();
  auto read = LogReader(*xml, roadmap, grid, false).run();
  if (!read) return read.error();
  return std::move(read->plan);
}

std::string why_not_in_log(const Instance& instance, AgentId agent, const Path& path) {
  if (agent.index() >= instance.num_agents())
    return "there are " + std::to_string(instance.num_agents()) + " agents";
  if (path.front().arrive != 0) return "the path does not begin at tick 0";
  for (std::size_t k = 0; k + 1 < path.size(); ++k) {
    const Stop &stop = path[k], &next = path[k + 1];
    const std::string at = "stop " + std::to_string(k) + ": ";
    if (stop.depart < stop.arrive || next.arrive < stop.depart) return at + "time goes back";
    if (next.vertex == stop.vertex) return at + "a move that ends where it begins";
    const Ticks move = next.arrive - stop.depart;
    if (move_duration(instance, agent, stop.vertex, next.vertex, move) != move)
      return at + "the next move is by a tick or two not as long as its edge takes";
    for (const Ticks duration : {stop.depart - stop.arrive, move})
      if (!is_number(duration, instance.resolution()))
        return at + std::to_string(duration.value()) + " ticks are too many for a number";
  }
  return "";
}

void write_ccbs_log(std::ostream& out, const Instance& instance, const Plan& plan,
                    const GridRoadmap* grid) {
  const auto time = [&](auto units) {
    return json_number(in_input_units(units, instance.resolution()));
  };
  const auto place = [&](const char* end, VertexId v) {
    out << " " << end;
    if (grid == nullptr)
      out << "_id=\"" << v.index() << "\"";
    else
      out << "_i=\"" << grid->cell(v).y << "\" " << end << "_j=\"" << grid->cell(v).x << "\"";
  };
  out << "<?xml version=\"1.0\"?>\n<root>\n<log>\n <summary flowtime=\""
      << time(cost(plan, Objective::sum_of_costs)) << "\" makespan=\""
      << time(cost(plan, Objective::makespan)) << "\"/>\n";
  for (const AgentId i : IdRange<AgentId>(plan.paths.size())) {
    const Path& path = plan.paths[i];
    out << " <agent number=\"" << i.index() << "\">\n  <path duration=\"" << time(cost(path))
        << "\">\n";
    int number = 0;
    const auto section = [&](VertexId from, VertexId to, Ticks duration) {
      out << "   <section number=\"" << number++ << "\"";
      place("start", from);
      place("goal", to);
      out << " duration=\"" << time(duration) << "\"/>\n";
    };
    for (std::size_t k = 0; k + 1 < path.size(); ++k) {
      const Ticks wait = path[k].depart - path[k].arrive;
      if (wait > 0) section(path[k].vertex, path[k].vertex, wait);
      section(path[k].vertex, path[k + 1].vertex, path[k + 1].arrive - path[k].depart);
    }
    // A path is not empty: the section says where the agent is.
    if (number == 0) section(path.front().vertex, path.front().vertex, 0);
    out << "  </path>\n </agent>\n";
  }
  out << "</log>\n</root>\n";
}

}  // namespace quadrille::continuous
