// SPDX-License-Identifier: MIT
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <system_error>
#include <thread>

#include "campaign/commands.hpp"
#include "campaign/run/child.hpp"
#include "frame/output.hpp"
#include "quadrille/text/text_input.hpp"

namespace quadrille::cli::campaign {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// For the shell.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

/// One call of `submit`: its number, and the ladders of each task.
struct Submission {
  std::int64_t number = 0;
  std::vector<std::vector<std::string>> tasks;
  fs::path folder;  ///< For its files.

  [[nodiscard]] fs::path file(const std::string& suffix) const {
    return folder / (std::to_string(number) + suffix);
  }
};

/// Takes the first number that is free, even if others do the same now.
std::optional<Error> reserve(Submission& submission) {
  std::error_code ignored;
  fs::create_directories(submission.folder, ignored);
  while (true) {
    ++submission.number;
    const fs::path path = submission.file(".json");
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file < 0 && errno == EEXIST) continue;
    if (file < 0)
      return Error{
          ErrorCode::io, std::string("cannot write: ") + std::strerror(errno), {path.string(), 0}};
    ::close(file);
    return std::nullopt;
  }
}

std::optional<Error> write_file(const fs::path& path, const std::string& text) {
  const auto file = OutputFile::probe(path);
  if (!file) return file.error();
  const int code = file->write(text);
  if (code == 0) return std::nullopt;
  return Error{
      ErrorCode::io, std::string("cannot write: ") + std::strerror(code), {path.string(), 0}};
}

std::string task_script(const CampaignArguments& arguments, const Submission& submission,
                        const std::string& action) {
  const auto absolute = [](const fs::path& path) { return quoted(fs::absolute(path).string()); };
  return fmt::format("#!/bin/sh\nexec {} campaign {} {} --folder {}", quoted(own_program()), action,
                     absolute(arguments.manifest), absolute(arguments.files().path)) +
         (action == "task" ? fmt::format(" --submission {} --task $(($1 + SLURM_ARRAY_TASK_ID))",
                                         submission.number)
                           : "") +
         "\n";
}

/// What both kinds of jobs are asked with.
std::vector<std::string> common_options(const JobList& list, const Submission& submission,
                                        const std::string& log) {
  std::vector<std::string> words = {"--parsable", "--job-name=quadrille-" + list.title,
                                    "--output=" + fs::absolute(submission.file(log)).string(),
                                    "--open-mode=append"};
  const SlurmOptions& slurm = list.slurm;
  if (!slurm.partition.empty()) words.push_back("--partition=" + slurm.partition);
  if (!slurm.account.empty()) words.push_back("--account=" + slurm.account);
  if (!slurm.qos.empty()) words.push_back("--qos=" + slurm.qos);
  if (!slurm.time.empty()) words.push_back("--time=" + slurm.time);
  words.insert(words.end(), slurm.options.begin(), slurm.options.end());
  return words;
}

/// The calls of sbatch for the arrays: `first` is the number of the first task of each.
std::vector<std::string> array_command(const JobList& list, const Submission& submission,
                                       std::size_t first) {
  const SlurmOptions& slurm = list.slurm;
  const std::size_t count =
      std::min(static_cast<std::size_t>(slurm.array_size), submission.tasks.size() - first);
  auto words = common_options(list, submission, "-%A_%a.log");
  const std::string parallel = slurm.parallel > 0 ? fmt::format("%{}", slurm.parallel) : "";
  words.push_back(fmt::format("--array=0-{}{}", count - 1, parallel));
  words.emplace_back("--requeue");
  // A minute before its time is over, the task is told to stop: what ran is run again later.
  words.emplace_back("--signal=B:TERM@60");
  // More than the ceiling at which a job is ended, so that its end has a row.
  if (list.limits.memory_mib)
    words.push_back(fmt::format("--mem={}M", *list.limits.memory_mib * 11 / 10 + 512));
  words.push_back(fs::absolute(submission.file(".sh")).string());
  words.push_back(std::to_string(first));
  return words;
}

std::vector<std::string> merge_command(const JobList& list, const Submission& submission,
                                       const std::vector<std::string>& arrays) {
  auto words = common_options(list, submission, "-merge.log");
  std::string after = "--dependency=afterany";
  for (const std::string& id : arrays) after += ":" + id;
  words.push_back(after);
  words.push_back(fs::absolute(submission.file("-merge.sh")).string());
  return words;
}

/// Runs sbatch; the number of the job that it has made.
Result<std::string> sbatch(const std::vector<std::string>& words) {
  auto child = Child::start("sbatch", words, {});
  if (!child) return child.error();
  std::optional<Ended> ended;
  while (!(ended = child->watch())) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  // "123" or "123;cluster"
  const std::string id = ended->out.substr(0, ended->out.find_first_of(";\n"));
  const bool number = !id.empty() && id.find_first_not_of("0123456789") == std::string::npos;
  if (ended->code != 0 || !number)
    return Error{
        ErrorCode::io,
        fmt::format("sbatch failed, exit code {}: {}{}", ended->code, ended->out, ended->err),
        {}};
  return id;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text = "sbatch";
  for (const std::string& word : words) text += " " + quoted(word);
  return text + "\n";
}

/// The ladders that have something left, in chunks.
Result<std::vector<std::vector<std::string>>> open_tasks(const JobList& list,
                                                         const Folder& folder) {
  auto store = Store::open(folder.results());
  if (!store) return store.error();
  Schedule schedule(list);
  if (auto error = Follower(list, *store, schedule).update()) return *error;
  std::vector<std::vector<std::string>> tasks;
  for (std::size_t i = 0; i < list.ladders.size(); ++i) {
    if (schedule.is_ladder_done(i)) continue;
    if (tasks.empty() || static_cast<std::int64_t>(tasks.back().size()) == list.slurm.chunk)
      tasks.emplace_back();
    tasks.back().push_back(list.ladders[i].name);
  }
  return tasks;
}

std::optional<Error> write_submission(const CampaignArguments& arguments,
                                      const Submission& submission) {
  const Json json = {{"quadrille", "submission"}, {"tasks", submission.tasks}};
  auto error = write_file(submission.file(".json"), json.dump() + "\n");
  if (!error)
    error = write_file(submission.file(".sh"), task_script(arguments, submission, "task"));
  if (!error)
    error = write_file(submission.file("-merge.sh"), task_script(arguments, submission, "merge"));
  return error;
}

/// All calls of sbatch, or what they would be.
std::optional<Error> hand_over(const CampaignArguments& arguments, const JobList& list,
                               const Submission& submission, Console& console) {
  std::vector<std::string> arrays;
  const auto step = static_cast<std::size_t>(list.slurm.array_size);
  const auto call = [&](const std::vector<std::string>& words) -> std::optional<Error> {
    if (arguments.dry_run) {
      console.print(joined(words));
      arrays.push_back("ARRAY" + std::to_string(arrays.size() + 1));
      return std::nullopt;
    }
    const auto id = sbatch(words);
    if (!id) return id.error();
    arrays.push_back(*id);
    return std::nullopt;
  };
  for (std::size_t first = 0; first < submission.tasks.size(); first += step)
    if (auto error = call(array_command(list, submission, first))) return error;
  const std::vector<std::string> ids = arrays;
  if (auto error = call(merge_command(list, submission, ids))) return error;
  if (arguments.dry_run) return std::nullopt;
  const Json json = {{"arrays", ids}, {"merge", arrays.back()}};
  console.print(fmt::format("submission {}: {} tasks in arrays {}, then the merge, {}\n",
                            submission.number, submission.tasks.size(), fmt::join(ids, ", "),
                            arrays.back()));
  return write_file(submission.file("-slurm.json"), json.dump() + "\n");
}

}  // namespace

Result<std::vector<std::size_t>> read_task(const Folder& folder, const JobList& list,
                                           std::int64_t submission, std::int64_t task) {
  const fs::path path = folder.slurm() / (std::to_string(submission) + ".json");
  std::ifstream in;
  if (auto error = text::open_input(path, in)) return *error;
  const auto text = text::read_all(in, path.string());
  if (!text) return text.error();
  std::map<std::string, std::size_t> numbers;
  for (std::size_t i = 0; i < list.ladders.size(); ++i) numbers.emplace(list.ladders[i].name, i);
  try {
    const Json tasks = Json::parse(*text).at("tasks");
    std::vector<std::size_t> ladders;
    for (const Json& name : tasks.at(static_cast<std::size_t>(task))) {
      // One that is not asked for any more has gone from the list.
      const auto found = numbers.find(name.get<std::string>());
      if (found != numbers.end()) ladders.push_back(found->second);
    }
    return ladders;
  } catch (const Json::exception& error) {
    return Error{ErrorCode::syntax,
                 fmt::format("no task {} in it: {}", task, error.what()),
                 {path.string(), 1}};
  }
}

ExitCode submit(const CampaignArguments& arguments) {
  const auto list = prepare(arguments);
  if (!list) return list.code;
  const auto tasks = open_tasks(*list, arguments.files());
  Console console(arguments.quiet, false);
  std::optional<Error> error;
  Submission submission{0, {}, arguments.files().slurm()};
  if (!tasks) error = tasks.error();
  if (tasks && tasks->empty()) {
    console.print("nothing is left to run\n");
    return ExitCode::success;
  }
  if (!error) {
    submission.tasks = *tasks;
    error = reserve(submission);
  }
  if (!error) error = write_submission(arguments, submission);
  if (!error) error = hand_over(arguments, *list, submission, console);
  if (!error) return ExitCode::success;
  report_error(*error);
  return ExitCode::output;
}

}  // namespace quadrille::cli::campaign
