// SPDX-License-Identifier: MIT
#include "rolling/visit_order.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "quadrille/core/contract.hpp"

namespace quadrille::discrete {
namespace {

struct Visit {
  VertexId vertex;
  std::uint32_t turn = 0;  // So many others are there before.
};

class Execution {
 public:
  Execution(std::size_t num_vertices, const std::vector<Path>& paths)
      : visits_(paths.size()), at_(paths.size(), 0), present_(num_vertices) {
    std::vector<std::uint32_t> num_visits(num_vertices, 0);
    for (std::size_t t = 0; t < paths.front().size(); ++t)
      for (std::size_t i = 0; i < paths.size(); ++i)
        if (t == 0 || paths[i][t] != paths[i][t - 1])
          visits_[i].push_back({paths[i][t], num_visits[paths[i][t].index()]++});
    for (std::size_t i = 0; i < paths.size(); ++i) enter(i);
  }

  [[nodiscard]] VertexId place(std::size_t agent) const {
    return visits_[agent][at_[agent]].vertex;
  }

  void step(Timestep t, const IsHeld& is_held) {
    states_.assign(visits_.size(), State::unknown);
    for (std::size_t i = 0; i < visits_.size(); ++i)
      if (at_[i] + 1 == visits_[i].size() || is_held(AgentId(i), place(i), t))
        states_[i] = State::stays;
    for (std::size_t i = 0; i < visits_.size(); ++i) decide(static_cast<std::uint32_t>(i));
    for (std::size_t i = 0; i < visits_.size(); ++i)
      if (states_[i] == State::goes) leave(i);
    for (std::size_t i = 0; i < visits_.size(); ++i) {
      if (states_[i] != State::goes) continue;
      ++at_[i];
      enter(i);
    }
  }

 private:
  static constexpr std::uint32_t kNobody = UINT32_MAX;
  enum class State : std::uint8_t { unknown, asked, stays, goes };
  struct Presence {
    std::uint32_t num_over = 0;  // visits
    std::uint32_t agent = kNobody;
  };

  void enter(std::size_t agent) {
    present_[place(agent).index()].agent = static_cast<std::uint32_t>(agent);
  }
  void leave(std::size_t agent) {
    Presence& presence = present_[place(agent).index()];
    ++presence.num_over;
    presence.agent = kNobody;
  }

  /// Each waits for one other at most, whoever closes a circle goes with all of it.
  void decide(std::uint32_t agent) {
    chain_.clear();
    State end = State::goes;
    for (std::uint32_t i = agent;;) {
      if (states_[i] == State::stays || states_[i] == State::goes) {
        end = states_[i];
        break;
      }
      if (states_[i] == State::asked) break;
      states_[i] = State::asked;
      chain_.push_back(i);
      const Visit& next = visits_[i][at_[i] + 1];
      const Presence& presence = present_[next.vertex.index()];
      if (presence.num_over == next.turn) break;
      // Others are to be there before who have not come yet.
      if (presence.num_over + 1 != next.turn || presence.agent == kNobody) {
        end = State::stays;
        break;
      }
      i = presence.agent;
    }
    for (const std::uint32_t i : chain_) states_[i] = end;
  }

  std::vector<std::vector<Visit>> visits_;  // By agent, in order; no two of one vertex in a row.
  std::vector<std::size_t> at_;             // Which of them it is at.
  std::vector<Presence> present_;           // By vertex.
  std::vector<State> states_;
  std::vector<std::uint32_t> chain_;
};

}  // namespace

std::vector<Path> retimed(std::size_t num_vertices, const std::vector<Path>& paths,
                          const IsHeld& is_held) {
  std::vector<Path> result(paths.size());
  if (paths.empty()) return result;
  QUADRILLE_REQUIRE(!paths.front().empty(), "agents are somewhere");
  Execution execution(num_vertices, paths);
  for (std::size_t t = 0;; ++t) {
    for (std::size_t i = 0; i < paths.size(); ++i) result[i].push_back(execution.place(i));
    if (t + 1 == paths.front().size()) return result;
    execution.step(static_cast<Timestep>(t), is_held);
  }
}

}  // namespace quadrille::discrete
