// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "campaign/jobs/job.hpp"
#include "campaign/run/row.hpp"

namespace quadrille::cli::campaign {

/// Replays the plans of rows with `verify`. Consecutive rows on one instance load it once.
class Replayer {
 public:
  Replayer();
  ~Replayer();
  Replayer(const Replayer&) = delete;
  Replayer& operator=(const Replayer&) = delete;

  /// What is wrong with the row's plan, or with what the row says of it; nullopt if it is fine, or
  /// if there is none. The row has to have been read with its plan.
  [[nodiscard]] std::optional<std::string> check(const Job& job, const Row& row);

 private:
  struct Loaded;
  std::optional<std::string> load(const Job& job);
  std::optional<std::string> check_grid(const Job& job, const Row& row) const;
  std::optional<std::string> check_roadmap(const Job& job, const Row& row) const;

  std::unique_ptr<Loaded> loaded_;
};

}  // namespace quadrille::cli::campaign
