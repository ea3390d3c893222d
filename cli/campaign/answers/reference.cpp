// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <charconv>
#include <fstream>

#include "campaign/answers/merged.hpp"
#include "quadrille/text/text_input.hpp"

namespace quadrille::cli::campaign {
namespace {

constexpr std::string_view kSeconds = "_cpu_s";

/// No field of such a file has a comma or a quote in it.
std::vector<std::string> fields(std::string_view line) {
  std::vector<std::string> found;
  while (true) {
    const auto comma = line.find(',');
    found.emplace_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return found;
    line.remove_prefix(comma + 1);
  }
}

struct Columns {
  std::optional<std::size_t> map, scenario, random_scenario, variant, share_goals, agents, cost;
  std::vector<std::size_t> seconds;
};

Columns find_columns(const std::vector<std::string>& names, Reference& reference) {
  Columns columns;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string& name = names[i];
    if (name == "map") columns.map = i;
    if (name == "scenario") columns.scenario = i;
    if (name == "random_scen") columns.random_scenario = i;
    if (name == "variant") columns.variant = i;
    if (name == "share_goals") columns.share_goals = i;
    if (name == "agents") columns.agents = i;
    if (name == "cost" || name == "optimal_sum_of_costs") columns.cost = i;
    if (!name.ends_with(kSeconds)) continue;
    columns.seconds.push_back(i);
    reference.solvers.push_back(name.substr(0, name.size() - kSeconds.size()));
  }
  return columns;
}

std::optional<double> seconds(const std::string& text) {
  double value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || stop != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

Result<Reference> read_reference(const std::string& path) {
  Reference reference;
  std::ifstream in;
  if (auto error = text::open_input(path, in)) return *error;
  const auto text = text::read_all(in, path);
  if (!text) return text.error();
  text::LineReader lines(*text);
  const auto fail = [&](const std::string& message) {
    return Error{ErrorCode::syntax, message, {path, lines.number()}};
  };
  const auto names = fields(lines.next().value_or(""));
  const Columns columns = find_columns(names, reference);
  if (!columns.map || !columns.agents || (!columns.scenario && !columns.random_scenario))
    return fail("the columns map, scenario (or random_scen) and agents are needed");
  while (const auto line = lines.next()) {
    if (line->empty()) continue;
    const auto row = fields(*line);
    if (row.size() != names.size())
      return fail(fmt::format("{} fields, but {} columns", row.size(), names.size()));
    const auto agents = text::parse_natural(row[*columns.agents], INT32_MAX);
    if (agents.fault != text::NumberFault::none) return fail("the number of agents is none");
    const Reference::Key key{
        row[*columns.map],
        columns.scenario ? row[*columns.scenario] : "random-" + row[*columns.random_scenario],
        columns.variant ? row[*columns.variant] : "",
        columns.share_goals ? row[*columns.share_goals] : "", agents.value};
    if (columns.cost) {
      const auto cost = text::parse_natural(row[*columns.cost], INT64_MAX);
      if (cost.fault == text::NumberFault::none) reference.costs[key] = cost.value;
    }
    for (const std::size_t column : columns.seconds)
      reference.seconds[key].push_back(seconds(row[column]));
  }
  return reference;
}

}  // namespace quadrille::cli::campaign
