// SPDX-License-Identifier: MIT
#include "quadrille/input/robot_runners.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "member.hpp"
#include "quadrille/discrete/movingai.hpp"
#include "quadrille/input/source.hpp"
#include "quadrille/text/document.hpp"
#include "quadrille/text/sniff.hpp"
#include "quadrille/text/text_input.hpp"

namespace quadrille::input {
namespace {

using text::Document;

/// Points where goods come and go, besides the usual letters.
constexpr const char* kPassable = "ES";

/// A line of a file of robots or tasks.
struct Location {
  long line = 0;
  std::vector<std::int64_t> cells = {};
};

/// The numbers of each line, with commas between them, as many lines as the first one says. Lines
/// that are empty or begin with # mean nothing. A cell has to be passable.
class LocationsReader {
 public:
  LocationsReader(const discrete::GridMap& map, std::string file)
      : map_(map), file_(std::move(file)) {}

  [[nodiscard]] Result<std::vector<Location>> read() const {
    const auto text = read_text(file_);
    if (!text) return text.error();
    text::LineReader lines(*text);
    std::optional<std::int64_t> count;
    std::vector<Location> locations;
    while (const auto line = lines.next()) {
      if (line->empty() || line->front() == '#') continue;
      if (count && static_cast<std::int64_t>(locations.size()) == *count) break;
      auto numbers = numbers_of(*line);
      if (!numbers)
        return error(ErrorCode::syntax, lines.number(),
                     text::in_quotes(*line) + (count ? " is no cell" : " is no number of lines"));
      if (!count) {
        count = numbers->front();
        continue;
      }
      for (const std::int64_t cell : *numbers)
        if (cell >= static_cast<std::int64_t>(map_.passable.size()) ||
            !map_.passable[static_cast<std::size_t>(cell)])
          return error(ErrorCode::invalid_instance, lines.number(),
                       "cell " + std::to_string(cell) + " of the map is not passable");
      locations.push_back({lines.number(), *std::move(numbers)});
    }
    if (!count || static_cast<std::int64_t>(locations.size()) < *count)
      return error(ErrorCode::syntax, lines.number(), "the file ends too early");
    return locations;
  }

 private:
  /// At least one; nullopt if something else stands between the commas. One comma may be the end.
  static std::optional<std::vector<std::int64_t>> numbers_of(std::string_view line) {
    std::vector<std::int64_t> numbers;
    while (numbers.empty() || !line.empty()) {
      const std::size_t end = line.find(',');
      const auto number = text::parse_natural(line.substr(0, end), INT32_MAX);
      if (number.fault != text::NumberFault::none) return std::nullopt;
      numbers.push_back(number.value);
      line.remove_prefix(end == std::string_view::npos ? line.size() : end + 1);
    }
    return numbers;
  }
  [[nodiscard]] Error error(ErrorCode code, long line, const std::string& message) const {
    return {code, message, {file_, line}};
  }
  const discrete::GridMap& map_;
  const std::string file_;
};

/// What the problem says itself.
struct Problem {
  std::string map, robots, tasks;  ///< Files.
  std::optional<std::int64_t> team_size;
  double num_revealed = 1;
};

Result<Problem> read_problem(const std::string& text, const std::string& file) {
  const auto document = text::parse_json(text, file);
  if (!document) return document.error();
  if (document->kind(Document::kRoot) != Document::Kind::object)
    return document->error(Document::kRoot, ErrorCode::syntax, "an object is needed");
  text::Checker check(*document);
  Problem problem;
  const std::filesystem::path folder = std::filesystem::path(file).parent_path();
  for (auto& [name, path] :
       {std::pair{"mapFile", &problem.map}, std::pair{"agentFile", &problem.robots},
        std::pair{"taskFile", &problem.tasks}}) {
    const auto value = member(*document, name);
    std::string_view named;
    if (!value)
      return document->error(Document::kRoot, ErrorCode::syntax,
                             "the key '" + std::string(name) + "' is missing");
    if (!check.text(*value, named)) return check.error();
    *path = folder / named;
  }
  for (const char* name : {"agentSize", "agentCounter"})
    if (const auto value = member(*document, name))
      return document->error(*value, ErrorCode::invalid_instance,
                             "it belongs to problems with actions that take several ticks and may "
                             "be late; only those of one timestep for each action are read");
  if (const auto value = member(*document, "teamSize"))
    if (!check.integer(*value, 0, INT32_MAX, problem.team_size.emplace())) return check.error();
  if (const auto value = member(*document, "numTasksReveal"))
    if (!check.number(*value, problem.num_revealed)) return check.error();
  return problem;
}

}  // namespace

bool is_robot_runners(const std::string& text) {
  return text::sniff(text) == text::FileKind::lorr_problem;
}

Result<RobotRunnersProblem> read_robot_runners(const std::string& text, const std::string& file) {
  const auto problem = read_problem(text, file);
  if (!problem) return problem.error();
  auto map = discrete::read_map(std::filesystem::path(problem->map), {kPassable, ""});
  if (!map) return map.error();
  const auto robots = LocationsReader(*map, problem->robots).read();
  if (!robots) return robots.error();
  const auto tasks = LocationsReader(*map, problem->tasks).read();
  if (!tasks) return tasks.error();
  const auto count = static_cast<std::size_t>(
      problem->team_size.value_or(static_cast<std::int64_t>(robots->size())));
  const auto too_few = [&](const char* what, const std::string& where, std::size_t size) {
    return Error{ErrorCode::invalid_instance,
                 "there are " + std::to_string(size) + " " + what + " for " +
                     std::to_string(count) + " robots",
                 {where, 0}};
  };
  if (robots->size() < count) return too_few("starts", problem->robots, robots->size());
  if (tasks->size() < count) return too_few("tasks", problem->tasks, tasks->size());

  RobotRunnersProblem result{{map->height, map->width, std::move(map->passable)},
                             {problem->robots, {}}};
  for (std::size_t i = 0; i < count; ++i)
    result.task.rows.push_back(
        {(*robots)[i].line, std::pair{(*robots)[i].cells.front(), (*tasks)[i].cells.front()}});
  for (const Location& location : *tasks) result.all_tasks.push_back(location.cells);
  result.num_revealed = problem->num_revealed;
  return result;
}

}  // namespace quadrille::input
