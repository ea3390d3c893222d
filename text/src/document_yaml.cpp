// SPDX-License-Identifier: MIT
//
// yaml-cpp reads the syntax; its events go straight into a Document. Its own tree of nodes is not
// used: aliases would make shared and even cyclic values of it.
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <array>
#include <exception>
#include <istream>
#include <streambuf>
#include <string>
#include <utility>
#include <vector>

#include "quadrille/text/document.hpp"
#include "quadrille/text/text_input.hpp"

namespace quadrille::text {
namespace {

constexpr std::string_view kTupleTag = "tag:yaml.org,2002:python/tuple";

/// Hands a text to the parser. The parser collects the tokens of a flow collection that could yet
/// turn out to be a key, with more than a hundred bytes of memory for each byte of text: how far it
/// may read without telling of anything is limited.
class LimitedInput final : public std::streambuf {
 public:
  explicit LimitedInput(std::string_view text) : rest_(text) {}

  /// After the limit nothing that the parser tells of counts.
  void note_event() {
    if (!limit_exceeded()) silent_ = 0;
  }
  [[nodiscard]] bool limit_exceeded() const { return silent_ > kMaxYamlLookahead; }

 protected:
  int_type underflow() override {
    // To the parser the text ends here; what it then says is of no interest.
    if (rest_.empty() || limit_exceeded()) return traits_type::eof();
    const std::size_t size = rest_.copy(chunk_.data(), chunk_.size());
    rest_.remove_prefix(size);
    silent_ += size;
    setg(chunk_.data(), chunk_.data(), chunk_.data() + size);
    return traits_type::to_int_type(chunk_.front());
  }

 private:
  std::string_view rest_;
  std::array<char, 2048> chunk_;
  std::size_t silent_ = 0;  // Bytes read since the last event.
};

/// Leaves the parser after the builder has refused something.
struct Stop : std::exception {};

class YamlHandler final : public YAML::EventHandler {
 public:
  YamlHandler(const std::string& file, LimitedInput& input) : builder_(file), input_(input) {}
  DocumentBuilder& builder() { return builder_; }
  [[nodiscard]] long last_line() const { return last_line_; }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (!builder_.is_empty()) refuse("a second document", mark);
  }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    check(mark, "", anchor);
    if (!begin_value(mark, false)) return;
    // The parser has gone on to what follows the missing value.
    const long at = levels_.empty() || !levels_.back().is_map ? line(mark) : key_line_;
    require(builder_.add_opaque(Document::Kind::null, at));
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    refuse("aliases are not accepted", mark);
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    const bool plain = tag == "?" || tag.empty();
    if (!plain && tag != "!") refuse("the tag " + in_quotes(tag) + " is not accepted here", mark);
    check(mark, "", anchor);
    const bool key = !begin_value(mark, true);
    if (key) key_line_ = line(mark);
    const bool negative = plain && value.starts_with('-');
    const Natural number =
        parse_natural(std::string_view(value).substr(negative ? 1 : 0), INT64_MAX);
    if (key || !plain || number.fault == NumberFault::malformed)
      require(builder_.add_text(value, line(mark)));
    else if (number.fault == NumberFault::too_large || (negative && number.value == 0))
      require(builder_.add_opaque(Document::Kind::real, line(mark)));
    else
      require(builder_.add_integer(negative ? -number.value : number.value, line(mark)));
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    check(mark, tag == kTupleTag ? "" : tag, anchor);
    begin_value(mark, false);
    open(Document::Kind::array, mark);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    check(mark, tag, anchor);
    begin_value(mark, false);
    open(Document::Kind::object, mark);
  }
  void OnMapEnd() override { close(); }

 private:
  struct Level {
    bool is_map;
    bool key_next;
  };

  static long line(const YAML::Mark& mark) { return mark.is_null() ? 0 : mark.line + 1; }
  static void require(bool fine) {
    if (!fine) throw Stop();
  }
  void refuse(std::string message, const YAML::Mark& mark) {
    require(builder_.fail(ErrorCode::syntax, std::move(message), line(mark)));
  }
  /// Each value passes here.
  void check(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) {
    input_.note_event();
    if (!input_.limit_exceeded()) last_line_ = line(mark);
    if (anchor != YAML::NullAnchor) refuse("anchors are not accepted", mark);
    if (!tag.empty() && tag != "?" && tag != "!")
      refuse("the tag " + in_quotes(tag) + " is not accepted here", mark);
  }
  /// Notes that a value or key begins; false for a key.
  bool begin_value(const YAML::Mark& mark, bool may_be_key) {
    if (levels_.empty() || !levels_.back().is_map) return true;
    const bool key = levels_.back().key_next;
    levels_.back().key_next = !key;
    if (key && !may_be_key) refuse("a key has to be a string", mark);
    return !key;
  }
  void open(Document::Kind kind, const YAML::Mark& mark) {
    require(builder_.open(kind, line(mark)));
    levels_.push_back({kind == Document::Kind::object, true});
  }
  void close() {
    levels_.pop_back();
    builder_.close();
  }

  DocumentBuilder builder_;
  LimitedInput& input_;
  std::vector<Level> levels_;
  long key_line_ = 0;
  long last_line_ = 1;
};

/// Whether more brackets are open somewhere than any file of these formats has, quoted ones
/// included. The parser looks ahead over all of them, with a few hundred bytes for each.
bool has_too_many_open_brackets(std::string_view text) {
  constexpr std::size_t kMaxOpen = 1000;
  std::size_t open = 0;
  for (const char c : text) {
    if (c == '[' || c == '{') ++open;
    if ((c == ']' || c == '}') && open > 0) --open;
    if (open > kMaxOpen) return true;
  }
  return false;
}

}  // namespace

Result<Document> parse_yaml(std::string_view text, const std::string& file) {
  if (has_too_many_open_brackets(text))
    return Error{ErrorCode::out_of_range, "too many brackets are open at the same time", {file, 0}};
  LimitedInput input(text);
  std::istream in(&input);
  YamlHandler handler(file, input);
  try {
    YAML::Parser parser(in);
    while (parser.HandleNextDocument(handler)) {
    }
  } catch (const Stop&) {
    // The builder holds the error.
  } catch (const YAML::Exception& e) {
    const long line = e.mark.is_null() ? 0 : e.mark.line + 1;
    handler.builder().fail(ErrorCode::syntax, "not valid YAML: " + printable(e.msg, 200), line);
  }
  if (input.limit_exceeded())
    return Error{ErrorCode::out_of_range,
                 "what begins here has more than " + std::to_string(kMaxYamlLookahead) +
                     " bytes in one piece: lists of that length have to be in block style",
                 {file, handler.last_line()}};
  if (handler.builder().error()) return *handler.builder().error();
  if (handler.builder().is_empty())
    return Error{ErrorCode::syntax, "the file has no content", {file, 1}};
  return std::move(handler.builder()).take();
}

}  // namespace quadrille::text
