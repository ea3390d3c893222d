// SPDX-License-Identifier: MIT
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include "quadrille/core/result.hpp"

namespace quadrille::cli {

/// A file to be written once, after work that must not be wasted: `probe` finds out beforehand
/// whether it can be written, without changing it. Regular files are replaced as a whole or left
/// alone. "-" is standard output.
class OutputFile {
 public:
  /// Errors (io): a folder that is missing or not writable, a file that is protected.
  [[nodiscard]] static Result<OutputFile> probe(std::string path);

  /// Writes the text and makes sure that it has arrived. Returns 0 or the errno of the failure. A
  /// terminal gets it as terminal_text.
  [[nodiscard]] int write(std::string_view text) const;

  [[nodiscard]] bool is_stdout() const noexcept { return path_ == "-"; }
  [[nodiscard]] const std::string& path() const noexcept { return path_; }

 private:
  OutputFile(std::string path, std::string target, bool replace);
  [[nodiscard]] int replace(std::string_view text) const;

  std::string path_;    // as the user gave it
  std::string target_;  // where symbolic links lead
  bool replace_;  // else written in place: a device, a pipe, or a folder that takes no new files
};

/// An output as the user named it.
struct NamedOutput {
  const char* option;
  const std::string* file;  ///< Empty: there is none.
  /// One of the inputs that it may replace, if any.
  const std::string* replaces = nullptr;
};

/// Why these files may not be written in one run; empty if they may: two outputs go to one file, or
/// one goes to an input. It does not matter whether the file exists, nor how its name is written,
/// nor whether links lead to it. Devices such as /dev/null may be named twice. `has_messages`: what
/// is said for people goes to standard output, unless one of the outputs does.
[[nodiscard]] std::string check_outputs(std::initializer_list<NamedOutput> named,
                                        std::initializer_list<const std::string*> inputs,
                                        bool has_messages = false);

/// Human text: to stdout, or to stderr when stdout carries a file, or nowhere.
class Console {
 public:
  Console(bool quiet, bool stdout_taken) : quiet_(quiet), to_stderr_(stdout_taken) {}
  void print(std::string_view text);
  /// The errno of the first failure to print to stdout, or 0. What stderr loses is lost.
  [[nodiscard]] int failure() const noexcept { return failure_; }
  [[nodiscard]] bool quiet() const noexcept { return quiet_; }

 private:
  bool quiet_, to_stderr_;
  int failure_ = 0;
};

/// Keeps the numbers of standard streams that are closed from being given to files, which would
/// then receive the messages. Writing to such a stream fails. Call it first.
void reserve_standard_streams();

/// Prints to stderr as far as that takes it. This, Console and `print_on_line` are the only ways of
/// text to people; all three write terminal_text.
void print_stderr(std::string_view text) noexcept;
/// Writes one line of stderr again from its beginning, and leaves it open.
void print_on_line(std::string_view text);

/// Whether what goes to the stream is read on a terminal that shows colours, by somebody who wants
/// them: the environment says so with NO_COLOR (if it has any value) and TERM=dumb.
[[nodiscard]] bool is_colourful(int stream);
/// The text with the words that say how it went in green, yellow or red: the result of a solve, the
/// verdict on a plan.
[[nodiscard]] std::string in_colours(std::string_view text);

/// Prints "quadrille: <file>:<line>: <reason>" to stderr.
void report_error(const Error& error);
/// Prints "quadrille: warning: <file>:<line>: <what>" to stderr: the work goes on.
void report_warning(const Error& warning);

/// Says on stderr that `path` ("-": standard output) could not be written. Silent about a broken
/// pipe: its reader has left on purpose.
void report_write_failure(const std::string& path, int code);

/// For commands with one output: writes and reports a failure. True if all is well.
[[nodiscard]] bool write_or_report(const OutputFile& file, std::string_view text);

/// Writes to standard output as OutputFile does, piece by piece. Returns 0 or the errno.
[[nodiscard]] int write_stdout(std::string_view text);

}  // namespace quadrille::cli
