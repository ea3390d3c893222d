// SPDX-License-Identifier: MIT
#include "campaign/run/runner.hpp"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <thread>
#include <utility>

#include "quadrille/core/terminal_text.hpp"

namespace quadrille::cli::campaign {
namespace {

/// A job that somebody's signal ends so often is not tried again.
constexpr int kTries = 2;
/// A signal for all processes of a task may reach the jobs before it reaches us.
constexpr std::chrono::seconds kHold(1);
/// How long those who wait for others sleep.
constexpr std::chrono::milliseconds kPause(200);
/// Without a terminal.
constexpr std::chrono::seconds kReportInterval(60);

std::vector<std::string> command_of(const Job& job) {
  std::vector<std::string> words = {"solve"};
  words.insert(words.end(), job.instance.begin(), job.instance.end());
  words.insert(words.end(), job.options.begin(), job.options.end());
  words.insert(words.end(), {"--json", "-", "--quiet"});
  // Other programs, or older versions, need not know it.
  if (job.program.empty()) words.emplace_back("--history");
  return words;
}

std::string describe_row(const Job& job, const Row& row) {
  const std::string cost = row.cost.is_null() ? "" : " " + row.cost.dump();
  const std::string why = row.solved() ? "" : ", " + row.stop_reason;
  const std::string failure = row.status == "failed" ? ", " + terminal_line(row.explanation) : "";
  return fmt::format("{}: {}{}{}{}, {:.2f} s\n", describe(job), row.status, cost, why, failure,
                     row.process_cpu_s);
}

}  // namespace

Runner::Runner(const JobList& list, Schedule& schedule, Store& store, const RunOptions& options,
               Console& console)
    : list_(list),
      schedule_(schedule),
      store_(store),
      options_(options),
      console_(console),
      line_(!console.quiet()),
      follower_(list, store, schedule) {}

bool Runner::fail(const Error& error) {
  error_ = error;
  return false;
}

bool Runner::update() {
  auto error = follower_.update();
  return !error || fail(*error);
}

Runner::End Runner::run() {
  bool fine = update();
  while (fine && !interrupted()) {
    if (!held_.empty() && Clock::now() >= held_until_) fine = settle();
    if (fine && held_.empty()) fine = start_jobs();
    if (!fine) break;
    if (active_.empty() && held_.empty()) {
      if (elsewhere_.empty() || !options_.wait_for_others) break;
      std::this_thread::sleep_for(kPause);
      elsewhere_.clear();
      fine = update();
      continue;
    }
    wait_a_little();
    fine = tend();
    report(false);
  }
  stop_all();
  if (fine) report(true);
  line_.clear();
  if (error_) return End::failed;
  return schedule_.count().left == 0 ? End::complete : End::left;
}

bool Runner::start_jobs() {
  while (active_.size() < options_.processes && !interrupted()) {
    std::set<std::size_t> taken = busy_;
    taken.insert(elsewhere_.begin(), elsewhere_.end());
    const auto job = schedule_.next(taken);
    if (!job) return true;
    if (!store_.try_claim(list_.jobs[*job].name)) {
      elsewhere_.insert(*job);
      continue;
    }
    // Only now is it certain that nobody else writes its row, and that ours is the latest news.
    if (!update()) return false;
    if (!schedule_.is_open(*job)) {
      store_.release(list_.jobs[*job].name);
      continue;
    }
    if (!start(*job)) return false;
  }
  return true;
}

bool Runner::start(std::size_t number) {
  const Job& job = list_.jobs[number];
  auto child = Child::start(job.program.empty() ? options_.program : job.program, command_of(job),
                            list_.limits);
  if (!child) return fail(child.error());
  busy_.insert(number);
  active_.push_back({number, *std::move(child)});
  return true;
}

void Runner::wait_a_little() const {
  std::vector<pollfd> files;
  int patience_ms = 100;
  for (const Active& active : active_) {
    for (const int file : {active.child.out_file(), active.child.err_file()})
      files.push_back({file, POLLIN, 0});
    // It is about to end.
    if (active.child.out_file() < 0 && active.child.err_file() < 0) patience_ms = 2;
  }
  ::poll(files.data(), files.size(), patience_ms);
}

bool Runner::tend() {
  for (std::size_t i = 0; i < active_.size();) {
    auto ended = active_[i].child.watch();
    if (!ended) {
      ++i;
      continue;
    }
    const std::size_t job = active_[i].job;
    active_.erase(active_.begin() + static_cast<std::ptrdiff_t>(i));
    const auto row = make_row(list_.jobs[job], *ended);
    if (!row) {
      hold(job, *std::move(ended));
      continue;
    }
    if (!finish(job, *row)) return false;
  }
  return true;
}

void Runner::hold(std::size_t job, Ended ended) {
  held_.push_back({job, std::move(ended)});
  held_until_ = Clock::now() + kHold;
}

bool Runner::settle() {
  for (const Held& held : std::exchange(held_, {}))
    if (!settle(held.job, held.ended)) return false;
  return true;
}

bool Runner::settle(std::size_t number, const Ended& ended) {
  if (++kills_[number] < kTries) {
    let_go(number);
    return true;
  }
  return finish(number,
                failed_row(list_.jobs[number], ended,
                           ended.signal != 0
                               ? fmt::format("ended by signal {} {} times", ended.signal, kTries)
                               : fmt::format("interrupted by somebody {} times", kTries)));
}

bool Runner::finish(std::size_t number, const Row& row) {
  bool fine = true;
  if (auto error = store_.append(to_line(row))) {
    fine = fail(*error);
  } else {
    line_.clear();
    console_.print(describe_row(list_.jobs[number], row));
    fine = update();
  }
  let_go(number);
  return fine;
}

void Runner::let_go(std::size_t job) {
  busy_.erase(job);
  store_.release(list_.jobs[job].name);
  // What others have finished may have opened something.
  elsewhere_.clear();
}

void Runner::stop_all() {
  for (Active& active : active_) active.child.stop();
  while (!active_.empty()) {
    wait_a_little();
    if (error_) {  // Rows cannot be written any more.
      std::erase_if(active_, [](Active& active) { return active.child.watch().has_value(); });
    } else {
      tend();
    }
  }
  // It was us: they are open again, and it was no try.
  for (const Held& held : std::exchange(held_, {})) let_go(held.job);
}

void Runner::report(bool now) {
  const auto time = Clock::now();
  const bool due = line_.active() ? time - reported_ > kPause : time - reported_ > kReportInterval;
  if (!now && !due) return;
  reported_ = time;
  const Schedule::Counts counts = schedule_.count();
  std::string text = fmt::format("{} of at most {} jobs: {} solved, {} not, {} not needed",
                                 counts.solved + counts.unsolved, counts.jobs, counts.solved,
                                 counts.unsolved, counts.not_needed);
  const auto rest = estimate_s(schedule_, follower_.times(), list_.limits, options_.processes);
  if (counts.left > 0)
    text += fmt::format(", {} left{}", counts.left,
                        rest ? "; about " + duration_text(*rest) + " to go" : "");
  if (now && follower_.damage().lines() > 0)
    text += fmt::format("; {} damaged lines in the results", follower_.damage().lines());
  if (now || !line_.active())
    console_.print(text + "\n");
  else
    line_.show(text);
}

}  // namespace quadrille::cli::campaign
