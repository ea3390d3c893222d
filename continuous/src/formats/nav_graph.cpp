// SPDX-License-Identifier: MIT
#include "quadrille/continuous/nav_graph.hpp"

#include <yaml-cpp/yaml.h>

#include <cmath>
#include <fstream>
#include <optional>
#include <utility>

#include "quadrille/continuous/quantise.hpp"
#include "quadrille/text/text_input.hpp"

namespace quadrille::continuous {
namespace {

/// Thrown and caught in this file: yaml-cpp throws as well.
struct Refused {
  Error error;
};

class Reader {
 public:
  Reader(std::string file, const Resolution& resolution, Speed speed)
      : file_(std::move(file)), resolution_(resolution), speed_(speed) {}

  Result<NavGraph> run(const std::string& text) {
    try {
      return read(YAML::Load(text));
    } catch (const Refused& refused) {
      return refused.error;
    } catch (const YAML::Exception& exception) {
      return Error{ErrorCode::syntax, exception.msg, {file_, exception.mark.line + 1}};
    }
  }

 private:
  [[noreturn]] void refuse(const YAML::Node& node, ErrorCode code, const std::string& why) const {
    throw Refused{{code, why, {file_, node.IsDefined() ? node.Mark().line + 1 : 0}}};
  }
  [[noreturn]] void refuse(const YAML::Node& node, const std::string& why) const {
    refuse(node, ErrorCode::syntax, why);
  }

  NavGraph read(const YAML::Node& root) {
    if (!root.IsMap() || !root["levels"] || !root["levels"].IsMap())
      refuse(root, "a nav graph of Open-RMF has the key 'levels'");
    std::optional<YAML::Node> level;
    for (const auto& entry : root["levels"]) {
      const YAML::Node& value = entry.second;
      if (!value.IsMap() || !value["vertices"] || !value["vertices"].IsSequence())
        refuse(value, "a level has the key 'vertices'");
      if (value["vertices"].size() == 0) continue;
      if (level)
        refuse(value, ErrorCode::invalid_instance,
               "a roadmap is of one level, and this is another");
      level = value;
    }
    if (!level) refuse(root, ErrorCode::invalid_instance, "there are no vertices");
    for (const YAML::Node& vertex : (*level)["vertices"]) add_vertex(vertex);
    if ((*level)["lanes"]) {
      if (!(*level)["lanes"].IsSequence()) refuse((*level)["lanes"], "'lanes' is a list");
      for (const YAML::Node& lane : (*level)["lanes"]) add_lane(lane);
    }
    auto roadmap = Roadmap::make(std::move(points_), std::move(edges_));
    if (!roadmap) throw Refused{{roadmap.error().code, roadmap.error().message, {file_, 0}}};
    return {std::move(roadmap).value(), std::move(names_), num_zero_length_edges_};
  }

  double number(const YAML::Node& node, const std::string& what) const {
    double value = 0;
    if (!node.IsScalar() || !YAML::convert<double>::decode(node, value) || !std::isfinite(value))
      refuse(node, what + " is a number");
    return value;
  }
  /// The third element of a vertex or a lane.
  YAML::Node properties(const YAML::Node& node, const std::string& what) const {
    if (!node.IsSequence() || node.size() < 2 || node.size() > 3 ||
        (node.size() == 3 && !node[2].IsMap()))
      refuse(node, what);
    const YAML::Node found = node.size() == 3 ? node[2] : YAML::Node(YAML::NodeType::Map);
    for (const auto& entry : found) {
      const auto name = entry.first.as<std::string>();
      if (name.starts_with("mutex") && !entry.second.IsNull() &&
          !(entry.second.IsScalar() && entry.second.Scalar().empty()))
        refuse(entry.first, ErrorCode::invalid_instance, "mutex groups are not supported");
    }
    return found;
  }

  void add_vertex(const YAML::Node& node) {
    const YAML::Node more = properties(node, "a vertex is [x, y, {properties}]");
    const auto x = quantise_coordinate(number(node[0], "x"), resolution_);
    const auto y = quantise_coordinate(number(node[1], "y"), resolution_);
    if (!x || !y) refuse(node, ErrorCode::out_of_range, "the coordinates are too large");
    points_.push_back({*x, *y});
    names_.push_back(more["name"] && more["name"].IsScalar() ? more["name"].Scalar() : "");
  }

  VertexId vertex(const YAML::Node& node) const {
    std::size_t index = 0;
    if (!node.IsScalar() || !YAML::convert<std::size_t>::decode(node, index))
      refuse(node, "the end of a lane is the number of a vertex");
    if (index >= points_.size())
      refuse(node, ErrorCode::invalid_instance,
             "there is no vertex " + node.Scalar() + " among " + std::to_string(points_.size()));
    return VertexId(index);
  }

  void add_lane(const YAML::Node& node) {
    const YAML::Node more = properties(node, "a lane is [from, to, {properties}]");
    Edge edge{vertex(node[0]), vertex(node[1]), std::nullopt};
    if (edge.from == edge.to)
      refuse(node, ErrorCode::invalid_instance, "a lane from a vertex to itself");
    const Point &from = points_[edge.from.index()], &to = points_[edge.to.index()];
    if (from == to) {
      edge.duration = Ticks(1);
      ++num_zero_length_edges_;
    } else if (more["speed_limit"]) {
      const double limit = number(more["speed_limit"], "speed_limit");
      // Open-RMF writes 0 for none.
      const auto most = limit == 0 ? std::optional(speed_) : quantise_speed(limit, resolution_);
      if (!most) refuse(more["speed_limit"], ErrorCode::out_of_range, "speed_limit is no speed");
      if (*most < speed_) {
        edge.duration = travel_time(from, to, *most);
        if (!edge.duration) refuse(node, ErrorCode::out_of_range, "the lane takes too long");
      }
    }
    edges_.push_back(edge);
  }

  std::string file_;
  Resolution resolution_;
  Speed speed_;
  std::vector<Point> points_;
  std::vector<std::string> names_;
  std::vector<Edge> edges_;
  std::size_t num_zero_length_edges_ = 0;
};

}  // namespace

Result<NavGraph> read_nav_graph(std::istream& in, const std::string& file,
                                const Resolution& resolution, Speed speed) {
  const auto text = text::read_all(in, file);
  if (!text) return text.error();
  return Reader(file, resolution, speed).run(*text);
}

Result<NavGraph> read_nav_graph(const std::filesystem::path& path, const Resolution& resolution,
                                Speed speed) {
  std::ifstream in;
  if (const auto error = text::open_input(path, in)) return *error;
  return read_nav_graph(in, path.string(), resolution, speed);
}

}  // namespace quadrille::continuous
