// SPDX-License-Identifier: MIT
#include "timed/cover.hpp"

#include <algorithm>

namespace quadrille_check {
namespace {

__extension__ using Wide = __int128;
constexpr Int kMostFraction = 1 << 20;

}  // namespace

Cover::Range& Cover::range(int agent) {
  const auto [at, is_new] = ranges_.try_emplace(agent);
  if (is_new) at->second.low = free_costs_[static_cast<std::size_t>(agent)];
  return at->second;
}

void Cover::add(std::span<const Int> tree) {
  std::size_t at = 0;
  const auto next = [&] {
    require(at < tree.size(), "a tree that ends too early");
    return tree[at++];
  };
  const Int bound = next(), fraction = next();
  require(bound >= 0 && bound < kNever && fraction > 0 && fraction <= kMostFraction,
          "no such bound");
  struct Branch {
    int agent;
    Int cost;
    Range whole;
    bool is_above;
  };
  std::vector<Branch> branches;
  ranges_.clear();
  do {
    if (next() == 1) {
      const int agent = meanings_.agent(next());
      const Int cost = next();
      Range& part = range(agent);
      branches.push_back({agent, cost, part, false});
      part.high = std::min(part.high, cost);
      continue;
    }
    const Int count = next();
    require(count >= 0 && static_cast<std::uint64_t>(count) <= (tree.size() - at) / 2,
            "a tree that ends too early");
    check_leaf(tree.subspan(at, 2 * static_cast<std::size_t>(count)), bound, fraction);
    at += 2 * static_cast<std::size_t>(count);
    // On to the next part that was left.
    while (!branches.empty() && branches.back().is_above) {
      ranges_[branches.back().agent] = branches.back().whole;
      branches.pop_back();
    }
    if (branches.empty()) break;
    Branch& last = branches.back();
    last.is_above = true;
    ranges_[last.agent] = {std::max(last.whole.low, last.cost), last.whole.high};
  } while (true);
  require(at == tree.size(), "a tree that goes on after its end");
  for (const auto& [agent, part] : ranges_)
    require(counted_.insert(agent).second, "an agent is in two trees");
  require(bound <= kNever - bound_, "no such bound");
  bound_ += bound;
}

// The Lagrangian bound: a core hits some agent, so that all agents together gain at least the sum
// of the multipliers; what they pay is at least that and, for each agent, the least that it pays
// less what it gains.
void Cover::check_leaf(std::span<const Int> multipliers, Int bound, Int fraction) {
  std::map<int, std::map<Int, Wide>> gains;  // by agent, from which cost on
  Wide sum = 0;
  for (std::size_t k = 0; k < multipliers.size(); k += 2) {
    const Int units = multipliers[k + 1];
    require(units >= 0, "a multiplier is negative");
    sum += units;
    for (const Int lit : clauses_[multipliers[k]]) {
      const auto level = meanings_.at_least(lit);
      require(level.has_value(), "a core is about costs");
      static_cast<void>(range(level->first));
      gains[level->first][level->second] += units;
    }
  }
  for (const auto& [agent, part] : ranges_) {
    if (part.low >= part.high) return;  // there are no such costs
    Wide gain = 0;
    const Int free_cost = free_costs_[static_cast<std::size_t>(agent)];
    const auto paid = [&](Int cost) { return static_cast<Wide>(cost - free_cost) * fraction; };
    std::optional<Wide> least;
    const auto offer = [&](Int cost) {
      const Wide offered = paid(cost) - gain;
      least = least ? std::min(*least, offered) : offered;
    };
    for (const auto& [cost, units] : gains[agent]) {
      if (cost >= part.high) break;
      if (cost > part.low && !least) offer(part.low);
      gain += units;
      if (cost > part.low) offer(cost);
    }
    if (!least) offer(part.low);
    sum += *least;
  }
  require(sum > static_cast<Wide>(bound - 1) * fraction, "a leaf of a tree is cheaper");
}

}  // namespace quadrille_check
