// SPDX-License-Identifier: MIT
#include "quadrille/execution/releaser.hpp"

#include <algorithm>

#include "quadrille/core/contract.hpp"
#include "quadrille/execution/node_order.hpp"

namespace quadrille::execution {

Releaser::Releaser(const Precedences& order)
    : followers_(order.num_agents()),
      released_(order.num_agents(), 0),
      ended_(order.num_agents(), 0),
      is_news_(order.num_agents(), false),
      cycle_(node_order(order).cycle) {
  for (const auto& moves : order.moves)
    gates_.push_back(std::vector<std::vector<Gate>>(moves.size()));
  for (const Precedence& p : order.list) {
    gates_[p.follower.agent][order.entry(p.follower).move].push_back(
        {p.leader.agent, p.leader.move + 1});
    followers_[p.leader.agent].push_back(p.follower.agent);
  }
  for (auto& followers : followers_) {
    std::sort(followers.begin(), followers.end());
    followers.erase(std::unique(followers.begin(), followers.end()), followers.end());
  }
  for (const AgentId agent : IdRange<AgentId>(order.num_agents())) advance(agent);
}

void Releaser::advance(AgentId agent) {
  const auto& moves = gates_[agent];
  std::uint32_t& released = released_[agent];
  const auto is_open = [&](const Gate& gate) { return ended_[gate.leader] >= gate.needed; };
  while (released < moves.size() &&
         std::all_of(moves[released].begin(), moves[released].end(), is_open)) {
    ++released;
    is_news_[agent] = true;
  }
}

void Releaser::end_moves(AgentId agent, std::uint32_t count) {
  QUADRILLE_REQUIRE(count >= ended_[agent] && count <= released_[agent],
                    "moves end in order, once they have been released");
  if (count == ended_[agent]) return;
  ended_[agent] = count;
  for (const AgentId follower : followers_[agent]) advance(follower);
}

std::vector<AgentId> Releaser::take_news() {
  std::vector<AgentId> news;
  for (const AgentId agent : IdRange<AgentId>(is_news_.size()))
    if (is_news_[agent]) news.push_back(agent);
  is_news_.assign(is_news_.size(), false);
  return news;
}

}  // namespace quadrille::execution
