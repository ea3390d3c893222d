// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <iosfwd>
#include <memory>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>

#include "quadrille/core/result.hpp"
#include "quadrille/text/text_input.hpp"

namespace quadrille::continuous {

/// A parsed XML file that knows the lines of its elements. What the parser lets pass although it is
/// not well-formed is refused: repeated attributes, entities that are not defined.
class XmlFile {
 public:
  [[nodiscard]] static Result<XmlFile> parse(std::string text, const std::string& file);
  [[nodiscard]] static Result<XmlFile> read(std::istream& in, const std::string& file);
  [[nodiscard]] static Result<XmlFile> read(const std::filesystem::path& path);

  [[nodiscard]] pugi::xml_node root() const { return document_->document_element(); }

  /// Where an element belongs: the names from the root down to it, such as {"root", "log",
  /// "agent"}.
  using Place = std::initializer_list<std::string_view>;
  /// The first element that has the last name of a place and is somewhere else.
  [[nodiscard]] std::optional<Error> misplaced(std::initializer_list<Place> places) const;
  /// The child of that name, null if there is none. Errors: syntax for a second one.
  [[nodiscard]] Result<pugi::xml_node> only_child(const pugi::xml_node& parent,
                                                  const char* name) const;
  /// The text of an element, which is nothing else. Errors: syntax if it is in pieces, between
  /// which there are elements or comments: "1,2<!-- -->5" is 1,25 to one reader and 1,2 to another.
  [[nodiscard]] Result<std::string_view> text(const pugi::xml_node& node) const;
  [[nodiscard]] long line(const pugi::xml_node& node) const;
  [[nodiscard]] Error error(const pugi::xml_node& node, const std::string& message,
                            ErrorCode code = ErrorCode::syntax) const;
  [[nodiscard]] const std::string& file() const noexcept { return file_; }

 private:
  XmlFile() = default;
  [[nodiscard]] std::optional<Error> check_top_level() const;
  [[nodiscard]] std::optional<Error> check_attributes() const;
  [[nodiscard]] long line_at(std::ptrdiff_t offset) const;

  std::string file_, text_;
  std::unique_ptr<pugi::xml_document> document_;
  // How far lines have been counted: questions come mostly in the order of the file.
  mutable std::ptrdiff_t counted_ = 0;
  mutable long line_ = 1;
};

/// The whole text, white space around it left aside, as a finite number.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);
/// The same, as an integer within [min, max].
[[nodiscard]] std::optional<std::int64_t> parse_integer(std::string_view text, std::int64_t min,
                                                        std::int64_t max);
/// Text from a file in a form that can be put into a message.
[[nodiscard]] inline std::string quoted(std::string_view text) { return text::in_quotes(text); }

}  // namespace quadrille::continuous
