// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <istream>
#include <ostream>
#include <string_view>
#include <utility>

#include "formats/text_input.hpp"
#include "quadrille/core/contract.hpp"
#include "quadrille/discrete/movingai.hpp"
#include "quadrille/text/sniff.hpp"

namespace quadrille::discrete {
namespace {

constexpr std::size_t kNumFields = 9;
constexpr std::string_view kSeparators = " \t";
constexpr const char* kFieldNames[kNumFields] = {"bucket", "map name", "width",
                                                 "height", "start x",  "start y",
                                                 "goal x", "goal y",   "optimal length"};

/// The fields of a line; counts all, keeps the first nine.
std::size_t split(std::string_view line, std::array<std::string_view, kNumFields>& fields) {
  std::size_t count = 0;
  for (std::size_t at = 0; at < line.size();) {
    const auto begin = line.find_first_not_of(kSeparators, at);
    if (begin == std::string_view::npos) break;
    const auto end = std::min(line.find_first_of(kSeparators, begin), line.size());
    if (count < kNumFields) fields[count] = line.substr(begin, end - begin);
    ++count;
    at = end;
  }
  return count;
}

class RowReader {
 public:
  RowReader(std::string_view line, SourcePlace where) : where_(std::move(where)) {
    count_ = split(line, fields_);
  }

  Result<ScenarioRow> run() {
    if (count_ != kNumFields)
      return fail("a row has " + std::to_string(kNumFields) + " fields, this one has " +
                  std::to_string(count_));
    ScenarioRow row;
    row.line = where_.line;
    row.map = std::string(fields_[1]);
    if (row.map.find('\r') != std::string::npos)
      return fail("the map name " + in_quotes(row.map) + " contains a carriage return");
    const bool fine = natural(0, row.bucket) && natural(2, row.width) && natural(3, row.height) &&
                      natural(4, row.start.x) && natural(5, row.start.y) &&
                      natural(6, row.goal.x) && natural(7, row.goal.y) && length(8, row.optimal);
    if (!fine) return *error_;
    if (row.width == 0 || row.height == 0) return fail("the map has no cells");
    return row;
  }

 private:
  Error fail(std::string message, ErrorCode code = ErrorCode::syntax) const {
    return {code, std::move(message), where_};
  }

  template <class Number>
  bool natural(std::size_t field, Number& value) {
    const Natural number = parse_natural(fields_[field], INT32_MAX);
    value = static_cast<Number>(number.value);
    if (number.fault == NumberFault::none) return true;
    const std::string text =
        std::string("the ") + kFieldNames[field] + " " + in_quotes(fields_[field]);
    error_ = number.fault == NumberFault::too_large
                 ? fail(text + " is too large", ErrorCode::out_of_range)
                 : fail(text + " is not a natural number");
    return false;
  }

  bool length(std::size_t field, double& value) {
    const std::string_view text = fields_[field];
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (code == std::errc() && end == text.data() + text.size() && std::isfinite(value) &&
        !std::signbit(value))
      return true;
    error_ =
        fail(std::string("the ") + kFieldNames[field] + " " + in_quotes(text) + " is not a length");
    return false;
  }

  SourcePlace where_;
  std::array<std::string_view, kNumFields> fields_;
  std::size_t count_ = 0;
  std::optional<Error> error_;
};

std::string size_text(std::int32_t width, std::int32_t height) {
  return std::to_string(width) + " x " + std::to_string(height);
}

bool is_for(const ScenarioRow& row, std::int32_t width, std::int32_t height) {
  return row.width == width && row.height == height;
}

Error refuse_row(const Scenario& scenario, const ScenarioRow& row, std::string message) {
  return {ErrorCode::invalid_instance, std::move(message), {scenario.file, row.line}};
}

/// Finds rows among the first `count` that have the same start, or the same goal.
std::optional<Error> find_shared(const GridLayout& grid, const Scenario& scenario,
                                 std::size_t count, Cell ScenarioRow::*end, const char* name) {
  constexpr std::size_t kNone = SIZE_MAX;
  IdVector<VertexId, std::size_t> owner(grid.num_vertices(), kNone);
  for (std::size_t i = 0; i < count; ++i) {
    const ScenarioRow& row = scenario.rows[i];
    std::size_t& first = owner[*grid.vertex_at(row.*end)];
    if (first == kNone) {
      first = i;
      continue;
    }
    std::string message = "agents " + std::to_string(first) + " and " + std::to_string(i) +
                          " have the same " + name + " (" + std::to_string((row.*end).x) + ", " +
                          std::to_string((row.*end).y) + ")";
    if (row.line > 0)
      message += ", see lines " + std::to_string(scenario.rows[first].line) + " and " +
                 std::to_string(row.line);
    return refuse_row(scenario, row, std::move(message));
  }
  return std::nullopt;
}

std::optional<Error> check_rows(const GridLayout& grid, const Scenario& scenario,
                                std::size_t count) {
  for (std::size_t i = 0; i < scenario.rows.size(); ++i) {
    const ScenarioRow& row = scenario.rows[i];
    for (const auto& [name, cell] : {std::pair("start", row.start), std::pair("goal", row.goal)})
      if (cell.x >= grid.width() || cell.y >= grid.height())
        return refuse_row(
            scenario, row,
            std::string("the ") + name + " (" + std::to_string(cell.x) + ", " +
                std::to_string(cell.y) + ") is outside the map of " +
                size_text(grid.width(), grid.height()) + " cells" +
                (is_for(row, grid.width(), grid.height())
                     ? ""
                     : ", and the row is for one of " + size_text(row.width, row.height)));
    if (i >= count) continue;
    for (const auto& [name, cell] : {std::pair("start", row.start), std::pair("goal", row.goal)})
      if (!grid.vertex_at(cell))
        return refuse_row(scenario, row,
                          "agent " + std::to_string(i) + ": the " + name + " (" +
                              std::to_string(cell.x) + ", " + std::to_string(cell.y) +
                              ") is blocked");
  }
  return std::nullopt;
}

}  // namespace

Result<Scenario> read_scenario(std::istream& in, const std::string& file) {
  const auto text = read_all(in, file);
  if (!text) return text.error();
  if (auto error = text::refuse_other(*text, file, {text::FileKind::movingai_scenario}))
    return *error;
  LineReader lines(*text);
  const auto fail = [&](long line, std::string message) {
    return Error{ErrorCode::syntax, std::move(message), {file, line}};
  };
  const auto header = lines.next();
  if (!header || (*header != "version 1" && *header != "version 1.0"))
    return fail(1,
                "expected 'version 1' or 'version 1.0', found " + in_quotes(header.value_or("")));

  Scenario scenario;
  scenario.file = file;
  long empty_line = 0;  // Empty lines may only be the last ones.
  while (const auto line = lines.next()) {
    if (line->empty()) {
      if (empty_line == 0) empty_line = lines.number();
      continue;
    }
    if (empty_line > 0) return fail(empty_line, "an empty line between the rows");
    auto row = RowReader(*line, {file, lines.number()}).run();
    if (!row) return row.error();
    scenario.rows.push_back(std::move(row).value());
  }
  return scenario;
}

Result<Scenario> read_scenario(const std::filesystem::path& path) {
  std::ifstream in;
  if (auto error = open_input(path, in)) return *error;
  return read_scenario(in, path.string());
}

std::string note_on_sizes(const Scenario& scenario, std::int32_t width, std::int32_t height) {
  for (const ScenarioRow& row : scenario.rows)
    if (!is_for(row, width, height))
      return "line " + std::to_string(row.line) + " is for a map of " +
             size_text(row.width, row.height) + " cells, and this one has " +
             size_text(width, height) + "; all cells are inside of it";
  return "";
}

std::optional<Error> write_scenario(std::ostream& out, const std::string& file,
                                    const Scenario& scenario) {
  out << "version 1\n";
  std::array<char, 512> number;  // The longest double has 309 digits before the point.
  for (const ScenarioRow& row : scenario.rows) {
    QUADRILLE_REQUIRE(!row.map.empty() && row.map.find_first_of(" \t\r\n") == std::string::npos,
                      "a map name is one field");
    const auto end = std::to_chars(number.data(), number.data() + number.size(), row.optimal,
                                   std::chars_format::fixed, 8);
    out << row.bucket << '\t' << row.map << '\t' << row.width << '\t' << row.height << '\t'
        << row.start.x << '\t' << row.start.y << '\t' << row.goal.x << '\t' << row.goal.y << '\t'
        << std::string_view(number.data(), static_cast<std::size_t>(end.ptr - number.data()))
        << '\n';
    if (!out) break;
  }
  return finish_output(out, file);
}

Result<Instance> make_instance(std::shared_ptr<const Graph> graph, const Scenario& scenario,
                               std::size_t num_agents) {
  QUADRILLE_REQUIRE(graph != nullptr && graph->layout(), "scenarios are about grids");
  const GridLayout& grid = *graph->layout();
  if (num_agents > scenario.rows.size())
    return Error{ErrorCode::invalid_instance,
                 "there are rows for " + std::to_string(scenario.rows.size()) +
                     " agents, not for " + std::to_string(num_agents),
                 {scenario.file, scenario.rows.empty() ? 0 : scenario.rows.back().line}};
  if (auto error = check_rows(grid, scenario, num_agents)) return *error;
  if (auto error = find_shared(grid, scenario, num_agents, &ScenarioRow::start, "start"))
    return *error;
  if (auto error = find_shared(grid, scenario, num_agents, &ScenarioRow::goal, "goal"))
    return *error;
  std::vector<Agent> tasks;
  tasks.reserve(num_agents);
  for (std::size_t i = 0; i < num_agents; ++i)
    tasks.push_back(
        {*grid.vertex_at(scenario.rows[i].start), *grid.vertex_at(scenario.rows[i].goal)});
  return Instance::make(std::move(graph), std::move(tasks));
}

}  // namespace quadrille::discrete
