// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>

#include "quadrille/core/export.hpp"
#include "quadrille/core/result.hpp"

// Reading text files; every error carries the file.

QUADRILLE_API_BEGIN

namespace quadrille::text {

/// Longer files are refused.
inline constexpr std::size_t kMaxFileBytes = std::size_t{1} << 28;

/// A whole stream. Errors: io; out_of_range above kMaxFileBytes; syntax at a NUL byte, which no
/// text format has, and at the byte order mark of UTF-16. That of UTF-8 is left away: XML, YAML and
/// many a CSV may begin with it, and JSON's RFC lets readers pass it over.
[[nodiscard]] Result<std::string> read_all(std::istream& in, const std::string& file);

/// Why `path` cannot be read, if it cannot; otherwise `in` is open.
[[nodiscard]] std::optional<Error> open_input(const std::filesystem::path& path, std::ifstream& in);

/// The error of a stream that did not take everything. Flushes.
[[nodiscard]] std::optional<Error> finish_output(std::ostream& out, const std::string& file);

/// Splits a text into lines that end with LF, CR LF or the end of the text.
class LineReader {
 public:
  explicit LineReader(std::string_view text) : rest_(text) {}

  /// The next line without its end; nullopt after the last one.
  [[nodiscard]] std::optional<std::string_view> next();
  /// Number of the line that `next` gave last, from 1; one more than the lines after a nullopt.
  [[nodiscard]] long number() const noexcept { return number_; }

 private:
  std::string_view rest_;
  long number_ = 0;
  bool at_end_ = false;
};

enum class NumberFault { none, malformed, too_large };
/// A natural number as it is read: digits only, at most `max`.
struct Natural {
  std::int64_t value = 0;
  NumberFault fault = NumberFault::none;
};
[[nodiscard]] Natural parse_natural(std::string_view text, std::int64_t max);

/// Text from a file in a form that can be put into a message: in single quotes, everything but
/// printable ASCII as \xNN, shortened.
[[nodiscard]] std::string in_quotes(std::string_view text);
/// The same without quotes.
[[nodiscard]] std::string printable(std::string_view text, std::size_t max_length);

}  // namespace quadrille::text

QUADRILLE_API_END
