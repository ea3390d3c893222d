// SPDX-License-Identifier: MIT
#include "quadrille/sat/lemma.hpp"

#include <array>

namespace quadrille::sat {

std::string_view to_string(const Why& why) noexcept {
  // In the order of the types.
  constexpr std::array<std::string_view, std::variant_size_v<Why>> kNames = {
      "path", "explicit path", "vertex", "edge",    "goal", "rectangle", "corridor", "moves",
      "stay", "pair",          "order",  "ceiling", "rest", "taken",     "counter",  "core"};
  return kNames[why.index()];
}

namespace {

struct IsCollision {
  bool operator()(const why::Vertex&) const { return true; }
  bool operator()(const why::Edge&) const { return true; }
  bool operator()(const why::Goal&) const { return true; }
  bool operator()(const why::Rectangle&) const { return true; }
  bool operator()(const why::Corridor&) const { return true; }
  bool operator()(const why::Moves&) const { return true; }
  bool operator()(const why::Stay&) const { return true; }
  bool operator()(const why::Pair&) const { return true; }
  bool operator()(const why::Path&) const { return false; }
  bool operator()(const why::ExplicitPath&) const { return false; }
  bool operator()(const why::Order&) const { return false; }
  bool operator()(const why::Ceiling&) const { return false; }
  bool operator()(const why::Rest&) const { return false; }
  bool operator()(const why::Taken&) const { return false; }
  bool operator()(const why::Counter&) const { return false; }
  bool operator()(const why::Core&) const { return false; }
};

}  // namespace

bool is_collision(const Why& why) noexcept { return std::visit(IsCollision(), why); }

}  // namespace quadrille::sat
