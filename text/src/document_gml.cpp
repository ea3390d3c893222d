// SPDX-License-Identifier: MIT
//
// GML: a key and its value, again and again; a value is a number, a text in double quotes, or a
// list of such pairs in brackets.
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "quadrille/text/document.hpp"
#include "quadrille/text/text_input.hpp"

namespace quadrille::text {
namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

class GmlParser {
 public:
  GmlParser(std::string_view text, const std::string& file) : text_(text), builder_(file) {}

  Result<Document> run() {
    if (builder_.open(Document::Kind::object, line_) && read_pairs()) {
      builder_.close();
      return std::move(builder_).take();
    }
    return *builder_.error();
  }

 private:
  bool fail(const std::string& message) {
    return builder_.fail(ErrorCode::syntax, "not valid GML: " + message, line_);
  }

  /// White space, and lines that begin with #.
  void skip() {
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (c == '#') {
        at_ = std::min(text_.find('\n', at_), text_.size());
        if (at_ == text_.size()) return;
      } else if (c != ' ' && c != '\t' && c != '\r' && c != '\n') {
        return;
      }
      if (text_[at_] == '\n') ++line_;
    }
  }

  bool read_pairs() {
    std::size_t depth = 0;
    for (skip(); at_ < text_.size(); skip()) {
      const char c = text_[at_];
      if (c == ']') {
        if (depth == 0) return fail("']' without '['");
        --depth;
        ++at_;
        builder_.close();
        continue;
      }
      if (!is_letter(c)) return fail("expected a key, found " + in_quotes(text_.substr(at_, 1)));
      const std::size_t begin = at_;
      while (at_ < text_.size() && (is_letter(text_[at_]) || is_digit(text_[at_]))) ++at_;
      if (!builder_.add_text(text_.substr(begin, at_ - begin), line_)) return false;
      skip();
      if (at_ == text_.size()) return fail("the file ends after a key");
      if (text_[at_] == '[') {
        ++at_;
        ++depth;
        if (!builder_.open(Document::Kind::object, line_)) return false;
      } else if (!read_value()) {
        return false;
      }
    }
    return depth == 0 || fail("the file ends before a ']'");
  }

  bool read_value() {
    if (text_[at_] == '"') return read_text();
    const std::size_t begin = at_;
    while (at_ < text_.size() &&
           std::string_view(" \t\r\n[]\"#").find(text_[at_]) == std::string_view::npos)
      ++at_;
    std::string_view token = text_.substr(begin, at_ - begin);
    const std::string_view shown = token;
    if (token.starts_with('+')) token.remove_prefix(1);
    const char* const end = token.data() + token.size();
    std::int64_t integer = 0;
    const auto whole = std::from_chars(token.data(), end, integer);
    if (whole.ec == std::errc() && whole.ptr == end) return builder_.add_integer(integer, line_);
    double real = 0;
    const auto number = std::from_chars(token.data(), end, real);
    // from_chars knows nan and inf, which GML does not.
    const bool is_number = number.ec == std::errc() && number.ptr == end && !token.empty() &&
                           (is_digit(token.back()) || token.back() == '.');
    return is_number ? builder_.add_real(real, line_)
                     : fail("expected a number, a text or a list, found " + in_quotes(shown));
  }

  /// Entities such as &#228; stay as they are.
  bool read_text() {
    const auto end = text_.find('"', at_ + 1);
    if (end == std::string_view::npos) return fail("the file ends inside of a text");
    const std::string_view inner = text_.substr(at_ + 1, end - at_ - 1);
    const long begins = line_;
    for (const char c : inner) line_ += c == '\n' ? 1 : 0;
    at_ = end + 1;
    return builder_.add_text(inner, begins);
  }

  std::string_view text_;
  DocumentBuilder builder_;
  std::size_t at_ = 0;
  long line_ = 1;
};

}  // namespace

Result<Document> parse_gml(std::string_view text, const std::string& file) {
  return GmlParser(text, file).run();
}

}  // namespace quadrille::text
