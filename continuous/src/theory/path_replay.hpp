// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <vector>

#include "paths/bans.hpp"

namespace quadrille::continuous {

/// Derives lemmas about the paths of one agent again: by code of its own, which shares nothing with
/// PathFinder.
class PathReplay {
 public:
  /// `bans` are all that the agent obeys. All arguments outlive the object.
  PathReplay(const Instance& instance, AgentId agent, const std::vector<Ban>& bans);

  /// Whether the agent has a path that arrives before `bound` and breaks none of the bans.
  [[nodiscard]] bool has_path(Ticks bound);

 private:
  struct SafeStay {
    Ticks from, until;  // both included
    Ticks arrival = kForever;
  };
  /// The agent comes to a vertex at any one of these ticks, both included, and goes on at once.
  struct Passing {
    Ticks first, last;
  };
  /// Where the agent can be, and when it can go on.
  struct Place {
    VertexId vertex;
    std::size_t stay;
    Ticks first, last;
  };

  [[nodiscard]] std::vector<SafeStay> safe_stays(VertexId v) const;
  /// The first start at `tick` or later that no ban forbids.
  [[nodiscard]] Ticks next_start(EdgeId e, Ticks tick) const;
  /// The last start of those from `tick` on, which is allowed, before one that is not.
  [[nodiscard]] Ticks last_start(EdgeId e, Ticks tick) const;
  void take(const Place& from, EdgeId e);
  void reach(VertexId v, std::size_t stay, Ticks arrival);
  void pass(VertexId v, Passing passing);

  const Instance& instance_;
  const Agent& agent_;
  const AgentId id_;
  const std::vector<Ban>& bans_;
  IdVector<VertexId, std::vector<SafeStay>> stays_;
  IdVector<VertexId, std::vector<Passing>> passings_;
  std::deque<Place> queue_;
  Ticks bound_ = kForever;
  Ticks constant_from_ = 0;  // from then on bans hold for ever, or not at all
};

}  // namespace quadrille::continuous
