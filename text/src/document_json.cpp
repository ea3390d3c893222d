// SPDX-License-Identifier: MIT
//
// nlohmann-json reads the syntax; the values go straight into a Document, so that neither depth nor
// size of a hostile file matters, and each value knows its line.
#include <algorithm>
#include <cstddef>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "quadrille/text/document.hpp"
#include "quadrille/text/text_input.hpp"

namespace quadrille::text {
namespace {

/// Walks over the text and tells how far the parser has read.
class CountingIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  CountingIterator(const char* at, const char** reached) : at_(at), reached_(reached) {}
  reference operator*() const { return *at_; }
  CountingIterator& operator++() {
    *reached_ = ++at_;
    return *this;
  }
  CountingIterator operator++(int) {
    CountingIterator old = *this;
    ++*this;
    return old;
  }
  bool operator==(const CountingIterator& other) const { return at_ == other.at_; }

 private:
  const char* at_;
  const char** reached_;
};

/// The part of the library's message that follows the position.
std::string reason(const std::string& what) {
  const auto column = what.find("column ");
  if (column != std::string::npos) return printable(what.substr(column), 200);
  const auto bracket = what.find("] ");
  return printable(bracket == std::string::npos ? what : what.substr(bracket + 2), 200);
}

class JsonHandler {
 public:
  JsonHandler(std::string_view text, const std::string& file)
      : text_(text), builder_(file), counted_(text.data()), reached_(text.data()) {}

  const char** reached() { return &reached_; }
  DocumentBuilder& builder() { return builder_; }

  // The events of nlohmann's SAX interface.
  bool null() { return builder_.add_opaque(Document::Kind::null, line()); }
  bool boolean(bool value) { return builder_.add_boolean(value, line()); }
  bool number_integer(std::int64_t value) {
    // Only numbers with a sign come here. -0 is a number, but no integer anywhere.
    return value == 0 ? number_float(-0.0, {}) : builder_.add_integer(value, line());
  }
  bool number_unsigned(std::uint64_t value) {
    if (value > INT64_MAX) return number_float(static_cast<double>(value), {});
    return builder_.add_integer(static_cast<std::int64_t>(value), line());
  }
  bool number_float(double value, const std::string&) { return builder_.add_real(value, line()); }
  bool string(const std::string& text) { return builder_.add_text(text, line()); }
  bool binary(const nlohmann::json::binary_t&) {
    return builder_.fail(ErrorCode::syntax, "binary value", line());
  }
  bool start_object(std::size_t) { return builder_.open(Document::Kind::object, line()); }
  bool key(const std::string& text) { return builder_.add_text(text, line()); }
  bool end_object() { return end(); }
  bool start_array(std::size_t) { return builder_.open(Document::Kind::array, line()); }
  bool end_array() { return end(); }
  bool parse_error(std::size_t position, const std::string&, const nlohmann::json::exception& e) {
    const std::string_view before = text_.substr(0, position > 0 ? position - 1 : 0);
    const long at = 1 + static_cast<long>(std::count(before.begin(), before.end(), '\n'));
    // 406: a number that no double can hold.
    const ErrorCode code = e.id == 406 ? ErrorCode::out_of_range : ErrorCode::syntax;
    return builder_.fail(code, "not valid JSON: " + reason(e.what()), at);
  }

 private:
  bool end() {
    builder_.close();
    return true;
  }

  /// Line of the token that was read last. The character read last belongs to it, or is the one
  /// behind a number: a line end there does not count yet.
  long line() {
    const char* const end = std::max(counted_, reached_ - (reached_ == text_.data() ? 0 : 1));
    line_ += static_cast<long>(std::count(counted_, end, '\n'));
    counted_ = end;
    return line_;
  }

  std::string_view text_;
  DocumentBuilder builder_;
  const char* counted_;
  const char* reached_;
  long line_ = 1;
};

}  // namespace

Result<Document> parse_json(std::string_view text, const std::string& file) {
  JsonHandler handler(text, file);
  const bool fine = nlohmann::json::sax_parse(
      CountingIterator(text.data(), handler.reached()),
      CountingIterator(text.data() + text.size(), handler.reached()), &handler);
  if (handler.builder().error()) return *handler.builder().error();
  if (!fine) return Error{ErrorCode::internal, "the JSON parser stopped", {file, 0}};
  return std::move(handler.builder()).take();
}

}  // namespace quadrille::text
