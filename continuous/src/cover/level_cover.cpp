// SPDX-License-Identifier: MIT
#include "cover/level_cover.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "quadrille/core/contract.hpp"

namespace quadrille::continuous {
namespace {

/// Linear programs between two solutions that are made of one.
constexpr std::int64_t kProgramsPerCompletion = 16;

/// Whether every solution that hits `a` hits `b`.
bool implies(const LevelCore& a, const LevelCore& b) {
  return std::all_of(a.begin(), a.end(), [&](const Level& level) {
    const auto at = std::lower_bound(b.begin(), b.end(), Level{level.agent, 0});
    return at != b.end() && at->agent == level.agent && at->cost <= level.cost;
  });
}

}  // namespace

LevelCover::LevelCover(IdVector<AgentId, Cost> free_costs)
    : free_costs_(std::move(free_costs)),
      grouping_(free_costs_.size()),
      costs_(free_costs_),
      program_(free_costs_) {
  for (const Cost free_cost : free_costs_) total_ += free_cost;
}

AgentId LevelCover::root(AgentId i) const { return AgentId(grouping_.root(i.index())); }

void LevelCover::add(LevelCore core) {
  std::sort(core.begin(), core.end());
  QUADRILLE_REQUIRE(!core.empty(), "an empty core has no solution");
  for (const Level& level : core) {
    QUADRILLE_REQUIRE(level.cost > free_costs_[level.agent], "free costs hit no core");
    grouping_.join(core.front().agent.index(), level.agent.index());
  }
  if (std::any_of(cores_.begin(), cores_.end(),
                  [&](const KnownCore& known) { return implies(known.levels, core); }))
    return;
  std::erase_if(cores_, [&](const KnownCore& known) { return implies(core, known.levels); });
  cores_.push_back({std::move(core), next_number_++});
}

std::vector<LevelCover::Group> LevelCover::make_groups() const {
  std::map<AgentId, Group> by_root;
  for (const KnownCore& core : cores_) {
    Group& group = by_root[root(core.levels.front().agent)];
    group.cores.push_back(&core.levels);
    group.numbers.push_back(core.number);
  }
  for (const AgentId i : IdRange<AgentId>(free_costs_.size()))
    if (const auto at = by_root.find(root(i)); at != by_root.end()) at->second.agents.push_back(i);
  std::vector<Group> groups;
  for (auto& [id, group] : by_root) groups.push_back(std::move(group));
  return groups;
}

bool LevelCover::solve(LimitMonitor& limits, Effort most_effort) {
  std::vector<Group> groups = make_groups();
  // A tree of a group serves any group that contains it: others' cores and costs only add to its
  // bounds. Of several, the one with the most work in it is kept.
  for (Group& group : groups) {
    for (Group& old : groups_) {
      if (root(old.agents.front()) != root(group.agents.front())) continue;
      group.sums.insert(group.sums.end(), old.sums.begin(), old.sums.end());
      if (old.open.size() > group.open.size()) group.open = std::move(old.open);
    }
    if (group.open.empty()) group.open.emplace_back();
    group.table = CoreTable(group.cores);
    group.best = costs_;
    group.table.complete(free_costs_, group.best);
  }
  bool is_complete = true;
  for (Group& group : groups) is_complete = is_complete && solve(group, limits, most_effort);
  groups_ = std::move(groups);
  if (!is_complete) return false;
  total_ = 0;
  for (const Cost cost : free_costs_) total_ += cost;
  is_exact_ = true;
  proved_.clear();
  for (const Group& group : groups_) {
    proved_.push_back({group.table, group.bound()});
    for (const AgentId i : group.agents) costs_[i] = group.best[i];
    total_ += group.bound();
    is_exact_ = is_exact_ && group.bound() == group.cost;
  }
  return true;
}

Cost LevelCover::price(const Group& group, const IdVector<AgentId, Cost>& costs) const {
  Cost sum = 0;
  for (const AgentId i : group.agents) sum += costs[i] - free_costs_[i];
  return sum;
}

// Best first. Leaves are never dropped because of a good solution: later cores may exclude it.
bool LevelCover::solve(Group& group, LimitMonitor& limits, Effort most_effort) {
  const auto is_later = [](const CoverLeaf& a, const CoverLeaf& b) { return a.bound > b.bound; };
  const auto push = [&](CoverLeaf leaf) {
    group.open.push_back(std::move(leaf));
    std::push_heap(group.open.begin(), group.open.end(), is_later);
  };
  program_.set_cores(group.table, group.numbers);
  program_.set_sums(group.sums);
  group.cost = price(group, group.best);
  const Effort last = effort() + most_effort;
  while (true) {
    QUADRILLE_REQUIRE(!group.open.empty(), "raising every level hits all cores");
    if (group.open.front().bound >= group.cost || effort() >= last) return true;
    if (limits.exhausted()) return false;
    std::pop_heap(group.open.begin(), group.open.end(), is_later);
    CoverLeaf leaf = std::move(group.open.back());
    group.open.pop_back();
    if (!program_.is_known(leaf) && !relax(group, leaf)) continue;
    if (leaf.bound >= group.cost || !leaf.branch ||
        (!group.open.empty() && leaf.bound > group.open.front().bound)) {
      push(std::move(leaf));
      continue;
    }
    auto [below, above] = split(std::move(leaf));
    push(std::move(below));
    push(std::move(above));
  }
}

bool LevelCover::relax(Group& group, CoverLeaf& leaf) {
  const bool wants_costs = num_programs_++ % kProgramsPerCompletion == 0;
  IdVector<AgentId, Cost> costs;
  if (!program_.solve(leaf, costs)) return false;
  if (wants_costs || program_.is_integral()) {
    group.table.complete(free_costs_, costs);
    if (const Cost cost = price(group, costs); cost < group.cost) {
      group.cost = cost;
      group.best = std::move(costs);
    }
  }
  if (leaf.bound < group.cost) program_.refine(leaf, group.cost);
  return true;
}

std::vector<CoverShare> LevelCover::shares() const {
  std::vector<CoverShare> shares;
  for (const Group& group : make_groups()) {
    const AgentId at = root(group.agents.front());
    Cost bound = 0;
    // Groups of the last solve that have become one were independent then: their bounds add up.
    for (const Group& old : groups_)
      if (root(old.agents.front()) == at) bound += old.bound();
    for (CoverShare& share : share_out(free_costs_, group.cores, bound))
      shares.push_back(std::move(share));
  }
  return shares;
}

std::vector<ProvedCover> LevelCover::proved() const {
  std::vector<ProvedCover> proved;
  for (const auto& [table, bound] : proved_) {
    if (bound == 0) continue;
    ProvedCover& cover = proved.emplace_back();
    cover.bound = bound;
    for (std::size_t c = 0; c < table.num_cores(); ++c) {
      LevelCore& core = cover.cores.emplace_back();
      for (const std::uint32_t r : table.rows_of(c)) core.push_back(table.rows()[r]);
    }
  }
  return proved;
}

IdVector<AgentId, Cost> LevelCover::completed(IdVector<AgentId, Cost> costs) const {
  std::vector<const LevelCore*> cores;
  for (const KnownCore& core : cores_) cores.push_back(&core.levels);
  CoreTable(cores).complete(free_costs_, costs);
  return costs;
}

}  // namespace quadrille::continuous
