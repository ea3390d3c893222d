// SPDX-License-Identifier: MIT
#include "quadrille/text/document.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "quadrille/text/text_input.hpp"

namespace quadrille::text {
namespace {

constexpr long kMaxLine = (1L << 29) - 1;

std::string kind_name(Document::Kind kind) {
  constexpr std::array<const char*, 7> kNames = {
      "null", "true or false", "an integer", "a number", "a string", "a list", "an object"};
  return kNames[static_cast<std::size_t>(kind)];
}

}  // namespace

double Document::number(Node node) const {
  const std::int64_t payload = items_[node].payload;
  return kind(node) == Kind::real ? std::bit_cast<double>(payload) : static_cast<double>(payload);
}

std::string_view Document::text(Node node) const {
  const auto packed = static_cast<std::uint64_t>(items_[node].payload);
  return std::string_view(texts_).substr(packed >> 32, packed & UINT32_MAX);
}

std::string Document::path(Node node) const {
  std::string path;
  for (Node at = kRoot; at != node;) {
    const bool keyed = kind(at) == Kind::object;
    Node child = first(at);
    for (std::size_t index = 0;; ++index) {
      const Node key = child;
      if (keyed) ++child;
      // A key stands for its value.
      if (node < next(child)) {
        path += "/" + (keyed ? printable(text(key), 40) : std::to_string(index));
        at = keyed && node == key ? node : child;
        break;
      }
      child = next(child);
    }
  }
  return path;
}

Error Document::error(Node node, ErrorCode code, const std::string& message) const {
  const std::string where = path(node);
  return {code, where.empty() ? message : where + ": " + message, {file_, line(node)}};
}

bool DocumentBuilder::add(Document::Kind kind, std::int64_t payload, long line) {
  if (error_) return false;
  if (document_.items_.size() >= Document::kMaxNodes)
    return fail(ErrorCode::out_of_range,
                "the file has more than " + std::to_string(Document::kMaxNodes) + " values", line);
  Document::Item item;
  item.payload = payload;
  item.kind = static_cast<std::uint32_t>(kind) & 7u;
  item.line = static_cast<std::uint32_t>(std::clamp(line, 0L, kMaxLine)) & 0x1fffffffu;
  item.next = static_cast<std::uint32_t>(document_.items_.size() + 1);
  document_.items_.push_back(item);
  return true;
}

bool DocumentBuilder::add_text(std::string_view text, long line) {
  // Files, and so all texts together, are shorter than 2^32 bytes.
  const std::uint64_t packed = std::uint64_t{document_.texts_.size()} << 32 | text.size();
  document_.texts_ += text;
  return add(Document::Kind::string, static_cast<std::int64_t>(packed), line);
}

bool DocumentBuilder::open(Document::Kind container, long line) {
  if (open_.size() >= Document::kMaxDepth)
    return fail(ErrorCode::out_of_range,
                "nested deeper than " + std::to_string(Document::kMaxDepth) + " levels", line);
  open_.push_back(static_cast<Document::Node>(document_.items_.size()));
  return add(container, 0, line);
}

void DocumentBuilder::close() {
  document_.items_[open_.back()].next = static_cast<std::uint32_t>(document_.items_.size());
  open_.pop_back();
}

bool DocumentBuilder::fail(ErrorCode code, std::string message, long line) {
  if (!error_) error_ = Error{code, std::move(message), {document_.file(), line}};
  return false;
}

bool Checker::fail(Document::Node node, ErrorCode code, const std::string& message) {
  if (!error_) error_ = document_.error(node, code, message);
  return false;
}

bool Checker::members(Document::Node object, std::span<const Member> wanted) {
  if (document_.kind(object) != Document::Kind::object)
    return fail(object, "expected an object, found " + kind_name(document_.kind(object)));
  for (Document::Node key = document_.first(object); key < document_.next(object);) {
    const Document::Node value = document_.first(key);
    const auto match = std::find_if(wanted.begin(), wanted.end(), [&](const Member& member) {
      return member.name == document_.text(key);
    });
    if (match == wanted.end()) return fail(key, "this key is not known here");
    if (*match->value) return fail(key, "this key is given twice");
    *match->value = value;
    key = document_.next(value);
  }
  for (const Member& member : wanted)
    if (member.required && !*member.value)
      return fail(object, "the key " + in_quotes(member.name) + " is missing");
  return true;
}

bool Checker::array(Document::Node node, std::string_view of_what) {
  if (document_.kind(node) == Document::Kind::array) return true;
  return fail(node, "expected a list of " + std::string(of_what) + ", found " +
                        kind_name(document_.kind(node)));
}

bool Checker::array(Document::Node node, std::string_view of_what, std::size_t size) {
  if (!array(node, of_what)) return false;
  std::size_t found = 0;
  for (auto c = document_.first(node); c < document_.next(node); c = document_.next(c)) ++found;
  if (found == size) return true;
  return fail(node, "expected " + std::to_string(size) + " " + std::string(of_what) + ", found " +
                        std::to_string(found));
}

bool Checker::integer(Document::Node node, std::int64_t min, std::int64_t max,
                      std::int64_t& value) {
  if (document_.kind(node) == Document::Kind::integer) {
    value = document_.integer(node);
    if (min <= value && value <= max) return true;
    return fail(node, ErrorCode::out_of_range,
                std::to_string(value) + " is not between " + std::to_string(min) + " and " +
                    std::to_string(max));
  }
  return fail(node, "expected an integer between " + std::to_string(min) + " and " +
                        std::to_string(max) + ", found " + kind_name(document_.kind(node)));
}

bool Checker::boolean(Document::Node node, bool& value) {
  if (document_.kind(node) != Document::Kind::boolean)
    return fail(node, "expected true or false, found " + kind_name(document_.kind(node)));
  value = document_.boolean(node);
  return true;
}

bool Checker::number(Document::Node node, double& value) {
  const Document::Kind kind = document_.kind(node);
  if (kind != Document::Kind::integer && kind != Document::Kind::real)
    return fail(node, "expected a number, found " + kind_name(kind));
  value = document_.number(node);
  return std::isfinite(value) || fail(node, ErrorCode::out_of_range, "the number is too large");
}

bool Checker::text(Document::Node node, std::string_view& value) {
  if (document_.kind(node) != Document::Kind::string)
    return fail(node, "expected a string, found " + kind_name(document_.kind(node)));
  value = document_.text(node);
  return true;
}

bool Checker::pair(Document::Node node, std::int64_t max, std::int64_t& first,
                   std::int64_t& second) {
  return array(node, "integers", 2) && integer(document_.first(node), 0, max, first) &&
         integer(document_.next(document_.first(node)), 0, max, second);
}

}  // namespace quadrille::text
