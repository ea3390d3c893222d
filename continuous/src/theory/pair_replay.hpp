// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "model/parked.hpp"
#include "model/shape_pairs.hpp"
#include "paths/bans.hpp"

namespace quadrille::continuous {

/// All that two agents can do, tick by tick: the slow way to find out whether they have a plan,
/// which shares nothing with PairSearch.
class PairReplay {
 public:
  struct Party {
    AgentId agent;
    Ticks bound = 0;               ///< It arrives for good before.
    std::vector<Ban> bans;         ///< That it obeys.
    std::vector<Ticks> rest = {};  ///< By vertex, to the goal; filled in.
  };
  /// `instance` outlives this.
  PairReplay(const Instance& instance, Party first, Party second);

  /// Whether there is a plan of the two; nullopt if that takes more than `max_states` states.
  [[nodiscard]] std::optional<bool> has_plan(std::size_t max_states);

 private:
  enum class Kind : std::uint8_t { stands, moves, parks };
  /// What an agent does at a tick: it stands at a vertex, or moves along an edge for `progress`
  /// ticks, or has parked at its goal for good, where it is no more if it leaves.
  struct State {
    Kind kind = Kind::stands;
    std::uint32_t place = 0;
    Ticks progress = 0;
    friend auto operator<=>(const State&, const State&) = default;
  };
  /// What it does during the next tick, and its state then.
  struct Step {
    State during;  // of a move, `progress` is that at the begin of the tick
    State after;
  };
  [[nodiscard]] std::vector<Step> steps(const Party& party, const State& state, Ticks now) const;
  [[nodiscard]] bool may_be_at(const Party& party, std::uint32_t vertex, Ticks from,
                               Ticks to) const;
  void fill_rest(Party& party) const;
  [[nodiscard]] bool collide(const State& a, const State& b);
  [[nodiscard]] bool may_use(const Party& party, std::uint32_t edge) const;
  [[nodiscard]] Ticks duration(const Party& party, std::uint32_t edge) const;

  const Instance& instance_;
  Party first_, second_;
  ShapePairs bodies_, swapped_;
  ParkedPlaces parked_;
};

}  // namespace quadrille::continuous
