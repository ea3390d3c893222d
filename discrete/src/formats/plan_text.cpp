// SPDX-License-Identifier: MIT
//
// The two line formats, which differ in everything but their spirit: cbsh2 has a line per agent and
// (row, column), visualizer a line per timestep and (x, y), in results of lacam behind a header.
#include <algorithm>
#include <ostream>
#include <string_view>
#include <utility>

#include "formats/instance_document.hpp"
#include "formats/plan_codecs.hpp"
#include "formats/text_input.hpp"
#include "quadrille/text/sniff.hpp"

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
    if (!scanner.literal("Agent ") || !scanner.natural(number) || !scanner.literal(":"))
      return malformed(scanner, "'Agent <number>:'");
    static_cast<void>(scanner.literal(" "));  // LNS2 leaves it away.
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

  Result<PlanFile> run(bool has_header) {
    if (has_header)
      if (auto error = read_header()) return *error;
    if (auto error = read_steps()) return *error;
    if (auto error = check_header()) return *error;
    return std::move(result_);
  }

 private:
  std::optional<Error> read_steps() {
    std::int64_t timestep = 0;
    while (const auto line = lines_.next()) {
      if (line->empty()) {
        return expect_end();
      }
      if (auto error = read_line(*line, timestep)) return error;
      ++timestep;
    }
    return std::nullopt;
  }

  /// What lacam, lacam2 and lacam3 write above the plan: lines `key=value`, one of them with a
  /// message of its own, up to `solution=`.
  std::optional<Error> read_header() {
    while (const auto line = lines_.next()) {
      const auto equals = line->find('=');
      if (equals == std::string_view::npos) continue;
      const std::string_view key = line->substr(0, equals), value = line->substr(equals + 1);
      if (key == "solution") {
        if (value.empty()) return std::nullopt;
        return fail(ErrorCode::syntax, "expected the plan in the lines after 'solution='");
      }
      if (key == "solved" && value != "1")
        return fail(ErrorCode::invalid_plan, "there is no plan: solved=" + printable(value, 40));
      if (auto error = read_statement(key, value)) return error;
    }
    return fail(ErrorCode::invalid_plan, "there is no plan: no line 'solution='");
  }

  std::optional<Error> read_statement(std::string_view key, std::string_view value) {
    if (key == "starts") return read_places(value, starts_);
    if (key == "goals") return read_places(value, goals_);
    StatedOutcome& stated = result_.stated;
    for (const auto& [name, number] :
         {std::pair<std::string_view, std::optional<Cost>*>{"agents", &agents_},
          {"soc", &stated.sum_of_costs},
          {"makespan", &stated.makespan},
          {"soc_lb", &stated.lower_bound}}) {
      if (key != name) continue;
      const Natural natural = parse_natural(value, INT64_MAX);
      if (natural.fault != NumberFault::none)
        return fail(ErrorCode::syntax,
                    std::string(name) + " is " + in_quotes(value) + ", not a natural number");
      if (*number) return fail(ErrorCode::syntax, std::string(name) + " is given twice");
      *number = natural.value;
      if (number == &agents_) agents_line_ = lines_.number();
    }
    return std::nullopt;
  }

  /// Starts or goals, in the order of the agents.
  struct Ends {
    long line = 0;  // 0: not there.
    Path places;
  };
  std::optional<Error> read_places(std::string_view text, Ends& ends) {
    if (ends.line != 0) return fail(ErrorCode::syntax, "given twice");
    ends.line = lines_.number();
    LineScanner scanner(text);
    std::int64_t x = 0, y = 0;
    while (!scanner.at_end()) {
      if (!scanner.pair(x, y, ",")) return malformed(scanner, "'(<x>,<y>),'");
      if (auto error = append(ends.places.size(), ends.places, x, y)) return error;
    }
    return std::nullopt;
  }

  /// The header is about this plan.
  std::optional<Error> check_header() const {
    const auto& paths = result_.plan.paths;
    if (agents_ && *agents_ != static_cast<Cost>(paths.size()))
      return Error{ErrorCode::invalid_plan,
                   std::to_string(*agents_) + " agents are stated, but " +
                       std::to_string(paths.size()) + " have paths",
                   {file_, agents_line_}};
    for (const Ends* const ends : {&starts_, &goals_}) {
      if (ends->line == 0) continue;
      const bool are_starts = ends == &starts_;
      bool agree = ends->places.size() == paths.size();
      for (std::size_t i = 0; agree && i < paths.size(); ++i) {
        const Path& path = paths[AgentId(i)];
        agree = ends->places[i] == (are_starts ? path.front() : path.back());
      }
      if (!agree)
        return Error{ErrorCode::invalid_plan,
                     are_starts ? "these are not the places where the paths begin"
                                : "these are not the places where the paths end",
                     {file_, ends->line}};
    }
    return std::nullopt;
  }

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

  std::optional<Cost> agents_;
  long agents_line_ = 0;
  Ends starts_, goals_;
};

void write_place(std::ostream& out, const Graph& graph, VertexId v) {
  const Cell cell = graph.layout()->cell_of(v);
  out << '(' << cell.x << ',' << cell.y << "),";
}

}  // namespace

Result<PlanFile> read_cbsh2_plan(const std::string& text, const std::string& file,
                                 const Graph& graph) {
  return Cbsh2Reader(text, file, graph).run();
}

Result<PlanFile> read_visualizer_plan(const std::string& text, const std::string& file,
                                      const Graph& graph) {
  const bool has_header = text::sniff(text) == text::FileKind::lacam_result;
  return VisualizerReader(text, file, graph).run(has_header);
}

Result<PlanFile> read_lacam_plan(const std::string& text, const std::string& file,
                                 const Graph& graph) {
  return VisualizerReader(text, file, graph).run(true);
}

void write_cbsh2_plan(std::ostream& out, const Graph& graph, const Plan& plan,
                      std::string_view colon) {
  // An empty line tells the plan for no agents from a file that could not be written.
  if (plan.paths.empty()) out << '\n';
  for (std::size_t i = 0; i < plan.paths.size(); ++i) {
    out << "Agent " << i << colon;
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
    for (const Path& path : plan.paths) write_place(out, graph, path[std::min(t, path.size() - 1)]);
    out << '\n';
    if (!out) return;
  }
}

void write_lacam_plan(std::ostream& out, const Graph& graph, const Plan& plan) {
  out << "agents=" << plan.paths.size()
      << "\nsolver=quadrille\nsolved=1\nsoc=" << plan.cost(Objective::sum_of_costs)
      << "\nmakespan=" << plan.cost(Objective::makespan) << "\nstarts=";
  for (const Path& path : plan.paths) write_place(out, graph, path.front());
  out << "\ngoals=";
  for (const Path& path : plan.paths) write_place(out, graph, path.back());
  out << "\nsolution=\n";
  write_visualizer_plan(out, graph, plan);
}

}  // namespace quadrille::discrete
