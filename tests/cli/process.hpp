// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>
#include <sys/types.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace quadrille::cli::test {

/// What a run of the program left behind.
struct Finished {
  int code = -1;    ///< Exit code; -1 if a signal ended the program.
  int signal = 0;   ///< The signal that ended it, or 0.
  std::string out;  ///< What it wrote to stdout, unless that was redirected.
  std::string err;
};

/// A running program. Both streams go to files in `folder`, so that nothing blocks.
class Process {
 public:
  /// `stdout_file`: where stdout goes instead, such as /dev/full; "closed" closes it.
  Process(const std::filesystem::path& folder, const std::vector<std::string>& arguments,
          const std::string& stdout_file = "");
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  void signal(int number) const;
  /// Waits until the program catches the signal: before, it is not loaded yet and simply dies.
  void wait_until_caught(int number) const;
  /// Waits until the signal was taken notice of.
  void wait_until_received(int number) const;
  /// Waits for the end, but no longer than `seconds` of the program's CPU time (what the clock says
  /// depends on what else the machine does), or half a minute: then kills it and fails the test.
  Finished wait(double seconds);

 private:
  std::filesystem::path out_, err_;
  /// Whether /proc says so of the signal.
  [[nodiscard]] bool has_signal(const std::string& set, int number) const;
  [[nodiscard]] double cpu_seconds() const;

  pid_t pid_ = -1;
};

/// A test with a folder of its own and small instances in it.
class CliTest : public testing::Test {
 protected:
  CliTest();
  ~CliTest() override;

  [[nodiscard]] std::string path(const std::string& name) const { return folder_ / name; }
  std::string write(const std::string& name, const std::string& text) const;
  [[nodiscard]] std::string read(const std::string& name) const;
  [[nodiscard]] bool exists(const std::string& name) const;
  /// Names of the files in the folder, without the streams of processes.
  [[nodiscard]] std::vector<std::string> files() const;
  [[nodiscard]] Finished run(const std::vector<std::string>& arguments,
                             const std::string& stdout_file = "") const;

  /// "--map ... --scen ... --agents 3" of a 4 x 3 grid, and what follows. Cost 8, makespan 4.
  [[nodiscard]] std::vector<std::string> small(const std::string& command,
                                               const std::vector<std::string>& more = {}) const;
  /// Two agents that must swap in a corridor.
  [[nodiscard]] std::vector<std::string> corridor(const std::string& command,
                                                  const std::vector<std::string>& more = {}) const;
  /// An instance that takes minutes.
  [[nodiscard]] std::vector<std::string> hard(const std::string& command,
                                              const std::vector<std::string>& more = {}) const;

  std::filesystem::path folder_;
};

std::vector<std::string> operator+(std::vector<std::string> a, const std::vector<std::string>& b);

}  // namespace quadrille::cli::test
