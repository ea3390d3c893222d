// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "campaign/run/results.hpp"
#include "frame/exit_codes.hpp"

namespace quadrille::cli::campaign {

enum class Action { list, run, resume, reopen, task, submit, status, merge };

struct CampaignArguments {
  Action action = Action::list;
  std::string manifest;
  std::string folder;  ///< Empty: beside the manifest.
  std::string data;    ///< Empty: as the manifest says.
  std::optional<std::int64_t> processes;
  std::optional<std::int64_t> submission, task;  ///< Of a task on a cluster.
  bool dry_run = false;
  bool quiet = false;

  [[nodiscard]] Folder files() const;
};

/// The path of this program.
[[nodiscard]] std::string own_program();

/// Each does what `quadrille campaign ACTION` says, prints, and returns the exit code.
ExitCode list_jobs(const CampaignArguments& arguments);
ExitCode run_campaign(const CampaignArguments& arguments);
ExitCode reopen(const CampaignArguments& arguments);
ExitCode run_task(const CampaignArguments& arguments);
ExitCode submit(const CampaignArguments& arguments);
ExitCode show_status(const CampaignArguments& arguments);
ExitCode merge(const CampaignArguments& arguments);

/// What a submission to a cluster hands to each of its tasks: ladders by name. Errors: io, syntax.
[[nodiscard]] Result<std::vector<std::size_t>> read_task(const Folder& folder, const JobList& list,
                                                         std::int64_t submission,
                                                         std::int64_t task);
/// A list of jobs; or nothing, and the exit code for an error that has been reported.
struct Listed {
  std::optional<JobList> list;
  ExitCode code = ExitCode::bad_input;

  explicit operator bool() const { return list.has_value(); }
  const JobList* operator->() const { return &*list; }
  const JobList& operator*() const { return *list; }
};
/// Reads the manifest, expands it, and leaves the list of jobs in the folder.
[[nodiscard]] Listed prepare(const CampaignArguments& arguments);
/// The list that `prepare` has left.
[[nodiscard]] Listed prepared(const CampaignArguments& arguments);

/// Makes the folder and those above it, where they are missing. Reports an error, and is false
/// then.
[[nodiscard]] bool make_folder(const std::filesystem::path& folder);
/// Says on stderr that every job failed, and returns the exit code for that.
ExitCode report_all_failed();
/// Names the first lines that are damaged.
void report_damage(const Damage& damage);

}  // namespace quadrille::cli::campaign
