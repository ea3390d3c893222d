// SPDX-License-Identifier: MIT
//
// The two line formats, which differ in everything but their spirit: cbsh2 has a line per agent and
// (row, column), visualizer a line per timestep and (x, y).
#include <algorithm>
#include <ostream>
#include <string_view>
#include <utility>

#include "formats/instance_document.hpp"
#include "formats/plan_codecs.hpp"
#include "formats/text_input.hpp"

namespace quadrille::discrete {
namespace {

/// Reads one line from left to right.
class LineScanner {
 public:
  explicit LineScanner(std::string_view line) : line_(line) {}

  [[nodiscard]] bool at_end() const { return at_ == line_.size(); }
  [[nodiscard]] std::size_t column() const { return at_ + 1; }
  bool literal(std::string_view wanted) {
    if (line_.substr(at_, wanted.size()) != wanted) return false;
    at_ += wanted.size();
    return true;
  }
  bool natural(std::int64_t& value) {
    const auto end = std::min(line_.find_first_not_of("0123456789", at_), line_.size());
    const Natural number = parse_natural(line_.substr(at_, end - at_), INT32_MAX);
    if (number.fault != NumberFault::none) return false;
    value = number.value;
    at_ = end;
    return true;
  }
  /// `(first,second)` and what follows it.
  bool pair(std::int64_t& first, std::int64_t& second, std::string_view end) {
    return literal("(") && natural(first) && literal(",") && natural(second) && literal(")") &&
           literal(end);
  }

 private:
  std::string_view line_;
  std::size_t at_ = 0;
};

/// What the readers of both formats share: errors with places, and lines up to the trailing ones.
class LinePlanReader {
 public:
  LinePlanReader(const std::string& text, const std::string& file, const Graph& graph)
      : lines_(text), file_(file), grid_(*graph.layout()) {}

 protected:
  ~LinePlanReader() = default;

  Error fail(ErrorCode code, std::string message) const {
    return {code, std::move(message), {file_, lines_.number()}};
  }
  Error malformed(const LineScanner& scanner, const char* wanted) const {
    return fail(ErrorCode::syntax,
                "column " + std::to_string(scanner.column()) + ": expected " + wanted);
  }
  /// Appends a place to the path of an agent.
  std::optional<Error> append(std::size_t agent, Path& path, std::int64_t x, std::int64_t y) const {
    const auto vertex = find_vertex(grid_, x, y);
    if (!vertex)
      return fail(ErrorCode::invalid_plan, "agent " + std::to_string(agent) + " at timestep " +
                                               std::to_string(path.size()) + ": " +
                                               not_passable(grid_, x, y));
    path.push_back(*vertex);
    return std::nullopt;
  }
  /// The rest of the file is empty lines.
  std::optional<Error> expect_end() {
    while (const auto line = lines_.next())
      if (!line->empty()) return fail(ErrorCode::syntax, "text after an empty line");
    return std::nullopt;
  }

  LineReader lines_;
  const std::string& file_;
  const GridLayout& grid_;
  PlanFile result_;
};

class Cbsh2Reader final : LinePlanReader {
 public:
  using LinePlanReader::LinePlanReader;

  Result<PlanFile> run() {
    while (const auto line = lines_.next()) {
      if (line->empty()) {
        if (auto error = expect_end()) return *error;
        break;
      }
      if (auto error = read_line(*line)) return *error;
    }
    return std::move(result_);
  }

 private:
  std::optional<Error> read_line(std::string_view line) {
    LineScanner scanner(line);
    std::int64_t number = 0, row = 0, column = 0;
    if (!scanner.literal("Agent ") || !scanner.natural(number) || !scanner.literal(": "))
      return malformed(scanner, "'Agent <number>: '");
    const std::size_t agent = result_.plan.paths.size();
    if (number != static_cast<std::int64_t>(agent))
      return fail(ErrorCode::syntax, "expected agent " + std::to_string(agent) + ", found agent " +
                                         std::to_string(number));
    Path path;
    while (!scanner.at_end()) {
      if (!scanner.pair(row, column, "->")) return malformed(scanner, "'(<row>,<column>)->'");
      if (auto error = append(agent, path, column, row)) return error;
    }
    if (path.empty()) return malformed(scanner, "'(<row>,<column>)->'");
    result_.plan.paths.push_back(std::move(path));
    return std::nullopt;
  }
};

class VisualizerReader final : LinePlanReader {
 public:
  using LinePlanReader::LinePlanReader;

  Result<PlanFile> run() {
    std::int64_t timestep = 0;
    while (const auto line = lines_.next()) {
      if (line->empty()) {
        if (auto error = expect_end()) return *error;
        break;
      }
      if (auto error = read_line(*line, timestep)) return *error;
      ++timestep;
    }
    return std::move(result_);
  }

 private:
  std::optional<Error> read_line(std::string_view line, std::int64_t timestep) {
    LineScanner scanner(line);
    std::int64_t number = 0, x = 0, y = 0;
    if (!scanner.natural(number) || !scanner.literal(":"))
      return malformed(scanner, "'<timestep>:'");
    if (number != timestep)
      return fail(ErrorCode::syntax, "expected timestep " + std::to_string(timestep) +
                                         ", found timestep " + std::to_string(number));
    auto& paths = result_.plan.paths;
    std::size_t agent = 0;
    for (; !scanner.at_end(); ++agent) {
      if (!scanner.pair(x, y, ",")) return malformed(scanner, "'(<x>,<y>),'");
      if (timestep == 0) paths.push_back({});
      if (agent == paths.size()) return wrong_count();
      if (auto error = append(agent, paths[AgentId(agent)], x, y)) return error;
    }
    if (agent != paths.size()) return wrong_count();
    return std::nullopt;
  }

  Error wrong_count() const {
    return fail(ErrorCode::syntax, "there have to be " + std::to_string(result_.plan.paths.size()) +
                                       " places, as many as at timestep 0");
  }
};

}  // namespace

Result<PlanFile> read_cbsh2_plan(const std::string& text, const std::string& file,
                                 const Graph& graph) {
  return Cbsh2Reader(text, file, graph).run();
}

Result<PlanFile> read_visualizer_plan(const std::string& text, const std::string& file,
                                      const Graph& graph) {
  return VisualizerReader(text, file, graph).run();
}

void write_cbsh2_plan(std::ostream& out, const Graph& graph, const Plan& plan) {
  // An empty line tells the plan for no agents from a file that could not be written.
  if (plan.paths.empty()) out << '\n';
  for (std::size_t i = 0; i < plan.paths.size(); ++i) {
    out << "Agent " << i << ": ";
    for (const VertexId v : plan.paths[AgentId(i)]) {
      const Cell cell = graph.layout()->cell_of(v);
      out << '(' << cell.y << ',' << cell.x << ")->";
    }
    out << '\n';
  }
}

void write_visualizer_plan(std::ostream& out, const Graph& graph, const Plan& plan) {
  std::size_t length = 1;  // Without agents too: the line tells the file from an empty one.
  for (const Path& path : plan.paths) length = std::max(length, path.size());
  for (std::size_t t = 0; t < length; ++t) {
    out << t << ':';
    for (const Path& path : plan.paths) {
      const Cell cell = graph.layout()->cell_of(path[std::min(t, path.size() - 1)]);
      out << '(' << cell.x << ',' << cell.y << "),";
    }
    out << '\n';
    if (!out) return;
  }
}

}  // namespace quadrille::discrete
