// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <memory>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>

#include "quadrille/core/result.hpp"
#include "quadrille/text/text_input.hpp"

namespace quadrille::continuous {

/// A parsed XML file that knows the lines of its elements.
class XmlFile {
 public:
  [[nodiscard]] static Result<XmlFile> parse(std::string text, const std::string& file);
  [[nodiscard]] static Result<XmlFile> read(std::istream& in, const std::string& file);
  [[nodiscard]] static Result<XmlFile> read(const std::filesystem::path& path);

  [[nodiscard]] pugi::xml_node root() const { return document_->document_element(); }
  [[nodiscard]] long line(const pugi::xml_node& node) const;
  [[nodiscard]] Error error(const pugi::xml_node& node, const std::string& message,
                            ErrorCode code = ErrorCode::syntax) const;
  [[nodiscard]] const std::string& file() const noexcept { return file_; }

 private:
  XmlFile() = default;
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
