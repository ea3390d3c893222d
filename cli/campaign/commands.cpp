// SPDX-License-Identifier: MIT
#include "campaign/commands.hpp"

#include <fmt/format.h>

#include <array>
#include <csignal>
#include <map>
#include <set>
#include <system_error>
#include <vector>

#include "campaign/run/runner.hpp"
#include "frame/output.hpp"
#include "frame/signals.hpp"
#include "quadrille/core/terminal_text.hpp"

namespace quadrille::cli::campaign {
namespace {

namespace fs = std::filesystem;

ExitCode exit_code(const Runner& runner, Runner::End end) {
  report_damage(runner.follower().damage());
  switch (end) {
    case Runner::End::complete:
      break;
    case Runner::End::left:
      return ExitCode::unknown;
    case Runner::End::failed:
      report_error(*runner.error());
      return ExitCode::output;
  }
  if (!runner.follower().all_failed()) return ExitCode::success;
  return report_all_failed();
}

ExitCode run_ladders(const CampaignArguments& arguments, const JobList& list, Schedule schedule,
                     bool wait_for_others) {
  // A file that may not grow is an error like a full disk, not the end of the program.
  std::signal(SIGXFSZ, SIG_IGN);
  RunOptions options;
  options.processes = static_cast<std::size_t>(arguments.processes.value_or(1));
  options.wait_for_others = wait_for_others;
  options.program = own_program();
  options.interrupt = &catch_interrupts();
  auto store = Store::open(arguments.files().results());
  if (!store) {
    report_error(store.error());
    return ExitCode::output;
  }
  // Who reads our output may go away; the work goes on.
  Console console(arguments.quiet, false);
  Runner runner(list, schedule, *store, options, console);
  const Runner::End end = runner.run();
  const bool resume = end == Runner::End::left && *options.interrupt;
  if (resume)
    console.print(fmt::format("interrupted; 'quadrille campaign resume {}' goes on\n",
                              terminal_line(arguments.manifest)));
  return exit_code(runner, end);
}

}  // namespace

ExitCode report_all_failed() {
  print_stderr("quadrille: every job failed; the rows say why\n");
  return ExitCode::violations;
}

void report_damage(const Damage& damage) {
  for (const Error& error : damage.errors()) report_error(error);
  if (damage.lines() > damage.errors().size())
    print_stderr(fmt::format("quadrille: and {} more damaged lines\n",
                             damage.lines() - damage.errors().size()));
}

bool make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error) return true;
  report_error(
      {ErrorCode::io, "the folder cannot be made: " + error.message(), {folder.string(), 0}});
  return false;
}

Folder CampaignArguments::files() const {
  if (!folder.empty()) return {folder};
  fs::path path(manifest);
  return {path.replace_extension(".campaign")};
}

std::string own_program() {
  std::error_code error;
  const fs::path path = fs::read_symlink("/proc/self/exe", error);
  return error ? "quadrille" : path.string();
}

Listed prepare(const CampaignArguments& arguments) {
  const auto manifest = read_manifest(arguments.manifest, arguments.data);
  auto list = manifest ? expand(*manifest) : Result<JobList>(manifest.error());
  if (!list) {
    report_error(list.error());
    return {};
  }
  if (arguments.action == Action::list) return {*std::move(list)};
  const Folder folder = arguments.files();
  if (!make_folder(folder.path)) return {{}, ExitCode::output};
  const auto file = OutputFile::probe(folder.jobs());
  if (!file) report_error(file.error());
  if (!file || !write_or_report(*file, to_json(*list))) return {{}, ExitCode::output};
  return {*std::move(list)};
}

Listed prepared(const CampaignArguments& arguments) {
  auto list = read_job_list(arguments.files().jobs());
  if (list) return {*std::move(list)};
  report_error(list.error());
  return {};
}

ExitCode list_jobs(const CampaignArguments& arguments) {
  const auto list = prepare(arguments);
  if (!list) return list.code;
  Console console(arguments.quiet, false);
  std::string text;
  for (const Job& job : list->jobs)
    text +=
        fmt::format("{}\t{}\t{}\t{}\t{}\t{}\n", job.name, terminal_line(family_name(job)),
                    terminal_line(job.scenario), job.agents, terminal_line(job.system), job.seed);
  console.print(text);
  return console.failure() == 0 ? ExitCode::success : ExitCode::output;
}

ExitCode run_campaign(const CampaignArguments& arguments) {
  const bool resume = arguments.action == Action::resume;
  const auto list = resume ? prepared(arguments) : prepare(arguments);
  if (!list) return list.code;
  if (const auto change = resume ? find_change(*list, arguments.manifest) : std::nullopt) {
    report_error(*change);
    return ExitCode::bad_input;
  }
  return run_ladders(arguments, *list, Schedule(*list), true);
}

ExitCode run_task(const CampaignArguments& arguments) {
  const auto list = prepared(arguments);
  if (!list) return list.code;
  const auto ladders = read_task(arguments.files(), *list, *arguments.submission, *arguments.task);
  auto error = ladders ? std::nullopt : std::optional<Error>(ladders.error());
  std::vector<std::size_t> jobs;
  if (ladders)
    for (const std::size_t ladder : *ladders)
      for (const auto& rung : list->ladders[ladder].rungs)
        jobs.insert(jobs.end(), rung.begin(), rung.end());
  if (!error) error = find_change(*list, "", jobs);
  if (error) {
    report_error(*error);
    return ExitCode::bad_input;
  }
  return run_ladders(arguments, *list, Schedule(*list, *ladders), false);
}

ExitCode reopen(const CampaignArguments& arguments) {
  const auto list = prepared(arguments);
  if (!list) return list.code;
  auto store = Store::open(arguments.files().results());
  auto error = store ? std::nullopt : std::optional<Error>(store.error());
  std::size_t opened = 0;
  if (store) {
    Schedule schedule(*list);
    Follower follower(*list, *store, schedule);
    std::set<std::size_t> failed;
    const auto update = [&] {
      return follower.update([&](std::size_t job, const Row& row) {
        if (row.status == "failed")
          failed.insert(job);
        else
          failed.erase(job);
      });
    };
    error = update();
    // Another one may be at it, too: who has the claim looks once more.
    for (const std::size_t job : std::set<std::size_t>(failed)) {
      if (error || !store->try_claim(list->jobs[job].name)) continue;
      if (error = update(); !error && failed.contains(job)) {
        error = store->append(to_line(open_row(list->jobs[job])));
        if (!error) ++opened;
      }
      store->release(list->jobs[job].name);
    }
  }
  if (error) {
    report_error(*error);
    return ExitCode::output;
  }
  Console(arguments.quiet, false)
      .print(fmt::format("{} {} open again\n", opened, opened == 1 ? "job is" : "jobs are"));
  return ExitCode::success;
}

ExitCode show_status(const CampaignArguments& arguments) {
  const auto list = prepared(arguments);
  if (!list) return list.code;
  auto store = Store::open(arguments.files().results());
  if (!store) {
    report_error(store.error());
    return ExitCode::output;
  }
  Schedule schedule(*list);
  Follower follower(*list, *store, schedule);
  enum Verdict { none, solved, not_solved, failed };
  std::vector<Verdict> verdicts(list->jobs.size(), none);
  const auto error = follower.update([&](std::size_t job, const Row& row) {
    verdicts[job] = row.opens()              ? none
                    : row.solved()           ? solved
                    : row.status == "failed" ? failed
                                             : not_solved;
  });
  if (error) {
    report_error(*error);
    return ExitCode::bad_input;
  }
  std::size_t running = 0;
  for (std::size_t job = 0; job < list->jobs.size(); ++job)
    if (schedule.is_open(job) && store->is_claimed_elsewhere(list->jobs[job].name)) ++running;
  const Schedule::Counts counts = schedule.count();
  std::string text = fmt::format(
      "{}: {} jobs in {} ladders\nsolved     {}\nnot solved {}\nnot needed {}\nleft       at most "
      "{}, in {} ladders\nrunning    {}\n",
      terminal_line(list->title), counts.jobs, list->ladders.size(), counts.solved, counts.unsolved,
      counts.not_needed, counts.left, counts.open_ladders, running);
  const auto rest =
      estimate_s(schedule, follower.times(), list->limits, std::max<std::size_t>(1, running));
  if (counts.left > 0 && rest)
    text += fmt::format("time left  about {} with {} at a time\n", duration_text(*rest),
                        std::max<std::size_t>(1, running));
  std::map<std::string, std::array<std::size_t, 4>> systems;  // by verdict
  for (std::size_t job = 0; job < verdicts.size(); ++job)
    if (verdicts[job] != none) ++systems[list->jobs[job].system][verdicts[job]];
  for (const auto& [name, sum] : systems)
    text += fmt::format("system     {}: {} solved, {} not, {} failed\n", terminal_line(name),
                        sum[solved], sum[not_solved], sum[failed]);
  report_damage(follower.damage());
  if (follower.damage().lines() > 0)
    text += fmt::format("damaged    {} lines of the results; their jobs are run again\n",
                        follower.damage().lines());
  if (follower.foreign() > 0)
    text += fmt::format("others     {} rows of jobs that are not asked for any more\n",
                        follower.foreign());
  Console console(arguments.quiet, false);
  console.print(text);
  if (counts.left > 0) return ExitCode::unknown;
  return follower.all_failed() ? report_all_failed() : ExitCode::success;
}

}  // namespace quadrille::cli::campaign
