// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/core/result.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::text {

/// A parsed JSON, YAML or GML file: its values in the order of the file, sixteen bytes each, with
/// their lines. Containers are followed by what they contain; in an object each value follows its
/// key, which is a string.
class Document {
 public:
  enum class Kind : std::uint8_t { null, boolean, integer, real, string, array, object };
  using Node = std::uint32_t;

  static constexpr Node kRoot = 0;
  static constexpr std::size_t kMaxNodes = std::size_t{1} << 25;
  static constexpr std::size_t kMaxDepth = 32;

  explicit Document(std::string file) : file_(std::move(file)) {}

  [[nodiscard]] const std::string& file() const noexcept { return file_; }
  [[nodiscard]] Kind kind(Node node) const { return static_cast<Kind>(items_[node].kind); }
  [[nodiscard]] long line(Node node) const { return items_[node].line; }
  /// Requires a boolean of a JSON file.
  [[nodiscard]] bool boolean(Node node) const { return items_[node].payload != 0; }
  /// Requires an integer.
  [[nodiscard]] std::int64_t integer(Node node) const { return items_[node].payload; }
  /// Requires an integer or a real number.
  [[nodiscard]] double number(Node node) const;
  /// Requires a string.
  [[nodiscard]] std::string_view text(Node node) const;

  /// The first node inside a container, and the node after a value and all it contains: the
  /// children of `c` are c' = first(c), next(c'), ... as long as c' < next(c).
  [[nodiscard]] Node first(Node container) const { return container + 1; }
  [[nodiscard]] Node next(Node node) const { return items_[node].next; }

  /// `/agents/3/start` for a value or a key; empty for the root.
  [[nodiscard]] std::string path(Node node) const;
  /// An error at a value; the message begins with the path.
  [[nodiscard]] Error error(Node node, ErrorCode code, const std::string& message) const;

 private:
  friend class DocumentBuilder;
  struct Item {
    std::int64_t payload = 0;  // Integer; bits of a real number; offset and length of a text.
    std::uint32_t next = 0;
    std::uint32_t line : 29 = 0;
    std::uint32_t kind : 3 = 0;
  };
  std::string file_;
  std::vector<Item> items_;
  std::string texts_;
};

/// Takes the events of a parser. A call that returns false has refused its value: stop parsing and
/// take `error`.
class DocumentBuilder {
 public:
  explicit DocumentBuilder(const std::string& file) : document_(file) {}

  bool add_integer(std::int64_t value, long line) {
    return add(Document::Kind::integer, value, line);
  }
  bool add_real(double value, long line) {
    return add(Document::Kind::real, std::bit_cast<std::int64_t>(value), line);
  }
  bool add_boolean(bool value, long line) {
    return add(Document::Kind::boolean, value ? 1 : 0, line);
  }
  /// Null, or what no format needs.
  bool add_opaque(Document::Kind kind, long line) { return add(kind, 0, line); }
  bool add_text(std::string_view text, long line);
  bool open(Document::Kind container, long line);
  void close();
  bool fail(ErrorCode code, std::string message, long line);

  [[nodiscard]] bool is_empty() const noexcept { return document_.items_.empty(); }
  [[nodiscard]] const std::optional<Error>& error() const noexcept { return error_; }
  /// Requires one complete value and no error.
  [[nodiscard]] Document take() && { return std::move(document_); }

 private:
  bool add(Document::Kind kind, std::int64_t payload, long line);
  Document document_;
  std::vector<Document::Node> open_;
  std::optional<Error> error_;
};

/// Parses a whole text. Errors: syntax; out_of_range for numbers beyond double, more than kMaxNodes
/// values or nesting deeper than kMaxDepth. Repeated keys are found by Checker::members.
[[nodiscard]] Result<Document> parse_json(std::string_view text, const std::string& file);

/// In YAML, a value, key or comment, and a flow collection in a place where it could be a key
/// (above all one that is the whole document), has at most this many bytes.
inline constexpr std::size_t kMaxYamlLookahead = std::size_t{1} << 20;

/// One YAML document without anchors, aliases and tags other than `!!python/tuple`. Plain scalars
/// that look like decimal integers are integers, null ones are null, all others are strings.
/// Errors as those of parse_json, and out_of_range above kMaxYamlLookahead.
[[nodiscard]] Result<Document> parse_yaml(std::string_view text, const std::string& file);

/// A graph in GML: lists in brackets are objects, in which keys may be repeated. Errors as those of
/// parse_json.
[[nodiscard]] Result<Document> parse_gml(std::string_view text, const std::string& file);

/// Looks for values in a document and remembers the first thing that is wrong. Each function
/// returns whether all is well; calls can be chained with &&.
class Checker {
 public:
  explicit Checker(const Document& document) : document_(document) {}

  struct Member {
    std::string_view name;
    std::optional<Document::Node>* value;
    bool required = true;
  };
  /// The object has the required members, perhaps the others, each once, and nothing else.
  bool members(Document::Node object, std::span<const Member> wanted);
  bool members(Document::Node object, std::initializer_list<Member> wanted) {
    return members(object, std::span(wanted.begin(), wanted.size()));
  }
  bool array(Document::Node node, std::string_view of_what);
  /// As array, with exactly `size` children.
  bool array(Document::Node node, std::string_view of_what, std::size_t size);
  bool integer(Document::Node node, std::int64_t min, std::int64_t max, std::int64_t& value);
  /// Integer or real, and finite.
  bool number(Document::Node node, double& value);
  bool text(Document::Node node, std::string_view& value);
  bool boolean(Document::Node node, bool& value);
  /// Two integers in an array.
  bool pair(Document::Node node, std::int64_t max, std::int64_t& first, std::int64_t& second);

  bool fail(Document::Node node, ErrorCode code, const std::string& message);
  bool fail(Document::Node node, const std::string& message) {
    return fail(node, ErrorCode::syntax, message);
  }
  /// Requires that a call has returned false.
  [[nodiscard]] const Error& error() const { return *error_; }

 private:
  const Document& document_;
  std::optional<Error> error_;
};

}  // namespace quadrille::text

QUADRILLE_API_END
