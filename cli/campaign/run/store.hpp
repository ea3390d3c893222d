// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "quadrille/core/result.hpp"

namespace quadrille::cli::campaign {

/// The file with the rows of a campaign, one line each, which many processes on many machines write
/// together. A row is appended whole or not at all: under a lock, and what a killed writer or a
/// full disk left of one is cut off. Who runs a job claims it first. Claims and the lock are locks
/// on bytes of this file far behind its end (open file description locks, which NFS passes on to
/// its server): the system releases them when their owner dies, however it dies, and taking one
/// makes NFS look at the file afresh, so that who has claimed a job sees the row that another has
/// written.
class Store {
 public:
  /// Opens the file, and makes it if it is not there. Errors (io): also where the file system has
  /// no locks.
  [[nodiscard]] static Result<Store> open(const std::filesystem::path& path);
  Store(Store&& other) noexcept;
  Store& operator=(Store&&) = delete;
  ~Store();

  /// Calls `take` for each complete line that it has not read yet, without its end, and with its
  /// number.
  [[nodiscard]] std::optional<Error> read_new(
      const std::function<void(std::string_view, long)>& take);
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

  /// Whether the job, a name of 16 hexadecimal digits, is ours from now on.
  [[nodiscard]] bool try_claim(const std::string& job);
  void release(const std::string& job);
  /// Whether somebody else has claimed the job.
  [[nodiscard]] bool is_claimed_elsewhere(const std::string& job) const;

  /// Appends the line and its end, and waits until it has arrived. After an error the file is as it
  /// was before.
  [[nodiscard]] std::optional<Error> append(std::string_view line);

  /// Waits until no other merge is at work, and keeps others waiting as long as this store lives,
  /// so that the tables of the last one have all rows.
  [[nodiscard]] std::optional<Error> begin_merge();

 private:
  Store(std::filesystem::path path, int file) : path_(std::move(path)), file_(file) {}
  [[nodiscard]] Error error(const std::string& what, int code) const;
  [[nodiscard]] std::optional<Error> append_locked(std::string_view text);

  std::filesystem::path path_;
  int file_ = -1;
  std::int64_t read_ = 0;  // bytes, up to the end of a line
  long lines_ = 0;         // read
};

}  // namespace quadrille::cli::campaign
