// SPDX-License-Identifier: MIT
#pragma once

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/files/inputs.hpp"
#include "cli/files/options.hpp"

namespace quadrille::cli::test {

/// One random instance, a solve of it with random options, and then every command on the files
/// that come of it. The first thing that is wrong ends the case; `problem` says what.
class FilesCase {
 public:
  explicit FilesCase(std::uint64_t seed);
  /// Empty if all is well; otherwise what is wrong, and all commands that led there.
  std::string problem();

 private:
  struct Problem {
    std::string what;
  };
  [[noreturn]] static void fail(const std::string& what) { throw Problem{what}; }
  /// Fails unless the command ends with one of the codes.
  Ended must(const Words& words, std::initializer_list<int> codes);
  /// `command`, the instance, and `more`.
  Ended on_input(const std::string& command, const Words& more, std::initializer_list<int> codes);
  static void expect(const std::string& what, const std::string& why_not);

  void run();
  void overlapping();
  /// Whether there is a plan.
  bool solve();
  void look_at_outputs(bool has_plan, int code);
  void explain();

  // What reads a file with a plan, in `format`.
  void read_plan(const std::string& file, const std::string& format);
  void convert_there_and_back(const std::string& file, const std::string& format);
  void view(const std::string& file);
  void execute(const std::string& file);
  void export_it(const std::string& file);
  void begin_with(const std::string& file);
  /// The plan in this project's JSON, as a file and as it is.
  std::string as_json(const std::string& file, const std::string& format, nlohmann::json& plan);

  void convert_instance();
  void generate_more();
  /// Plans that break rules: `convert` takes them all the same.
  void break_plan(const std::string& file);

  Random random_;
  Workshop workshop_;
  FileNames names_;
  Input input_;
  Outputs outputs_;
  std::string plan_format_;
  Words objective_;
  std::string bound_;      ///< The lower bound of the result, in the units of the input.
  std::string json_plan_;  ///< A file with the plan in this project's JSON; empty without one.
};

}  // namespace quadrille::cli::test
