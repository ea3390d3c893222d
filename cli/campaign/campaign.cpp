// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string_view>

#include "campaign/commands.hpp"
#include "frame/arguments.hpp"
#include "frame/subcommands.hpp"

namespace quadrille::cli {
namespace {

using campaign::Action;
using campaign::CampaignArguments;

constexpr std::int64_t kMaxProcesses = 1024;
constexpr std::int64_t kMaxNumber = 1'000'000'000;

constexpr const char* kFooter =
    "Example:\n"
    "  quadrille campaign run ladders.yaml --jobs 4\n"
    "  quadrille campaign merge ladders.yaml\n"
    "\n"
    "ACTION is one of\n"
    "  list    print the jobs: name, map, scenario, agents, system, seed\n"
    "  run     run the jobs that have no result yet, here\n"
    "  resume  the same with the jobs of the last run or submit, whose files must not have "
    "changed\n"
    "  reopen  make the jobs that failed open again; run, resume or submit does them\n"
    "  submit  hand them to Slurm, and the merge after them\n"
    "  task    what a task on the cluster does\n"
    "  status  what is done, what is left\n"
    "  merge   replay all plans, compare all answers, write tables and the report\n"
    "\n"
    "SIGINT and SIGTERM end the campaign; jobs that ran are run again by resume.\n"
    "\n";

std::optional<Action> parse_action(std::string_view text) {
  constexpr std::pair<std::string_view, Action> kActions[] = {
      {"list", Action::list},     {"run", Action::run},    {"resume", Action::resume},
      {"reopen", Action::reopen}, {"task", Action::task},  {"submit", Action::submit},
      {"status", Action::status}, {"merge", Action::merge}};
  for (const auto& [name, action] : kActions)
    if (name == text) return action;
  return std::nullopt;
}

ExitCode run(const CLI::App& app, const CampaignArguments& arguments) {
  const bool task = arguments.action == Action::task;
  if (task != arguments.submission.has_value() || task != arguments.task.has_value())
    return usage_error(app, "--submission and --task belong to task, which needs both");
  switch (arguments.action) {
    case Action::list:
      return campaign::list_jobs(arguments);
    case Action::run:
    case Action::resume:
      return campaign::run_campaign(arguments);
    case Action::reopen:
      return campaign::reopen(arguments);
    case Action::task:
      return campaign::run_task(arguments);
    case Action::submit:
      return campaign::submit(arguments);
    case Action::status:
      return campaign::show_status(arguments);
    case Action::merge:
      break;
  }
  return campaign::merge(arguments);
}

}  // namespace

Subcommand add_campaign(CLI::App& program) {
  CLI::App* app = program.add_subcommand("campaign", "Run many instances, here or on a cluster");
  const auto arguments = std::make_shared<CampaignArguments>();
  add_choice<Action>(*app, "ACTION", arguments->action,
                     "list, run, resume, reopen, submit, task, status or merge", parse_action,
                     "What to do; see below")
      ->required();
  add_file(*app, "MANIFEST", arguments->manifest, "What is asked: a YAML file")->required();
  add_file(*app, "--folder", arguments->folder,
           "Where the results are; default: MANIFEST with .campaign at its end")
      ->type_name("DIR");
  add_file(*app, "--data", arguments->data,
           "What file names in the manifest are relative to, instead of its own 'data'")
      ->type_name("DIR");
  add_integer(*app, "--jobs", arguments->processes, 1, kMaxProcesses,
              "run, resume: jobs at a time, 1 to 1024; default 1");
  app->add_flag("--dry-run", arguments->dry_run, "submit: print what would be handed to Slurm");
  add_integer(*app, "--submission", arguments->submission, 1, kMaxNumber,
              "task: number of the submission");
  add_integer(*app, "--task", arguments->task, 0, kMaxNumber, "task: number of the task in it");
  app->add_flag("--quiet", arguments->quiet, "Print nothing but errors");
  app->footer(std::string(kFooter) + kExitCodesHelp);
  return {app, [app, arguments] { return run(*app, *arguments); }};
}

}  // namespace quadrille::cli
