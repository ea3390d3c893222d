// SPDX-License-Identifier: MIT
#include "quadrille/continuous/instance_json.hpp"

#include <algorithm>
#include <fstream>
#include <istream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "formats/json_bodies.hpp"
#include "formats/json_numbers.hpp"
#include "quadrille/continuous/in_words.hpp"
#include "quadrille/continuous/quantise.hpp"
#include "quadrille/core/decimal.hpp"
#include "quadrille/text/choice.hpp"
#include "quadrille/text/document.hpp"
#include "quadrille/text/goals.hpp"
#include "quadrille/text/names.hpp"
#include "quadrille/text/sniff.hpp"
#include "quadrille/text/text_input.hpp"

namespace quadrille::continuous {
namespace {

using text::Document;
using Node = Document::Node;

class InstanceReader {
 public:
  explicit InstanceReader(const Document& document)
      : document_(document), check_(document), body_reader_(document, check_, resolution_) {}

  Result<Instance> run(text::Names* names) {
    std::optional<Node> kind, version, resolution, now, roadmap, agents, goal_sets, bodies,
        obstacles, groups, whole;
    if (!check_.members(Document::kRoot, {{"quadrille", &kind},
                                          {"version", &version},
                                          {"resolution", &resolution, false},
                                          {"now", &now, false},
                                          {"whole_moves", &whole, false},
                                          {"roadmap", &roadmap},
                                          {"agents", &agents},
                                          {"goal_sets", &goal_sets, false},
                                          {"bodies", &bodies, false},
                                          {"obstacles", &obstacles, false},
                                          {"group_names", &groups, false}}) ||
        !read_version(*kind, *version) ||
        (resolution && !read_resolution(document_, check_, *resolution, resolution_)) ||
        (now && !read_time(*now, now_)) || (whole && !check_.boolean(*whole, whole_moves_)) ||
        !read_roadmap(*roadmap) || (goal_sets && !read_goal_sets(*goal_sets)) ||
        (bodies && !body_reader_.read_list(*bodies)) || !read_agents(*agents) ||
        (obstacles && !read_obstacles(*obstacles)) || (groups && !read_group_names(*groups)))
      return check_.error();
    auto made = Roadmap::make(std::move(positions_), std::move(edges_), std::move(lane_places_),
                              std::move(shapes_), std::move(no_waiting_));
    if (!made) return document_.error(*roadmap, made.error().code, made.error().message);
    const auto roads = std::make_shared<const Roadmap>(std::move(made).value());
    auto instance = Instance::make(roads, agents_, resolution_, places_, obstacles_, now_);
    if (!instance) {
      Error error = named(instance.error(), roads);
      if (!error.where.file.empty()) return error;
      return document_.error(obstacles ? *obstacles : *roadmap, error.code, error.message);
    }
    if (names != nullptr) *names = std::move(names_);
    return instance->with_whole_moves(whole_moves_);
  }

 private:
  /// What Instance::make says, in the names of the file if it has any.
  [[nodiscard]] Error named(const Error& error, const std::shared_ptr<const Roadmap>& roads) const {
    if (names_.agents.empty() && names_.vertices.empty()) return error;
    const Words words{
        [this](AgentId i) {
          const std::string* const name = names_.agent(i.index());
          return name != nullptr ? text::in_quotes(*name) : "agent " + std::to_string(i.index());
        },
        [](std::size_t o) { return "obstacle " + std::to_string(o); },
        [this](VertexId v) {
          if (v.index() >= names_.vertices.size()) return "vertex " + std::to_string(v.index());
          const std::string& name = names_.vertices[v.index()];  // JSON
          return name.starts_with('"')
                     ? text::in_quotes(std::string_view(name).substr(1, name.size() - 2))
                     : name;
        },
        [this](Ticks time) { return decimal(in_input_units(time, resolution_)); }};
    Error said = continuous::in_words(error, roads, agents_, resolution_, obstacles_, now_, words);
    said.code = error.code;
    said.where = error.where;
    return said;
  }

  bool read_version(Node kind, Node version) {
    std::string_view name;
    std::int64_t number = 0;
    if (!check_.text(kind, name)) return false;
    if (name != "instance")
      return check_.fail(kind, "expected 'instance', found " + text::in_quotes(name));
    return check_.integer(version, kInstanceJsonVersion, kInstanceJsonVersion, number);
  }

  bool read_roadmap(Node node) {
    std::optional<Node> vertices, edges, names, lane_places, shapes, no_waiting;
    if (!check_.members(node, {{"vertices", &vertices},
                               {"edges", &edges},
                               {"names", &names, false},
                               {"shapes", &shapes, false},
                               {"no_waiting", &no_waiting, false},
                               {"lane_places", &lane_places, false}}) ||
        !check_.array(*vertices, "vertices") || !check_.array(*edges, "edges"))
      return false;
    for (Node v = document_.first(*vertices); v < document_.next(*vertices); v = document_.next(v))
      if (!read_vertex(v)) return false;
    for (Node e = document_.first(*edges); e < document_.next(*edges); e = document_.next(e))
      if (!read_edge(e)) return false;
    if (lane_places && !read_lane_places(*lane_places)) return false;
    if (shapes && !read_shapes(*shapes)) return false;
    if (no_waiting && !read_no_waiting(*no_waiting)) return false;
    return !names ||
           read_vertex_names(check_, document_, *names, positions_.size(), names_.vertices);
  }

  bool read_lane_places(Node list) {
    if (!check_.array(list, "places in the middle of moves")) return false;
    for (Node p = document_.first(list); p < document_.next(list); p = document_.next(p)) {
      std::optional<Node> vertex, from, to, behind, whole;
      LanePlace place;
      if (!check_.members(p, {{"vertex", &vertex},
                              {"from", &from},
                              {"to", &to},
                              {"behind", &behind},
                              {"whole", &whole}}) ||
          !read_vertex_number(*vertex, place.vertex) || !read_vertex_number(*from, place.from) ||
          !read_vertex_number(*to, place.to) || !read_time(*behind, place.behind) ||
          !read_time(*whole, place.whole))
        return false;
      lane_places_.push_back(place);
    }
    return true;
  }

  bool read_shapes(Node list) {
    if (!check_.array(list, "shapes", positions_.size())) return false;
    for (Node s = document_.first(list); s < document_.next(list); s = document_.next(s))
      if (!read_shape(s, shapes_.emplace_back())) return false;
    return true;
  }

  bool read_no_waiting(Node list) {
    if (!check_.array(list, "vertices")) return false;
    for (Node v = document_.first(list); v < document_.next(list); v = document_.next(v)) {
      VertexId vertex;
      if (!read_vertex_number(v, vertex)) return false;
      if (std::find(no_waiting_.begin(), no_waiting_.end(), vertex) != no_waiting_.end())
        return check_.fail(v, "this vertex is named twice");
      no_waiting_.push_back(vertex);
    }
    return true;
  }

  bool read_shape(Node node, ShapeId& shape) {
    std::int64_t number = 0;
    if (!check_.integer(node, 0, kMaxShapes, number)) return false;
    shape = ShapeId(static_cast<std::size_t>(number));
    return true;
  }

  bool read_group_names(Node node) {
    if (!text::read_names(check_, document_, node, names_.groups)) return false;
    return names_.groups.size() <= kMaxGroups ||
           check_.fail(node, "there are only " + std::to_string(kMaxGroups) + " groups");
  }

  bool read_vertex(Node node) { return read_point(node, positions_.emplace_back()); }

  [[nodiscard]] std::size_t size_of(Node list) const {
    std::size_t size = 0;
    for (Node n = document_.first(list); n < document_.next(list); n = document_.next(n)) ++size;
    return size;
  }

  /// The first point says for all of the file whether there are heights.
  bool read_point(Node node, Point& point) {
    if (!check_.array(node, "coordinates")) return false;
    if (num_coordinates_ == 0) num_coordinates_ = size_of(node) == 3 ? 3 : 2;
    if (!check_.array(node, "coordinates", num_coordinates_)) return false;
    const Node x = document_.first(node), y = document_.next(x);
    return read_coordinate(x, point.x) && read_coordinate(y, point.y) &&
           (num_coordinates_ == 2 || read_coordinate(document_.next(y), point.z));
  }

  bool read_coordinate(Node node, Length& length) {
    double value = 0;
    if (!check_.number(node, value)) return false;
    const auto units = quantise_coordinate(value, resolution_);
    if (!units)
      return check_.fail(node, ErrorCode::out_of_range,
                         "the coordinate is too large for the resolution");
    length = *units;
    return true;
  }

  /// A list of two or three, or an object.
  bool read_edge(Node node) {
    if (document_.kind(node) == Document::Kind::object) {
      std::optional<Node> from, to, duration, groups, shape, limit;
      return check_.members(node, {{"from", &from},
                                   {"to", &to},
                                   {"duration", &duration, false},
                                   {"groups", &groups, false},
                                   {"shape", &shape, false},
                                   {"speed_limit", &limit, false}}) &&
             read_edge(node, *from, *to, duration, groups) &&
             (!shape || read_shape(*shape, edges_.back().shape)) &&
             (!limit || read_limit(*limit, edges_.back()));
    }
    if (!check_.array(node, "vertices")) return false;
    const Node from = document_.first(node), end = document_.next(node);
    const Node to = from < end ? document_.next(from) : end;
    const Node duration = to < end ? document_.next(to) : end;
    if (to == end || (duration != end && document_.next(duration) != end))
      return check_.fail(node, "expected [from, to] or [from, to, duration]");
    return read_edge(node, from, to, duration == end ? std::nullopt : std::optional(duration), {});
  }

  bool read_edge(Node node, Node from, Node to, std::optional<Node> duration,
                 std::optional<Node> groups) {
    Edge edge;
    if (!read_vertex_number(from, edge.from) || !read_vertex_number(to, edge.to)) return false;
    if (edge.from == edge.to)
      return check_.fail(node, ErrorCode::invalid_instance, "the edge is a loop");
    if (groups && !read_groups(*groups, edge.open_to)) return false;
    if (duration) {
      double value = 0;
      if (!check_.number(*duration, value)) return false;
      edge.duration = quantise_duration(value, resolution_);
      if (!edge.duration)
        return check_.fail(*duration, ErrorCode::out_of_range,
                           "the duration is less than one tick, or too long");
    } else if (positions_[edge.from.index()] == positions_[edge.to.index()]) {
      return check_.fail(node, ErrorCode::invalid_instance,
                         "the edge has length zero and no duration");
    }
    edges_.push_back(edge);
    return true;
  }

  bool read_limit(Node node, Edge& edge) {
    if (edge.duration)
      return check_.fail(node, ErrorCode::invalid_instance,
                         "the edge has a duration and a speed limit");
    return read_speed(node, node, edge.speed_limit.emplace());
  }

  bool read_groups(Node node, Groups& groups) {
    if (!check_.array(node, "groups")) return false;
    groups = {};
    for (Node g = document_.first(node); g < document_.next(node); g = document_.next(g)) {
      GroupId group;
      if (!read_group(g, group)) return false;
      if (groups.contains(group)) return check_.fail(g, "this group is named twice");
      groups.insert(group);
    }
    if (!groups.is_empty()) return true;
    return check_.fail(node, ErrorCode::invalid_instance, "the edge is open to no group");
  }

  bool read_group(Node node, GroupId& group) {
    std::int64_t number = 0;
    if (!check_.integer(node, 0, kMaxGroups - 1, number)) return false;
    group = GroupId(static_cast<std::size_t>(number));
    return true;
  }

  bool read_vertex_number(Node node, VertexId& vertex) {
    std::int64_t number = 0;
    if (!check_.integer(node, 0, INT64_MAX, number)) return false;
    if (number >= std::ssize(positions_))
      return check_.fail(node, ErrorCode::invalid_instance,
                         "there is no vertex " + std::to_string(number) + " among " +
                             std::to_string(positions_.size()));
    vertex = VertexId(static_cast<std::size_t>(number));
    return true;
  }

  bool read_agents(Node agents) {
    if (!check_.array(agents, "agents")) return false;
    std::vector<Node> nodes;
    for (Node a = document_.first(agents); a < document_.next(agents); a = document_.next(a)) {
      std::optional<Node> start, speed, group, release, deadline, at_start, at_goal, overlap, name;
      BodyReader::Keys looks;
      text::GoalNodes goals;
      Agent agent;
      std::optional<std::string> own_name;
      if (!check_.members(a, {{"start", &start},
                              {"goal", &goals.goal, false},
                              {"goals", &goals.goals, false},
                              {"radius", &looks.radius, false},
                              {"polygon", &looks.polygon, false},
                              {"body", &looks.body, false},
                              {"speed", &speed, false},
                              {"group", &group, false},
                              {"release", &release, false},
                              {"deadline", &deadline, false},
                              {"at_start", &at_start, false},
                              {"at_goal", &at_goal, false},
                              {"overlap_at_start", &overlap, false},
                              {"name", &name, false}}) ||
          !read_vertex_number(*start, agent.start) || !read_goals(a, goals, agent.goals) ||
          !body_reader_.read(a, looks, agent) || !read_speed(a, speed, agent.speed) ||
          (group && !read_group(*group, agent.group)) ||
          (release && !read_time(*release, agent.release)) ||
          (deadline && !read_time(*deadline, agent.deadline.emplace())) ||
          (at_start &&
           !text::read_choice(check_, *at_start, "stay", "under_way", agent.under_way)) ||
          (at_goal && !text::read_choice(check_, *at_goal, "stay", "leave", agent.leaves)) ||
          (overlap && !check_.boolean(*overlap, agent.overlaps_at_start)) ||
          (name && !text::read_name(check_, document_, *name, own_name)))
        return false;
      nodes.push_back(a);
      names_.agents.push_back(own_name);
      agents_.push_back(agent);
      places_.push_back({document_.file(), document_.line(a)});
    }
    return are_distinct(check_, names_.agents, nodes);
  }

  bool read_goals(Node agent, const text::GoalNodes& nodes, Goals& goals) {
    return text::read_goals(
        check_, document_, agent, nodes, goal_sets_,
        [&](Node node, VertexId& v) { return read_vertex_number(node, v); }, in_words, goals);
  }
  bool read_goal_sets(Node sets) {
    return text::read_goal_sets(
        check_, document_, sets,
        [&](Node node, VertexId& v) { return read_vertex_number(node, v); }, in_words, goal_sets_);
  }
  static std::string in_words(VertexId v) { return "vertex " + std::to_string(v.index()); }

  bool read_obstacles(Node obstacles) {
    if (!check_.array(obstacles, "obstacles")) return false;
    for (Node o = document_.first(obstacles); o < document_.next(obstacles);
         o = document_.next(o)) {
      std::optional<Node> path, at_end;
      BodyReader::Keys looks;
      MovingObstacle& obstacle = obstacles_.emplace_back();
      if (!check_.members(o, {{"radius", &looks.radius, false},
                              {"polygon", &looks.polygon, false},
                              {"path", &path},
                              {"at_end", &at_end, false}}) ||
          !body_reader_.read(o, looks, obstacle.body) || !check_.array(*path, "stops") ||
          (at_end && !text::read_choice(check_, *at_end, "stay", "leave", obstacle.leaves)))
        return false;
      for (Node s = document_.first(*path); s < document_.next(*path); s = document_.next(s))
        if (!read_obstacle_stop(s, obstacle.path)) return false;
      if (obstacle.path.empty()) return check_.fail(*path, "the path is empty");
      if (obstacle.leaves && obstacle.path.front().arrive == obstacle.path.back().depart)
        return check_.fail(*path, ErrorCode::invalid_instance,
                           "it vanishes at the moment at which it appears");
    }
    return true;
  }

  bool read_obstacle_stop(Node node, std::vector<MovingObstacle::Stop>& path) {
    std::optional<Node> vertex, at, arrive, depart;
    MovingObstacle::Stop stop;
    if (!check_.members(node, {{"vertex", &vertex, false},
                               {"at", &at, false},
                               {"arrive", &arrive},
                               {"depart", &depart, false}}))
      return false;
    if (vertex.has_value() == at.has_value())
      return check_.fail(node, "expected one of the keys 'vertex' and 'at'");
    if (vertex) {
      VertexId v;
      if (!read_vertex_number(*vertex, v)) return false;
      stop.at = positions_[v.index()];
    } else if (!read_point(*at, stop.at)) {
      return false;
    }
    if (!read_time(*arrive, stop.arrive)) return false;
    stop.depart = stop.arrive;
    if (depart && !read_time(*depart, stop.depart)) return false;
    if (stop.depart < stop.arrive)
      return check_.fail(*depart, ErrorCode::invalid_instance,
                         "the departure is before the arrival");
    if (!path.empty() && stop.arrive <= path.back().depart)
      return check_.fail(*arrive, ErrorCode::invalid_instance,
                         "the arrival is not after the last departure");
    path.push_back(stop);
    return true;
  }

  bool read_time(Node node, Ticks& ticks) {
    double value = 0;
    if (!check_.number(node, value)) return false;
    const auto time = quantise_time(value, resolution_);
    if (!time)
      return check_.fail(node, ErrorCode::out_of_range,
                         "the time is negative, or too late: " + decimal(value));
    ticks = *time;
    return true;
  }

  /// 1 if it is missing.
  bool read_speed(Node agent, std::optional<Node> given, Speed& speed) {
    const Node node = given.value_or(agent);
    double value = 1;
    if (given && !check_.number(node, value)) return false;
    const auto units = quantise_speed(value, resolution_);
    if (!units)
      return check_.fail(
          node, ErrorCode::out_of_range,
          "the speed is not 0.000001 .. 1000000 length units per tick: " + decimal(value));
    speed = *units;
    return true;
  }

  const Document& document_;
  text::Checker check_;
  Resolution resolution_;
  BodyReader body_reader_;
  Ticks now_ = 0;
  bool whole_moves_ = false;
  std::size_t num_coordinates_ = 0;  // of a point; 0: there was none yet
  std::vector<Point> positions_;
  std::vector<Edge> edges_;
  std::vector<LanePlace> lane_places_;
  std::vector<ShapeId> shapes_;
  std::vector<VertexId> no_waiting_;
  std::vector<Agent> agents_;
  text::GoalSets goal_sets_;
  std::vector<SourcePlace> places_;
  std::vector<MovingObstacle> obstacles_;
  text::Names names_;
};

}  // namespace

Result<Instance> read_instance_json(std::istream& in, const std::string& file, text::Names* names) {
  const auto text = text::read_all(in, file);
  if (!text) return text.error();
  if (auto error = text::refuse_other(*text, file,
                                      {text::FileKind::own_roadmap, text::FileKind::own_instance}))
    return *error;
  const auto document = text::parse_json(*text, file);
  if (!document) return document.error();
  return InstanceReader(*document).run(names);
}

Result<Instance> read_instance_json(const std::filesystem::path& path) {
  std::ifstream in;
  if (auto error = text::open_input(path, in)) return *error;
  return read_instance_json(in, path.string());
}

bool is_roadmap_json(const std::string& text) {
  // Most files are decided without being parsed.
  if (text.find("\"roadmap\"") == std::string::npos) return false;
  const auto document = text::parse_json(text, "");
  if (!document || document->kind(Document::kRoot) != Document::Kind::object) return false;
  const Node end = document->next(Document::kRoot);
  for (Node key = document->first(Document::kRoot); key < end;
       key = document->next(document->first(key)))
    if (document->text(key) == "roadmap") return true;
  return false;
}

}  // namespace quadrille::continuous
