// SPDX-License-Identifier: MIT
//
// Outputs of the League of Robot Runners, which PlanViz shows: places are [row, column, heading],
// paths are moves such as "U,R,W".
#include <array>
#include <string>
#include <utility>

#include "formats/instance_document.hpp"
#include "formats/motions.hpp"
#include "formats/plan_codecs.hpp"
#include "formats/text_input.hpp"
#include "quadrille/text/open_objects.hpp"

namespace quadrille::discrete {
namespace {

using Node = Document::Node;

class PlanVizReader {
 public:
  PlanVizReader(const Document& document, const Graph& graph)
      : check_(document), objects_(document, check_), grid_(*graph.layout()) {}

  Result<PlanFile> run() {
    std::optional<Node> model, size, starts, paths;
    std::string_view name;
    std::int64_t count = 0;
    if (!objects_.find_all(Document::kRoot, "an output of the League of Robot Runners",
                           {{"actionModel", &model},
                            {"teamSize", &size, false},
                            {"start", &starts},
                            {"actualPaths", &paths}}) ||
        !check_.text(*model, name) ||
        (name != "MAPF" && !check_.fail(*model, ErrorCode::invalid_plan,
                                        "plans of the model " + in_quotes(name) +
                                            " have turns, which belong to another problem; the "
                                            "model MAPF is read")) ||
        !objects_.each_element(*starts, "starts", [&](Node n) { return read_start(n); }) ||
        !objects_.each_element(*paths, "paths", [&](Node n) { return read_path(n); }))
      return check_.error();
    const std::size_t num_paths = file_.plan.paths.size();
    if (num_paths != starts_.size())
      check_.fail(
          *paths, ErrorCode::invalid_plan,
          std::to_string(num_paths) + " paths, but " + std::to_string(starts_.size()) + " starts");
    else if (!size || (check_.integer(*size, 0, INT64_MAX, count) &&
                       (count == static_cast<std::int64_t>(num_paths) ||
                        check_.fail(*size, ErrorCode::invalid_plan,
                                    std::to_string(num_paths) + " paths, not as many"))))
      return std::move(file_);
    return check_.error();
  }

 private:
  bool read_start(Node node) {
    std::array<std::int64_t, 2> place{};  // Row, column.
    std::size_t size = 0;
    const bool is_fine = objects_.each_element(node, "row, column and heading", [&](Node n) {
      const std::size_t at = size++;
      return at >= place.size() || check_.integer(n, 0, INT32_MAX, place[at]);
    });
    if (!is_fine) return false;
    if (size != 2 && size != 3) return check_.fail(node, "expected row, column and heading");
    const auto vertex = find_vertex(grid_, place[1], place[0]);
    if (!vertex)
      return check_.fail(node, ErrorCode::invalid_plan, not_passable(grid_, place[1], place[0]));
    starts_.push_back(*vertex);
    return true;
  }

  bool read_path(Node node) {
    std::string_view text;
    const std::size_t agent = file_.plan.paths.size();
    if (!check_.text(node, text)) return false;
    if (agent == starts_.size())
      return check_.fail(node, ErrorCode::invalid_plan, "there is no start for this path");
    Walk walk(grid_, starts_[agent]);
    for (std::size_t at = 0; at < text.size(); at += 2) {
      const auto motion = find_motion(static_cast<char>(text[at] - 'A' + 'a'));
      const bool is_motion = text[at] >= 'A' && text[at] <= 'Z' && motion;
      if (!is_motion || (at + 1 < text.size() && text[at + 1] != ','))
        return check_.fail(node,
                           "expected moves U, D, L, R and W with commas between them, found " +
                               in_quotes(text.substr(at, 8)));
      if (auto why = walk.step(*motion, 1); !why.empty())
        return check_.fail(node, ErrorCode::invalid_plan, why);
    }
    file_.plan.paths.push_back(std::move(walk).path());
    return true;
  }

  Checker check_;
  text::OpenObjects objects_;
  const GridLayout& grid_;
  Path starts_;
  PlanFile file_;
};

}  // namespace

Result<PlanFile> read_planviz_plan(const std::string& text, const std::string& file,
                                   const Graph& graph) {
  const auto document = parse_json(text, file);
  if (!document) return document.error();
  return PlanVizReader(*document, graph).run();
}

}  // namespace quadrille::discrete
