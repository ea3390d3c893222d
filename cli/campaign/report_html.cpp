// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "campaign/chart.hpp"
#include "campaign/figures.hpp"
#include "campaign/merged.hpp"

namespace quadrille::cli::campaign {
namespace {

constexpr const char* kStyle =
    "body{font:15px/1.45 sans-serif;max-width:1100px;margin:2em auto;padding:0 1em;color:#222;"
    "background:#fff}\n"
    "table{border-collapse:collapse;margin:1em 0}td,th{padding:.2em .7em;border-bottom:1px solid "
    "#ddd;text-align:right}td:first-child,th:first-child{text-align:left}\n"
    "svg{font:11px sans-serif;margin:.4em}svg .title{font-weight:bold}svg .grid{stroke:#8884}\n"
    "@media(prefers-color-scheme:dark){body{background:#181818;color:#ddd}svg "
    "text{fill:#ddd}td,th{border-color:#444}}\n";

using Cells = std::vector<std::string>;

std::string table_row(const Cells& cells, const char* tag) {
  std::string text = "<tr>";
  for (const std::string& cell : cells) text += fmt::format("<{0}>{1}</{0}>", tag, escaped(cell));
  return text + "</tr>\n";
}

std::string table(const Cells& head, const std::vector<Cells>& rows) {
  std::string text = "<table>\n<thead>" + table_row(head, "th") + "</thead>\n<tbody>\n";
  for (const Cells& row : rows) text += table_row(row, "td");
  return text + "</tbody></table>\n";
}

std::string systems_table(const Merged& merged, const std::vector<Series>& series) {
  std::vector<Cells> rows;
  for (const Series& one : series) {
    std::map<std::string, std::size_t> sums;
    std::vector<double> gaps;
    for (const std::size_t job : one.jobs) {
      const Row& row = *merged.rows[job];
      ++sums[row.status];
      if (row.status == "feasible" && row.exact_cost && row.exact_bound && *row.exact_bound > 0)
        gaps.push_back(gap_percent(*row.exact_cost, *row.exact_bound));
    }
    std::sort(gaps.begin(), gaps.end());
    rows.push_back({one.name, std::to_string(one.jobs.size()), std::to_string(sums["optimal"]),
                    std::to_string(sums["infeasible"]), std::to_string(sums["feasible"]),
                    std::to_string(sums["unknown"]), std::to_string(sums["failed"]),
                    fmt::format("{:.2f}", par2(merged, one.jobs)),
                    gaps.empty() ? "-" : fmt::format("{:.2f} %", gaps[gaps.size() / 2])});
  }
  return table({"system", "runs", "optimal", "infeasible", "with a plan", "without", "failed",
                "PAR-2 (s)", "median gap of plans not proved"},
               rows);
}

/// The largest number of agents that was solved, and its time.
std::string largest(const Merged& merged, const std::vector<std::size_t>& jobs) {
  std::optional<std::pair<std::int64_t, double>> best;
  for (const std::size_t job : jobs) {
    if (!is_solved(merged, job)) continue;
    const std::pair<std::int64_t, double> own(merged.list.jobs[job].agents,
                                              merged.rows[job]->process_cpu_s);
    if (!best || own.first > best->first) best = own;
  }
  return best ? fmt::format("{} ({:.2f} s)", best->first, best->second) : "-";
}

/// Of another solver.
std::string largest(const Reference& reference, const std::string& family, std::size_t solver) {
  std::optional<std::pair<std::int64_t, double>> best;
  for (const auto& [key, seconds] : reference.seconds)
    if (std::get<0>(key) == family && seconds[solver] && (!best || std::get<2>(key) > best->first))
      best = {std::get<2>(key), *seconds[solver]};
  return best ? fmt::format("{} ({:.2f} s)", best->first, best->second) : "-";
}

std::string maps_table(const Merged& merged, const std::vector<Series>& series) {
  Cells head = {"map"};
  std::set<std::string> names;
  std::vector<std::map<std::string, std::vector<std::size_t>>> families;
  for (const Series& one : series) {
    families.push_back(by_family(merged, one.jobs));
    for (const auto& [name, jobs] : families.back()) names.insert(name);
    head.insert(head.end(), {one.name + ": solved", "of runs", "most agents", "PAR-2 (s)"});
  }
  for (const std::string& solver : merged.reference.solvers)
    head.push_back(solver + ": most agents");
  std::vector<Cells> rows;
  for (const std::string& name : names) {
    Cells row = {name};
    for (const auto& family : families) {
      const auto found = family.find(name);
      const std::vector<std::size_t> jobs =
          found == family.end() ? std::vector<std::size_t>() : found->second;
      const auto solved = std::count_if(jobs.begin(), jobs.end(),
                                        [&](std::size_t job) { return is_solved(merged, job); });
      row.insert(row.end(), {std::to_string(solved), std::to_string(jobs.size()),
                             largest(merged, jobs), fmt::format("{:.2f}", par2(merged, jobs))});
    }
    for (std::size_t solver = 0; solver < merged.reference.solvers.size(); ++solver)
      row.push_back(largest(merged.reference, name, solver));
    rows.push_back(std::move(row));
  }
  return table(head, rows);
}

std::string limits_text(const JobLimits& limits) {
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (limits.cpu_s) add(fmt::format("{} s of CPU time", *limits.cpu_s));
  if (limits.wall_s) add(fmt::format("{} s of time", *limits.wall_s));
  if (limits.memory_mib) add(fmt::format("{} MiB", *limits.memory_mib));
  if (limits.conflicts) add(fmt::format("{} conflicts", *limits.conflicts));
  return text.empty() ? "no limits" : "limits of each run: " + text;
}

std::string head(const Merged& merged) {
  std::set<std::string> versions, instances;
  std::size_t rows = 0, closed = 0;
  for (std::size_t job = 0; job < merged.rows.size(); ++job) {
    if (!merged.rows[job]) continue;
    ++rows;
    if (!merged.rows[job]->version.empty()) versions.insert(merged.rows[job]->version);
    if (is_solved(merged, job) && instances.insert(merged.list.jobs[job].instance_id).second)
      ++closed;
  }
  std::string text = fmt::format("<p>{} runs, {} instances closed; {}", rows, closed,
                                 limits_text(merged.list.limits));
  if (!versions.empty()) text += fmt::format("; version {}", fmt::join(versions, ", "));
  text += ". Every plan was replayed, all costs and bounds fit each other";
  if (!merged.reference.costs.empty()) text += " and those of the reference";
  text += ".</p>\n";
  if (merged.missing > 0)
    text +=
        fmt::format("<p><b>Not complete: at most {} runs are missing.</b></p>\n", merged.missing);
  return text;
}

}  // namespace

std::string html_report(const Merged& merged) {
  const std::vector<Series> series = series_of(merged);
  const std::string title = escaped(merged.list.title);
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<title>{0}</title>\n"
      "<style>\n{1}</style></head>\n<body>\n<h1>{0}</h1>\n",
      title, kStyle);
  text += head(merged);
  text += "<h2>Systems</h2>\n" + systems_table(merged, series);
  text +=
      "<p>PAR-2: mean CPU seconds, a run that is not solved counted as twice the limit. Runs that "
      "a "
      "ladder did not come to do not count.</p>\n";
  text += "<h2>Solved within a time</h2>\n" + cactus_plot(merged, series);
  text += "<h2>Maps</h2>\n" + maps_table(merged, series);
  text += "<h2>Ladders</h2>\n<div>" + ladder_plots(merged, series) + "</div>\n";
  const std::string gaps = gap_plots(merged, series);
  if (!gaps.empty()) text += "<h2>Gap over time</h2>\n<div>" + gaps + "</div>\n";
  return text + "</body></html>\n";
}

}  // namespace quadrille::cli::campaign
