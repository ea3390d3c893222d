// SPDX-License-Identifier: MIT
//
// Rows of the MAPF tracker: CSV with a header, in which solution_plan has a line per agent of moves
// such as 5r2d3w4d, from its start on.
#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "formats/motions.hpp"
#include "formats/plan_codecs.hpp"
#include "formats/text_input.hpp"

namespace quadrille::discrete {
namespace {

/// Longer paths are refused: a few digits must not cost gigabytes.
constexpr std::size_t kMaxSteps = std::size_t{1} << 26;

struct Field {
  std::string text;
  long line = 0;
};

/// Splits CSV into records: fields are separated by commas; one in double quotes may have commas,
/// line ends, and double quotes, which are doubled.
class CsvReader {
 public:
  CsvReader(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  [[nodiscard]] bool at_end() const { return at_ == text_.size(); }
  /// Requires that the end is not reached.
  Result<std::vector<Field>> next() {
    std::vector<Field> record;
    while (true) {
      Field field{"", line_};
      if (at_ < text_.size() && text_[at_] == '"') {
        if (auto error = read_quoted(field.text)) return *error;
      } else {
        const auto end = std::min(text_.find_first_of(",\r\n", at_), text_.size());
        field.text = text_.substr(at_, end - at_);
        at_ = end;
      }
      record.push_back(std::move(field));
      if (at_ < text_.size() && text_[at_] == ',') {
        ++at_;
        continue;
      }
      if (at_ < text_.size() && text_[at_] == '\r') ++at_;
      if (at_ == text_.size()) return record;
      if (text_[at_] != '\n')
        return Error{ErrorCode::syntax, "text behind a quoted field", {file_, line_}};
      ++at_, ++line_;
      return record;
    }
  }

 private:
  std::optional<Error> read_quoted(std::string& field) {
    const long begins = line_;
    for (++at_; at_ < text_.size(); ++at_) {
      if (text_[at_] == '\n') ++line_;
      if (text_[at_] == '"') {
        ++at_;
        if (at_ == text_.size() || text_[at_] != '"') return std::nullopt;
      }
      field += text_[at_];
    }
    return Error{ErrorCode::syntax, "the file ends inside of quotes", {file_, begins}};
  }

  std::string_view text_;
  const std::string& file_;
  std::size_t at_ = 0;
  long line_ = 1;
};

class TrackerReader {
 public:
  TrackerReader(const std::string& text, const std::string& file, const Graph& graph,
                const IdVector<AgentId, Agent>& agents)
      : csv_(text, file), file_(file), grid_(*graph.layout()), agents_(agents) {}

  Result<PlanFile> run() {
    auto header = csv_.next();
    if (!header) return header.error();
    for (std::size_t column = 0; column < header->size(); ++column)
      if (!columns_.emplace((*header)[column].text, column).second)
        return fail(1, "two columns are called " + in_quotes((*header)[column].text));
    for (const char* const name : {"agents", "solution_plan"})
      if (!columns_.contains(name)) return fail(1, "there is no column " + in_quotes(name));
    std::optional<std::vector<Field>> ours;
    while (!csv_.at_end()) {
      auto record = csv_.next();
      if (!record) return record.error();
      if (record->size() == 1 && record->front().text.empty()) continue;
      if (record->size() != columns_.size())
        return fail(record->front().line, std::to_string(record->size()) + " fields under " +
                                              std::to_string(columns_.size()) + " columns");
      if (field(*record, "agents")->text != std::to_string(agents_.size())) continue;
      if (ours)
        return fail(record->front().line,
                    "a second row for " + std::to_string(agents_.size()) + " agents",
                    ErrorCode::invalid_plan);
      ours = std::move(record).value();
    }
    if (!ours)
      return fail(0, "there is no row for " + std::to_string(agents_.size()) + " agents",
                  ErrorCode::invalid_plan);
    return read_row(*ours);
  }

 private:
  Error fail(long line, std::string message, ErrorCode code = ErrorCode::syntax) const {
    return {code, std::move(message), {file_, line}};
  }
  /// Null if there is no such column.
  [[nodiscard]] const Field* field(const std::vector<Field>& record, const char* name) const {
    const auto column = columns_.find(name);
    return column == columns_.end() ? nullptr : &record[column->second];
  }

  Result<PlanFile> read_row(const std::vector<Field>& record) {
    PlanFile result;
    if (auto error = read_cost(record, "solution_cost", result.stated.sum_of_costs)) return *error;
    if (auto error = read_cost(record, "lower_cost", result.stated.lower_bound)) return *error;
    if (const Field* const flip = field(record, "flip_up_down")) {
      is_flipped_ = flip->text == "TRUE" || flip->text == "true";
      if (!is_flipped_ && flip->text != "FALSE" && flip->text != "false" && !flip->text.empty())
        return fail(flip->line, "flip_up_down is " + in_quotes(flip->text));
    }
    const Field& plan = *field(record, "solution_plan");
    LineReader lines(plan.text);
    while (const auto line = lines.next()) {
      const long number = plan.line + lines.number() - 1;
      const std::size_t agent = result.plan.paths.size();
      if (agent == agents_.size()) {
        if (line->empty()) continue;
        return fail(number, "a path for agent " + std::to_string(agent), ErrorCode::invalid_plan);
      }
      Walk walk(grid_, agents_[AgentId(agent)].start);
      if (auto error = read_path(*line, number, agent, walk)) return *error;
      result.plan.paths.push_back(std::move(walk).path());
    }
    if (result.plan.paths.size() != agents_.size())
      return fail(plan.line,
                  std::to_string(result.plan.paths.size()) + " paths for " +
                      std::to_string(agents_.size()) + " agents",
                  ErrorCode::invalid_plan);
    return result;
  }

  std::optional<Error> read_cost(const std::vector<Field>& record, const char* name,
                                 std::optional<Cost>& cost) const {
    const Field* const found = field(record, name);
    if (found == nullptr || found->text.empty()) return std::nullopt;
    const Natural number = parse_natural(found->text, INT64_MAX);
    if (number.fault != NumberFault::none)
      return fail(found->line,
                  std::string(name) + " is " + in_quotes(found->text) + ", not a natural number");
    cost = number.value;
    return std::nullopt;
  }

  std::optional<Error> read_path(std::string_view line, long number, std::size_t agent,
                                 Walk& walk) {
    for (std::size_t at = 0; at < line.size(); ++at) {
      const auto end = std::min(line.find_first_not_of("0123456789", at), line.size());
      const Natural count = end == at ? Natural{1, NumberFault::none}
                                      : parse_natural(line.substr(at, end - at), kMaxSteps);
      auto motion = end < line.size() ? find_motion(line[end]) : std::nullopt;
      if (count.fault != NumberFault::none || !motion)
        return fail(number,
                    "expected moves such as 5r2d3w, found " + in_quotes(line.substr(at, 12)));
      at = end;
      num_steps_ += static_cast<std::size_t>(count.value);
      if (num_steps_ > kMaxSteps)
        return fail(number, "the paths have more than " + std::to_string(kMaxSteps) + " steps",
                    ErrorCode::out_of_range);
      if (is_flipped_) motion->dy = -motion->dy;
      if (auto why = walk.step(*motion, count.value); !why.empty())
        return fail(number, "agent " + std::to_string(agent) + ", " + why, ErrorCode::invalid_plan);
    }
    return std::nullopt;
  }

  CsvReader csv_;
  const std::string& file_;
  const GridLayout& grid_;
  const IdVector<AgentId, Agent>& agents_;
  std::map<std::string, std::size_t> columns_;
  bool is_flipped_ = false;
  std::size_t num_steps_ = 0;
};

}  // namespace

Result<PlanFile> read_tracker_plan(const std::string& text, const std::string& file,
                                   const Graph& graph, const IdVector<AgentId, Agent>& agents) {
  return TrackerReader(text, file, graph, agents).run();
}

}  // namespace quadrille::discrete
