// SPDX-License-Identifier: MIT
#include "formats/xml_input.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <utility>
#include <vector>

#include "quadrille/text/sniff.hpp"
#include "quadrille/text/text_input.hpp"

namespace quadrille::continuous {
namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r\n";
  const auto first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

/// The element after `node` in the file, parents before children; null after the last one.
pugi::xml_node next_in_file(pugi::xml_node node) {
  const auto is_element = [](const pugi::xml_node& n) { return n.type() == pugi::node_element; };
  if (const pugi::xml_node child = node.find_child(is_element)) return child;
  for (; node; node = node.parent())
    for (pugi::xml_node next = node.next_sibling(); next; next = next.next_sibling())
      if (is_element(next)) return next;
  return {};
}

bool is_at(pugi::xml_node node, XmlFile::Place place) {
  for (auto name = place.end(); name != place.begin(); node = node.parent())
    if (node.name() != *--name) return false;
  return node.type() == pugi::node_document;
}

struct ReferenceFault {
  std::ptrdiff_t offset;
  std::string message;
};

/// Whether XML allows the character of that number.
bool is_character(std::uint32_t c) {
  return c == 0x9 || c == 0xa || c == 0xd || (c >= 0x20 && c < 0xd800) ||
         (c >= 0xe000 && c < 0xfffe) || (c >= 0x10000 && c < 0x110000);
}

/// What stands between & and ; names a character.
bool is_reference(std::string_view name) {
  for (const std::string_view known : {"amp", "lt", "gt", "quot", "apos"})
    if (name == known) return true;
  if (!name.starts_with('#')) return false;
  const bool hexadecimal = name.starts_with("#x");
  name.remove_prefix(hexadecimal ? 2 : 1);
  std::uint32_t value = 0;
  const char* const end = name.data() + name.size();
  const auto [reached, problem] = std::from_chars(name.data(), end, value, hexadecimal ? 16 : 10);
  return problem == std::errc() && reached == end && is_character(value);
}

/// The first & in a text that the parser takes which is no reference to a character, or < inside an
/// attribute: the parser leaves both as they stand.
std::optional<ReferenceFault> find_reference_fault(std::string_view text) {
  char quote = 0;  // Of the attribute value around us.
  bool in_tag = false;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '&') {
      constexpr std::size_t kLongest = 12;
      const std::string_view name = text.substr(at + 1, kLongest);
      const auto end = name.find(';');
      if (end == std::string_view::npos || !is_reference(name.substr(0, end)))
        return ReferenceFault{static_cast<std::ptrdiff_t>(at),
                              quoted(text.substr(at, end == std::string_view::npos ? 1 : end + 2)) +
                                  " is no character that XML knows"};
    } else if (quote != 0) {
      if (c == '<') return ReferenceFault{static_cast<std::ptrdiff_t>(at), "'<' in an attribute"};
      if (c == quote) quote = 0;
    } else if (in_tag) {
      if (c == '"' || c == '\'') quote = c;
      if (c == '>') in_tag = false;
    } else if (c == '<') {
      std::string_view end;
      for (const auto& [begin, close] :
           {std::pair<std::string_view, std::string_view>{"<!--", "-->"},
            {"<![CDATA[", "]]>"},
            {"<?", "?>"}})
        if (text.substr(at).starts_with(begin)) end = close;
      if (end.empty())
        in_tag = true;
      else
        at = std::min(text.find(end, at + 2), text.size() - end.size()) + end.size() - 1;
    }
  }
  return std::nullopt;
}

}  // namespace

Result<XmlFile> XmlFile::parse(std::string text, const std::string& file) {
  const std::string_view begin = trimmed(text);
  if (begin.empty()) return Error{ErrorCode::syntax, "the file is empty", {file, 1}};
  if (!begin.starts_with('<')) {
    const auto kind = text::sniff(text);
    return Error{ErrorCode::syntax,
                 kind == text::FileKind::unknown
                     ? "neither XML, which begins with '<', nor anything else that is known here"
                     : text::describe(kind),
                 {file, 1}};
  }
  XmlFile xml;
  xml.file_ = file;
  xml.text_ = std::move(text);
  xml.document_ = std::make_unique<pugi::xml_document>();
  // As a fragment, so that text around the root element is not overlooked. In UTF-8 whatever the
  // declaration says, so that offsets stay those of the file.
  const auto parsed =
      xml.document_->load_buffer(xml.text_.data(), xml.text_.size(),
                                 pugi::parse_default | pugi::parse_fragment, pugi::encoding_utf8);
  if (!parsed)
    return Error{ErrorCode::syntax,
                 std::string("not well-formed XML: ") + parsed.description(),
                 {file, xml.line_at(parsed.offset)}};
  if (const auto fault = find_reference_fault(xml.text_))
    return Error{ErrorCode::syntax,
                 "not well-formed XML: " + fault->message,
                 {file, xml.line_at(fault->offset)}};
  if (auto error = xml.check_top_level()) return *error;
  if (auto error = xml.check_attributes()) return *error;
  return xml;
}

std::optional<Error> XmlFile::check_top_level() const {
  bool has_root = false;
  for (const pugi::xml_node child : document_->children()) {
    if (child.type() == pugi::node_pcdata && trimmed(child.value()).empty()) continue;
    if (child.type() == pugi::node_element && !has_root)
      has_root = true;
    else if (child.type() == pugi::node_element)
      return error(child, "there is a second root element");
    else if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata)
      return error(child, "not well-formed XML: text outside of the root element");
  }
  if (!has_root) return Error{ErrorCode::syntax, "not well-formed XML: no element", {file_, 1}};
  return std::nullopt;
}

std::optional<Error> XmlFile::check_attributes() const {
  std::vector<std::string_view> names;
  for (pugi::xml_node node = root(); node; node = next_in_file(node)) {
    names.clear();
    for (const pugi::xml_attribute attribute : node.attributes()) names.push_back(attribute.name());
    std::sort(names.begin(), names.end());
    const auto twice = std::adjacent_find(names.begin(), names.end());
    if (twice != names.end())
      return error(node,
                   "not well-formed XML: the attribute " + quoted(*twice) + " is given twice");
  }
  return std::nullopt;
}

std::optional<Error> XmlFile::misplaced(std::initializer_list<Place> places) const {
  for (pugi::xml_node node = root(); node; node = next_in_file(node)) {
    const Place* wrong = nullptr;
    bool fits = false;
    for (const Place& place : places) {
      if (node.name() != *std::prev(place.end())) continue;
      fits = fits || is_at(node, place);
      wrong = &place;
    }
    if (wrong == nullptr || fits) continue;
    const std::string name(*std::prev(wrong->end()));
    return error(node, wrong->size() == 1 ? "<" + name + "> inside another element"
                                          : "<" + name + "> outside of <" +
                                                std::string(*(wrong->end() - 2)) + ">");
  }
  return std::nullopt;
}

Result<pugi::xml_node> XmlFile::only_child(const pugi::xml_node& parent, const char* name) const {
  const pugi::xml_node child = parent.child(name);
  if (const pugi::xml_node second = child.next_sibling(name))
    return error(second, "there is a second <" + std::string(name) + ">");
  return child;
}

Result<std::string_view> XmlFile::text(const pugi::xml_node& node) const {
  const pugi::xml_node only = node.first_child();
  if (!only) return std::string_view();
  if (only.next_sibling() || (only.type() != pugi::node_pcdata && only.type() != pugi::node_cdata))
    return error(node, "<" + text::printable(node.name(), 40) +
                           "> has to be text without elements or comments inside");
  return std::string_view(only.value());
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
  if (text.starts_with("-0")) return std::nullopt;
  std::int64_t value = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc() || end != text.data() + text.size() || value < min || value > max)
    return std::nullopt;
  return value;
}

}  // namespace quadrille::continuous
