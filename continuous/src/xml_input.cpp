// SPDX-License-Identifier: MIT
#include "xml_input.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <utility>

#include "quadrille/continuous/roadmap_xml.hpp"

namespace quadrille::continuous {
namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r\n";
  const auto first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

long line_at(std::string_view text, std::ptrdiff_t offset) {
  if (offset < 0) return 0;
  const auto end = text.begin() + std::min<std::ptrdiff_t>(offset, std::ssize(text));
  return 1 + static_cast<long>(std::count(text.begin(), end, '\n'));
}

}  // namespace

Result<XmlFile> XmlFile::read(std::istream& in, const std::string& file) {
  XmlFile xml;
  xml.file_ = file;
  char buffer[1 << 16];
  while (in.read(buffer, sizeof buffer), in.gcount() > 0) {
    xml.text_.append(buffer, static_cast<std::size_t>(in.gcount()));
    if (xml.text_.size() > kMaxXmlBytes)
      return Error{ErrorCode::out_of_range, "the file is too large", {file, 0}};
  }
  if (in.bad()) return Error{ErrorCode::io, "cannot be read", {file, 0}};
  if (const auto nul = xml.text_.find('\0'); nul != std::string::npos)
    return Error{ErrorCode::syntax,
                 "a NUL byte",
                 {file, line_at(xml.text_, static_cast<std::ptrdiff_t>(nul))}};
  xml.document_ = std::make_unique<pugi::xml_document>();
  const auto parsed = xml.document_->load_buffer(xml.text_.data(), xml.text_.size());
  if (!parsed)
    return Error{ErrorCode::syntax,
                 std::string("not well-formed XML: ") + parsed.description(),
                 {file, line_at(xml.text_, parsed.offset)}};
  return xml;
}

Result<XmlFile> XmlFile::read(const std::filesystem::path& path) {
  std::error_code problem;
  if (std::filesystem::is_directory(path, problem))
    return Error{ErrorCode::io, "is a directory", {path.string(), 0}};
  std::ifstream in(path, std::ios::binary);
  if (!in) return Error{ErrorCode::io, "cannot be opened", {path.string(), 0}};
  return read(in, path.string());
}

long XmlFile::line(const pugi::xml_node& node) const { return line_at(text_, node.offset_debug()); }

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

std::string quoted(std::string_view text) {
  constexpr std::size_t kMaxLength = 40;
  std::string result = "'";
  for (const char c : text.substr(0, kMaxLength)) result += c >= ' ' && c <= '~' ? c : '?';
  return result + (text.size() > kMaxLength ? "...'" : "'");
}

}  // namespace quadrille::continuous
