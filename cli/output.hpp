// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>
#include <optional>
#include <string>
#include <string_view>

#include "quadrille/core/result.hpp"

namespace quadrille::cli {

/// A file to be written once, after work that must not be in vain: `probe` finds out beforehand
/// whether it can be written, without changing it. Regular files are replaced as a whole or left
/// alone. "-" is standard output.
class OutputFile {
 public:
  /// Errors (io): a folder that is missing or not writable, a file that is protected.
  [[nodiscard]] static Result<OutputFile> probe(std::string path);

  /// Writes the text and makes sure that it has arrived. Errors: io.
  [[nodiscard]] std::optional<Error> write(std::string_view text) const;

  [[nodiscard]] bool is_stdout() const noexcept { return path_ == "-"; }
  [[nodiscard]] const std::string& path() const noexcept { return path_; }

 private:
  OutputFile(std::string path, std::string target, bool replace);
  [[nodiscard]] std::optional<Error> replace(std::string_view text) const;

  std::string path_;    // as the user gave it
  std::string target_;  // where symbolic links lead
  bool replace_;        // else written in place: a device, a pipe, or a folder that takes no new files
};

/// Standard output, flushed. Errors: io; a broken pipe is one too.
[[nodiscard]] std::optional<Error> write_stdout(std::string_view text);

/// Human text: to stdout, or to stderr when stdout carries a file, or nowhere.
class Console {
 public:
  Console(bool quiet, bool stdout_taken) : quiet_(quiet), to_stderr_(stdout_taken) {}
  void print(std::string_view text);
  /// The first error of printing to stdout. What stderr loses is lost.
  [[nodiscard]] const std::optional<Error>& error() const noexcept { return error_; }
  [[nodiscard]] bool quiet() const noexcept { return quiet_; }

 private:
  bool quiet_, to_stderr_;
  std::optional<Error> error_;
};

/// Prints "quadrille: ..." to stderr; nothing for a broken pipe on stdout, whose reader has left.
void report_error(const Error& error);

}  // namespace quadrille::cli
