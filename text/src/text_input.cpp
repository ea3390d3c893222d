// SPDX-License-Identifier: MIT
#include "quadrille/text/text_input.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <istream>
#include <ostream>
#include <system_error>

namespace quadrille::text {

Result<std::string> read_all(std::istream& in, const std::string& file) {
  std::string text;
  std::array<char, std::size_t{1} << 16> chunk;
  while (in.read(chunk.data(), chunk.size()), in.gcount() > 0) {
    const std::string_view got(chunk.data(), static_cast<std::size_t>(in.gcount()));
    const auto nul = got.find('\0');
    text.append(got.substr(0, nul));
    if (nul != std::string_view::npos)
      return Error{ErrorCode::syntax,
                   "a NUL byte: this is a binary file, not a text file",
                   {file, 1 + static_cast<long>(std::count(text.begin(), text.end(), '\n'))}};
    if (text.size() > kMaxFileBytes)
      return Error{ErrorCode::out_of_range,
                   "the file has more than " + std::to_string(kMaxFileBytes) + " bytes",
                   {file, 0}};
  }
  // Only the end of the file may stop the reading.
  if (in.bad() || !in.eof()) return Error{ErrorCode::io, "cannot be read", {file, 0}};
  for (const std::string_view mark : {"\xFE\xFF", "\xFF\xFE"})
    if (text.starts_with(mark))
      return Error{
          ErrorCode::syntax, "a byte order mark of UTF-16: files are read as UTF-8", {file, 1}};
  constexpr std::string_view kUtf8Mark = "\xEF\xBB\xBF";
  if (text.starts_with(kUtf8Mark)) text.erase(0, kUtf8Mark.size());
  return text;
}

std::optional<Error> open_input(const std::filesystem::path& path, std::ifstream& in) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    return Error{ErrorCode::io, "is a directory", {path.string(), 0}};
  errno = 0;
  in.open(path, std::ios::binary);
  if (!in.is_open()) {
    const std::string why = errno == 0 ? "" : ": " + std::generic_category().message(errno);
    return Error{ErrorCode::io, "cannot be opened" + why, {path.string(), 0}};
  }
  return std::nullopt;
}

std::optional<Error> finish_output(std::ostream& out, const std::string& file) {
  errno = 0;
  if (out.flush()) return std::nullopt;
  const std::string why = errno == 0 ? "" : ": " + std::generic_category().message(errno);
  return Error{ErrorCode::io, "cannot be written" + why, {file, 0}};
}

std::optional<std::string_view> LineReader::next() {
  if (at_end_) return std::nullopt;
  ++number_;
  if (rest_.empty()) {
    at_end_ = true;
    return std::nullopt;
  }
  const auto end = rest_.find('\n');
  std::string_view line = rest_.substr(0, end);
  rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

Natural parse_natural(std::string_view text, std::int64_t max) {
  Natural number;
  const bool digits = !text.empty() && std::all_of(text.begin(), text.end(),
                                                   [](char c) { return c >= '0' && c <= '9'; });
  if (!digits) return {0, NumberFault::malformed};
  for (const char c : text) {
    const std::int64_t digit = c - '0';
    // Division rounds negative numbers up.
    if (digit > max || number.value > (max - digit) / 10) return {0, NumberFault::too_large};
    number.value = 10 * number.value + digit;
  }
  return number;
}

std::string printable(std::string_view text, std::size_t max_length) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string result;
  for (const char c : text) {
    if (result.size() >= max_length) return result + "...";
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte < 0x7f)
      result += c;
    else
      result += std::string("\\x") + kDigits[byte / 16] + kDigits[byte % 16];
  }
  return result;
}

std::string in_quotes(std::string_view text) { return "'" + printable(text, 40) + "'"; }

}  // namespace quadrille::text
