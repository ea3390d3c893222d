// SPDX-License-Identifier: MIT
#pragma once

#include "quadrille/core/contract.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/discrete/solver.hpp"
#include "quadrille/sat/lemma.hpp"

namespace quadrille::discrete {

/// What the resource numbers of the discrete domain mean. Two usages of different agents collide
/// when both are the same vertex at the same timestep, when both are moves over one edge in
/// opposite directions at the same timestep, or when one is a vertex at t and the other a rest
/// there from t or earlier on, or when both end at the same vertex.
enum class UsageKind : std::uint8_t {
  end = 0,     ///< Resting in `vertex` in the end.
  vertex = 1,  ///< Being in `vertex` at `timestep`.
  move = 2,    ///< Leaving `vertex` for `to` at `timestep`.
  rest = 3,    ///< Being in `vertex` from `timestep` on, for ever.
};

struct DecodedUsage {
  UsageKind kind = UsageKind::vertex;
  VertexId vertex, to;
  Timestep timestep = 0;
  friend bool operator==(const DecodedUsage&, const DecodedUsage&) = default;
};

// Packed as kind (2 bits), timestep (20), vertex (21), to (21). The solver refuses graphs beyond
// that, and MddPaths paths.
static_assert(kMaxMddVertices <= std::size_t{1} << 21);
inline constexpr Timestep kMaxTimestep = (1 << 20) - 1;

[[nodiscard]] constexpr std::uint64_t encode_usage(const DecodedUsage& u) {
  QUADRILLE_REQUIRE(u.timestep >= 0 && u.timestep <= kMaxTimestep &&
                        u.vertex.index() < kMaxMddVertices && u.to.index() < kMaxMddVertices,
                    "a usage fits its number");
  return static_cast<std::uint64_t>(u.kind) << 62 | static_cast<std::uint64_t>(u.timestep) << 42 |
         static_cast<std::uint64_t>(u.vertex.value()) << 21 |
         static_cast<std::uint64_t>(u.to.value());
}
[[nodiscard]] constexpr DecodedUsage decode_usage(std::uint64_t resource) {
  constexpr std::uint64_t kVertexMask = kMaxMddVertices - 1;
  return {static_cast<UsageKind>(resource >> 62), VertexId(resource >> 21 & kVertexMask),
          VertexId(resource & kVertexMask),
          static_cast<Timestep>(resource >> 42 & static_cast<std::uint64_t>(kMaxTimestep))};
}

[[nodiscard]] constexpr sat::Usage vertex_usage(AgentId agent, VertexId v, Timestep t) {
  return {agent, encode_usage({UsageKind::vertex, v, VertexId(), t})};
}
[[nodiscard]] constexpr sat::Usage move_usage(AgentId agent, VertexId from, VertexId to,
                                              Timestep t) {
  return {agent, encode_usage({UsageKind::move, from, to, t})};
}
[[nodiscard]] constexpr sat::Usage end_usage(AgentId agent, VertexId v) {
  return {agent, encode_usage({UsageKind::end, v, VertexId(), 0})};
}
[[nodiscard]] constexpr sat::Usage rest_usage(AgentId agent, VertexId v, Timestep t) {
  return {agent, encode_usage({UsageKind::rest, v, VertexId(), t})};
}

}  // namespace quadrille::discrete
