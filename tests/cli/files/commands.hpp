// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace quadrille::cli::test {

using Words = std::vector<std::string>;

Words operator+(Words a, const Words& b);

/// What a command left behind.
struct Ended {
  int code = -1;  ///< Exit code; -1 if a signal ended it.
  std::string out, err;
};

/// A folder of its own, which is the working directory as long as this lives, in which commands of
/// the program run: each in a process that begins as a copy of this one, so that nothing has to be
/// loaded. Remembers what ran, for the messages of failing tests.
class Workshop {
 public:
  Workshop();
  ~Workshop();
  Workshop(const Workshop&) = delete;
  Workshop& operator=(const Workshop&) = delete;

  /// A command that runs for more than `kCpuSeconds` is killed.
  Ended run(const Words& words);
  /// Standard output goes to this file, whose text is not in the answer.
  Ended run_into(const std::string& file, const Words& words);

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// What ran, one command per line, and how it ended.
  [[nodiscard]] const std::string& history() const { return history_; }

 private:
  static constexpr unsigned kCpuSeconds = 60;
  Ended run(const Words& words, const std::filesystem::path& out);

  std::filesystem::path folder_, before_;
  std::string history_;
};

[[nodiscard]] std::string read_file(const std::filesystem::path& path);
void write_file(const std::filesystem::path& path, const std::string& text);

}  // namespace quadrille::cli::test
