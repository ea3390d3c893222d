// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "campaign/answers/chart.hpp"
#include "campaign/answers/figures.hpp"
#include "campaign/answers/merged.hpp"

namespace quadrille::cli::campaign {
namespace {

constexpr const char* kStyle =
    "body{font:15px/1.45 sans-serif;max-width:1100px;margin:2em auto;padding:0 1em;color:#222;"
    "background:#fff}\n"
    "h1{overflow-wrap:anywhere}\n"
    "table{border-collapse:collapse;margin:1em 0;max-width:100%}td,th{padding:.2em "
    ".7em;border-bottom:1px solid #ddd;text-align:right;vertical-align:top}"
    ".name{text-align:left;overflow-wrap:anywhere}\n"
    "svg{font:11px sans-serif;margin:.4em;max-width:100%}svg .title{font-weight:bold}svg "
    ".grid{stroke:#8884}\n"
    "@media(prefers-color-scheme:dark){body{background:#181818;color:#ddd}svg "
    "text{fill:#ddd}td,th{border-color:#444}}\n";

using Cells = std::vector<std::string>;

/// The first `names` cells are names, which may be broken anywhere.
std::string table_row(const Cells& cells, const char* tag, std::size_t names) {
  std::string text = "<tr>";
  for (std::size_t i = 0; i < cells.size(); ++i)
    text += fmt::format("<{0}{1}>{2}</{0}>", tag, i < names ? " class=\"name\"" : "",
                        escaped(cells[i]));
  return text + "</tr>\n";
}

std::string table(const Cells& head, const std::vector<Cells>& rows, std::size_t names) {
  std::string text = "<table>\n<thead>" + table_row(head, "th", names) + "</thead>\n<tbody>\n";
  for (const Cells& row : rows) text += table_row(row, "td", names);
  return text + "</tbody></table>\n";
}

std::string par2_text(const Merged& merged, const std::vector<std::size_t>& jobs) {
  return jobs.empty() ? "-" : fmt::format("{:.2f}", par2(merged, jobs));
}

std::string systems_table(const Merged& merged, const std::vector<Series>& series) {
  const auto common = common_jobs(merged, series);
  std::vector<Cells> rows;
  for (std::size_t i = 0; i < series.size(); ++i) {
    const Series& one = series[i];
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
                    par2_text(merged, common[i]),
                    gaps.empty() ? "-" : fmt::format("{:.2f} %", gaps[gaps.size() / 2])});
  }
  std::string text = table({"system", "runs", "optimal", "infeasible", "with a plan", "without",
                            "failed", "PAR-2 (s)", "median gap of plans not proved"},
                           rows, 1);
  const std::size_t runs = common.empty() ? 0 : common.front().size();
  return text + fmt::format(
                    "<p>PAR-2: mean CPU seconds, a run that is not solved counted as twice the "
                    "limit, over the {} {} (an instance and a seed) that every system did. Runs "
                    "that a ladder of some system did not come to do not count.</p>\n",
                    runs, runs == 1 ? "run" : "runs");
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
    if (family_name(key.family, key.variant, key.share_goals) == family && seconds[solver] &&
        (!best || key.agents > best->first))
      best = {key.agents, *seconds[solver]};
  return best ? fmt::format("{} ({:.2f} s)", best->first, best->second) : "-";
}

/// A row for each map and system: as many systems as there may be, the table is no wider.
std::string maps_table(const Merged& merged, const std::vector<Series>& series) {
  const auto common = common_jobs(merged, series);
  std::map<std::string, std::vector<Cells>> by_map;
  for (std::size_t i = 0; i < series.size(); ++i) {
    auto compared = by_family(merged, common[i]);
    for (const auto& [name, jobs] : by_family(merged, series[i].jobs)) {
      const auto solved = std::count_if(jobs.begin(), jobs.end(),
                                        [&](std::size_t job) { return is_solved(merged, job); });
      by_map[name].push_back({"", series[i].name, std::to_string(solved),
                              std::to_string(jobs.size()), largest(merged, jobs),
                              par2_text(merged, compared[name]),
                              std::to_string(compared[name].size())});
    }
  }
  std::vector<Cells> rows;
  for (auto& [name, cells] : by_map) {
    cells.front().front() = name;
    rows.insert(rows.end(), cells.begin(), cells.end());
    for (std::size_t solver = 0; solver < merged.reference.solvers.size(); ++solver)
      rows.push_back({"", merged.reference.solvers[solver] + " (reference)", "", "",
                      largest(merged.reference, name, solver), "", ""});
  }
  return table({"map", "system", "solved", "of runs", "most agents", "PAR-2 (s)", "over runs"},
               rows, 2);
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
  text += "<h2>Solved within a time</h2>\n" + cactus_plot(merged, series);
  text += "<h2>Maps</h2>\n" + maps_table(merged, series);
  text += "<h2>Ladders</h2>\n<div>" + ladder_plots(merged, series) + "</div>\n";
  const std::string gaps = gap_plots(merged, series);
  if (!gaps.empty()) text += "<h2>Gap over time</h2>\n<div>" + gaps + "</div>\n";
  return text + "</body></html>\n";
}

}  // namespace quadrille::cli::campaign
