// SPDX-License-Identifier: MIT
#include "campaign/run/plan_text.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cstdint>

#include "campaign/jobs/whole.hpp"

namespace quadrille::cli::campaign {
namespace {

using Json = nlohmann::ordered_json;

struct Motion {
  char letter;
  std::int32_t dx, dy;
};
constexpr Motion kMotions[] = {{'u', 0, -1}, {'d', 0, 1}, {'l', -1, 0}, {'r', 1, 0}, {'w', 0, 0}};

std::optional<discrete::Cell> cell_of(const Json& json) {
  if (!json.is_array() || json.size() != 2) return std::nullopt;
  const auto x = whole<std::int32_t>(json[0]), y = whole<std::int32_t>(json[1]);
  if (!x || !y) return std::nullopt;
  return discrete::Cell{*x, *y};
}

void append_run(std::string& text, char letter, std::int64_t times) {
  if (times > 1) text += std::to_string(times);
  if (times > 0) text += letter;
}

/// Reads a number at the front.
std::optional<std::int64_t> take_number(std::string_view& text) {
  std::int64_t value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc()) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(stop - text.data()));
  return value;
}

bool take(std::string_view& text, char letter) {
  if (!text.starts_with(letter)) return false;
  text.remove_prefix(1);
  return true;
}

}  // namespace

std::optional<std::string> encode_path(const Json& path) {
  if (!path.is_array() || path.empty()) return std::nullopt;
  const auto start = cell_of(path[0]);
  if (!start) return std::nullopt;
  std::string text = fmt::format("{},{} ", start->x, start->y);
  discrete::Cell at = *start;
  char letter = 'w';
  std::int64_t times = 0;
  for (std::size_t t = 1; t < path.size(); ++t) {
    const auto next = cell_of(path[t]);
    if (!next) return std::nullopt;
    const Motion* found = nullptr;
    for (const Motion& motion : kMotions)
      if (std::int64_t{next->x} - at.x == motion.dx && std::int64_t{next->y} - at.y == motion.dy)
        found = &motion;
    if (found == nullptr) return std::nullopt;
    if (found->letter != letter) {
      append_run(text, letter, times);
      letter = found->letter;
      times = 0;
    }
    ++times;
    at = *next;
  }
  append_run(text, letter, times);
  return text;
}

std::optional<discrete::Path> decode_path(const discrete::Graph& graph, std::string_view text) {
  constexpr std::int64_t kLongest = 100'000'000;
  const auto x = take_number(text);
  if (!x || !take(text, ',')) return std::nullopt;
  const auto y = take_number(text);
  if (!y || !take(text, ' ')) return std::nullopt;
  discrete::Cell at{static_cast<std::int32_t>(*x), static_cast<std::int32_t>(*y)};
  discrete::Path path;
  const auto enter = [&] {
    const auto vertex = graph.layout()->vertex_at(at);
    if (vertex) path.push_back(*vertex);
    return vertex.has_value();
  };
  if (!enter()) return std::nullopt;
  while (!text.empty()) {
    const bool counted = text.front() >= '0' && text.front() <= '9';
    const auto times = counted ? take_number(text) : std::optional<std::int64_t>(1);
    const Motion* found = nullptr;
    for (const Motion& motion : kMotions)
      if (text.starts_with(motion.letter)) found = &motion;
    if (!times || *times > kLongest || found == nullptr) return std::nullopt;
    text.remove_prefix(1);
    for (std::int64_t i = 0; i < *times; ++i) {
      at = {at.x + found->dx, at.y + found->dy};
      if (!enter()) return std::nullopt;
    }
  }
  return path;
}

std::optional<Json> encode_plan(const Json& plan) {
  if (!plan.is_array()) return std::nullopt;
  Json paths = Json::array();
  for (const Json& path : plan) {
    auto text = encode_path(path);
    if (!text) return std::nullopt;
    paths.push_back(*std::move(text));
  }
  return paths;
}

}  // namespace quadrille::cli::campaign
