// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "campaign/answers/merged.hpp"
#include "campaign/answers/replay.hpp"
#include "campaign/commands.hpp"
#include "frame/output.hpp"
#include "quadrille/core/terminal_text.hpp"

namespace quadrille::cli::campaign {
namespace {

/// The motions of the tracker: without the starts.
std::string motions_of(const Row& row) {
  std::vector<std::string> lines;
  for (const auto& path : row.plan) {
    const std::string one = path.get<std::string>();
    lines.push_back(one.substr(one.find(' ') + 1));
  }
  return fmt::format("{}", fmt::join(lines, "\n"));
}

/// Reads all rows, replaying plans as they come.
class Collector {
 public:
  Collector(Merged& merged, Store& store) : merged_(merged), store_(store) {
    for (std::size_t i = 0; i < merged.list.jobs.size(); ++i)
      numbers_.emplace(merged.list.jobs[i].name, i);
    merged.rows.resize(merged.list.jobs.size());
  }

  std::optional<Error> run() {
    auto error = store_.read_new([&](std::string_view line, long number) { take(line, number); });
    if (error) return error;
    Schedule schedule(merged_.list);
    for (std::size_t job = 0; job < merged_.rows.size(); ++job)
      if (merged_.rows[job]) schedule.finish(job, merged_.rows[job]->solved());
    const Schedule::Counts counts = schedule.count();
    merged_.missing = counts.left;
    return std::nullopt;
  }
  [[nodiscard]] std::vector<std::string>& wrong() { return wrong_; }
  [[nodiscard]] std::size_t replayed() const { return replayed_; }

 private:
  void take(std::string_view line, long line_number) {
    auto row = read_row(line);
    if (!row) {
      merged_.damage.note(store_, line_number, row.error());
      return;
    }
    const auto found = numbers_.find(row->job);
    if (found == numbers_.end()) {
      ++merged_.foreign;
      return;
    }
    const std::size_t number = found->second;
    const Job& job = merged_.list.jobs[number];
    if (row->opens()) {
      if (merged_.rows[number] && merged_.rows[number]->status == "failed")
        merged_.rows[number].reset();
      return;
    }
    if (merged_.rows[number]) {
      wrong_.push_back(describe(job) + " has two rows");
      return;
    }
    if (auto wrong = replayer_.check(job, *row)) wrong_.push_back(describe(job) + ": " + *wrong);
    if (!row->plan.is_null()) ++replayed_;
    if (row->plan.is_array()) keep_motions(number, *row);
    row->plan = nullptr;
    merged_.rows[number] = *std::move(row);
  }

  /// Of the best plan of each instance only: they are large.
  void keep_motions(std::size_t number, const Row& row) {
    const Job& job = merged_.list.jobs[number];
    if (job.objective != Objective::sum_of_costs || !row.exact_cost) return;
    const auto [best, is_new] = best_.try_emplace(job.instance_id, *row.exact_cost, number);
    if (!is_new) {
      const std::pair<std::int64_t, std::size_t> own(*row.exact_cost, number);
      if (own >= best->second) return;
      merged_.motions.erase(best->second.second);
      best->second = own;
    }
    merged_.motions.emplace(number, motions_of(row));
  }

  Merged& merged_;
  Store& store_;
  Replayer replayer_;
  std::map<std::string, std::size_t> numbers_;
  std::map<std::string, std::pair<std::int64_t, std::size_t>> best_;
  std::vector<std::string> wrong_;
  std::size_t replayed_ = 0;
};

bool write_outputs(const Folder& folder, const Merged& merged) {
  if (!make_folder(folder.merged())) return false;
  const std::pair<const char*, std::string> outputs[] = {{"table.csv", csv_table(merged)},
                                                         {"table.jsonl", jsonl_table(merged)},
                                                         {"tracker.csv", tracker_table(merged)},
                                                         {"report.html", html_report(merged)}};
  return std::all_of(std::begin(outputs), std::end(outputs), [&](const auto& output) {
    const auto file = OutputFile::probe(folder.merged() / output.first);
    if (!file) report_error(file.error());
    return file && write_or_report(*file, output.second);
  });
}

bool all_failed(const Merged& merged) {
  const auto failed = [](const auto& row) { return !row || row->status == "failed"; };
  return std::any_of(merged.rows.begin(), merged.rows.end(),
                     [](const auto& row) { return row.has_value(); }) &&
         std::all_of(merged.rows.begin(), merged.rows.end(), failed);
}

std::string summary(const Merged& merged, std::size_t replayed, const Folder& folder) {
  std::size_t rows = 0, solved = 0;
  for (const auto& row : merged.rows) {
    if (!row) continue;
    ++rows;
    if (row->solved()) ++solved;
  }
  std::string text = fmt::format(
      "{}: {} rows, {} solved; {} plans replayed, no contradictions\ntables and report in {}\n",
      terminal_line(merged.list.title), rows, solved, replayed,
      terminal_line(folder.merged().string()));
  if (merged.missing > 0)
    text += fmt::format("at most {} jobs are yet to be run\n", merged.missing);
  if (merged.damage.lines() > 0)
    text += fmt::format("{} damaged lines, but every job has a row\n", merged.damage.lines());
  if (merged.foreign > 0)
    text += fmt::format("{} rows of jobs that are not asked for any more\n", merged.foreign);
  return text;
}

}  // namespace

ExitCode merge(const CampaignArguments& arguments) {
  auto list = prepared(arguments);
  if (!list) return list.code;
  Merged merged;
  merged.list = *std::move(list.list);
  const Folder folder = arguments.files();
  auto store = Store::open(folder.results());
  if (const auto error = store ? store->begin_merge() : store.error()) {
    report_error(*error);
    return ExitCode::output;
  }
  auto error = find_change(merged.list, "");
  if (!error && !merged.list.reference.empty()) {
    auto reference = read_reference(merged.list.reference);
    if (reference)
      merged.reference = *std::move(reference);
    else
      error = reference.error();
  }
  Collector collector(merged, *store);
  if (!error) error = collector.run();
  report_damage(merged.damage);
  if (error) report_error(*error);
  // What a damaged line said is not passed over in silence.
  if (error || (merged.damage.lines() > 0 && merged.missing > 0)) return ExitCode::bad_input;
  std::vector<std::string> wrong = std::move(collector.wrong());
  for (std::string& sentence : contradictions(merged)) wrong.push_back(std::move(sentence));
  for (const std::string& sentence : wrong)
    report_error({ErrorCode::internal, "contradiction: " + sentence, {}});
  if (!wrong.empty()) return ExitCode::violations;
  if (!write_outputs(folder, merged)) return ExitCode::output;
  Console console(arguments.quiet, false);
  console.print(summary(merged, collector.replayed(), folder));
  if (merged.missing > 0) return ExitCode::unknown;
  return all_failed(merged) ? report_all_failed() : ExitCode::success;
}

}  // namespace quadrille::cli::campaign
