// SPDX-License-Identifier: MIT
#include "formats/xml_input.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <utility>

#include "quadrille/text/text_input.hpp"

namespace quadrille::continuous {
namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r\n";
  const auto first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

}  // namespace

Result<XmlFile> XmlFile::parse(std::string text, const std::string& file) {
  XmlFile xml;
  xml.file_ = file;
  xml.text_ = std::move(text);
  xml.document_ = std::make_unique<pugi::xml_document>();
  // As a fragment, so that text around the root element is not overlooked.
  const auto parsed = xml.document_->load_buffer(xml.text_.data(), xml.text_.size(),
                                                 pugi::parse_default | pugi::parse_fragment);
  if (!parsed)
    return Error{ErrorCode::syntax,
                 std::string("not well-formed XML: ") + parsed.description(),
                 {file, xml.line_at(parsed.offset)}};
  bool has_root = false;
  for (const pugi::xml_node child : xml.document_->children()) {
    if (child.type() == pugi::node_pcdata && trimmed(child.value()).empty()) continue;
    if (child.type() == pugi::node_element && !has_root)
      has_root = true;
    else if (child.type() == pugi::node_element)
      return xml.error(child, "there is a second root element");
    else if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata)
      return xml.error(child, "not well-formed XML: text outside of the root element");
  }
  if (!has_root) return Error{ErrorCode::syntax, "not well-formed XML: no element", {file, 1}};
  return xml;
}

Result<XmlFile> XmlFile::read(std::istream& in, const std::string& file) {
  auto text = text::read_all(in, file);
  if (!text) return text.error();
  return parse(std::move(text).value(), file);
}

Result<XmlFile> XmlFile::read(const std::filesystem::path& path) {
  std::ifstream in;
  if (auto error = text::open_input(path, in)) return *error;
  return read(in, path.string());
}

long XmlFile::line_at(std::ptrdiff_t offset) const {
  if (offset < 0) return 0;
  offset = std::min(offset, std::ssize(text_));
  if (offset < counted_) counted_ = 0, line_ = 1;
  line_ += static_cast<long>(std::count(text_.begin() + counted_, text_.begin() + offset, '\n'));
  counted_ = offset;
  return line_;
}

long XmlFile::line(const pugi::xml_node& node) const { return line_at(node.offset_debug()); }

Error XmlFile::error(const pugi::xml_node& node, const std::string& message, ErrorCode code) const {
  return {code, message, {file_, line(node)}};
}

std::optional<double> parse_number(std::string_view text) {
  text = trimmed(text);
  double value = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

std::optional<std::int64_t> parse_integer(std::string_view text, std::int64_t min,
                                          std::int64_t max) {
  text = trimmed(text);
  std::int64_t value = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc() || end != text.data() + text.size() || value < min || value > max)
    return std::nullopt;
  return value;
}

}  // namespace quadrille::continuous
