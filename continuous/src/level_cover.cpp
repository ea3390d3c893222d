// SPDX-License-Identifier: MIT
#include "level_cover.hpp"

#include <algorithm>
#include <utility>

#include "packing.hpp"
#include "quadrille/core/contract.hpp"

namespace quadrille::continuous {
namespace {

/// Multipliers are rounded down to fractions of a tick, so that many of them lose less than one.
constexpr Cost kFraction = 1024;

bool hits(const IdVector<AgentId, Cost>& costs, const LevelCore& core) {
  return std::any_of(core.begin(), core.end(),
                     [&](const Level& level) { return costs[level.agent] >= level.cost; });
}

/// Whether every solution that hits `a` hits `b`.
bool implies(const LevelCore& a, const LevelCore& b) {
  return std::all_of(a.begin(), a.end(), [&](const Level& level) {
    const auto at = std::lower_bound(b.begin(), b.end(), Level{level.agent, 0});
    return at != b.end() && at->agent == level.agent && at->cost <= level.cost;
  });
}

}  // namespace

/// The linear program of one leaf.
class LevelCover::LeafProgram {
 public:
  LeafProgram(const LevelCover& cover, const Group& group, const Leaf& leaf)
      : cover_(cover), group_(group), leaf_(leaf) {}

  /// `wants_costs`: a solution of the group is made in any case, not only where it comes for free.
  [[nodiscard]] Relaxation solve(bool wants_costs) {
    Relaxation result;
    for (const AgentId i : group_.agents) base_ += low(i) - cover_.free_costs_[i];
    if (!collect()) {
      result.is_empty = true;
      return result;
    }
    make_program();
    const PackingSolution solution = solve_packing(program_);
    result.bound = base_ + certified_bound(solution.primal);
    IdVector<AgentId, Cost> costs = cover_.free_costs_;
    for (const AgentId i : group_.agents) costs[i] = low(i);
    round(solution.dual, result, costs);
    if (wants_costs || !result.branch) {
      cover_.complete(group_.cores, costs);
      result.costs = std::move(costs);
    }
    if (!result.branch && !active_.empty()) result.branch = active_.front().front();
    return result;
  }

 private:
  [[nodiscard]] Cost low(AgentId i) const {
    const auto at = leaf_.low.find(i);
    return at == leaf_.low.end() ? cover_.free_costs_[i] : at->second;
  }

  /// Cores that the low ends do not hit, as far as they are within the leaf. False: one of them
  /// cannot be hit within the leaf.
  bool collect() {
    for (const LevelCore* core : group_.cores) {
      LevelCore rest;
      bool is_hit = false;
      for (const Level& level : *core) {
        is_hit = is_hit || level.cost <= low(level.agent);
        const auto high = leaf_.high.find(level.agent);
        if (high == leaf_.high.end() || level.cost < high->second) rest.push_back(level);
      }
      if (is_hit) continue;
      if (rest.empty()) return false;
      active_.push_back(std::move(rest));
    }
    return true;
  }

  // One row per level: what the cores ask for that the agent hits there or below is at most what
  // the level costs.
  void make_program() {
    for (const LevelCore& core : active_) rows_.insert(rows_.end(), core.begin(), core.end());
    std::sort(rows_.begin(), rows_.end());
    rows_.erase(std::unique(rows_.begin(), rows_.end()), rows_.end());
    for (const Level& row : rows_)
      program_.capacity.push_back(static_cast<double>(row.cost - low(row.agent)));
    for (const LevelCore& core : active_) {
      std::vector<std::size_t> column;
      for (const Level& level : core) {
        auto row = std::lower_bound(rows_.begin(), rows_.end(), level);
        for (; row != rows_.end() && row->agent == level.agent; ++row)
          column.push_back(static_cast<std::size_t>(row - rows_.begin()));
      }
      program_.columns.push_back(std::move(column));
    }
  }

  /// A lower bound on what the agents pay above their low ends, from multipliers of any quality: if
  /// in integers they exceed no row, their sum is one. For each core is hit by some agent, and for
  /// each agent the row of the highest level that it reaches says that the cores it hits ask for
  /// no more than it pays.
  [[nodiscard]] Cost certified_bound(const std::vector<double>& multipliers) const {
    std::vector<Cost> units;
    for (const double u : multipliers)
      units.push_back(u > 0 ? static_cast<Cost>(u * static_cast<double>(kFraction)) : 0);
    std::vector<std::vector<std::size_t>> columns_of(rows_.size());
    for (std::size_t c = 0; c < program_.columns.size(); ++c)
      for (const std::size_t r : program_.columns[c]) columns_of[r].push_back(c);
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      Cost excess = -(rows_[r].cost - low(rows_[r].agent)) * kFraction;
      for (const std::size_t c : columns_of[r]) excess += units[c];
      for (const std::size_t c : columns_of[r]) {
        if (excess <= 0) break;
        const Cost cut = std::min(excess, units[c]);
        units[c] -= cut;
        excess -= cut;
      }
    }
    Cost sum = 0;
    for (const Cost u : units) sum += u;
    return (sum + kFraction - 1) / kFraction;  // costs are integers
  }

  /// Costs near the fractional cover, and the most undecided level.
  void round(const std::vector<double>& dual, Relaxation& result,
             IdVector<AgentId, Cost>& costs) const {
    double best = 0;
    for (std::size_t r = rows_.size(); r-- > 0;) {
      const bool is_top = r + 1 == rows_.size() || rows_[r + 1].agent != rows_[r].agent;
      share_ = (is_top ? 0 : share_) + dual[r];  // how much of the agent is at this level or above
      const double undecided = std::min(share_, 1 - share_);
      const double score = undecided * static_cast<double>(rows_[r].cost - low(rows_[r].agent));
      if (undecided > 1e-6 && score > best) {
        best = score;
        result.branch = rows_[r];
      }
      if (share_ >= 0.5) {
        Cost& cost = costs[rows_[r].agent];
        cost = std::max(cost, rows_[r].cost);
      }
    }
  }

  const LevelCover& cover_;
  const Group& group_;
  const Leaf& leaf_;
  Cost base_ = 0;
  std::vector<LevelCore> active_;
  std::vector<Level> rows_;
  Packing program_;
  mutable double share_ = 0;
};

LevelCover::LevelCover(IdVector<AgentId, Cost> free_costs)
    : free_costs_(std::move(free_costs)), costs_(free_costs_) {
  for (const AgentId i : IdRange<AgentId>(free_costs_.size())) {
    parent_.push_back(i);
    total_ += free_costs_[i];
  }
}

AgentId LevelCover::root(AgentId i) const {
  while (parent_[i] != i) i = parent_[i];
  return i;
}

void LevelCover::add(LevelCore core) {
  std::sort(core.begin(), core.end());
  QUADRILLE_REQUIRE(!core.empty(), "an empty core has no solution");
  for (const Level& level : core) {
    QUADRILLE_REQUIRE(level.cost > free_costs_[level.agent], "free costs hit no core");
    const AgentId a = root(core.front().agent), b = root(level.agent);
    parent_[std::max(a, b)] = std::min(a, b);
  }
  if (std::any_of(cores_.begin(), cores_.end(),
                  [&](const LevelCore& known) { return implies(known, core); }))
    return;
  std::erase_if(cores_, [&](const LevelCore& known) { return implies(core, known); });
  cores_.push_back(std::move(core));
}

std::vector<LevelCover::Group> LevelCover::make_groups() const {
  std::map<AgentId, Group> by_root;
  for (const LevelCore& core : cores_) by_root[root(core.front().agent)].cores.push_back(&core);
  for (const AgentId i : IdRange<AgentId>(free_costs_.size()))
    if (const auto at = by_root.find(root(i)); at != by_root.end()) at->second.agents.push_back(i);
  std::vector<Group> groups;
  for (auto& [id, group] : by_root) groups.push_back(std::move(group));
  return groups;
}

bool LevelCover::solve(LimitMonitor& limits) {
  std::vector<Group> groups = make_groups();
  // A tree of a group serves any group that contains it: others' cores and costs only add to its
  // bounds. Of several, the one with the most work in it is kept.
  for (Group& group : groups) {
    for (const Group& old : groups_)
      if (root(old.agents.front()) == root(group.agents.front()) &&
          old.open.size() > group.open.size())
        group.open = old.open;
    if (group.open.empty()) group.open.push_back({});
    group.best = costs_;
    complete(group.cores, group.best);
  }
  bool is_complete = true;
  for (Group& group : groups) is_complete = is_complete && solve(group, limits);
  groups_ = std::move(groups);
  if (!is_complete) return false;
  for (const Group& group : groups_)
    for (const AgentId i : group.agents) costs_[i] = group.best[i];
  total_ = 0;
  for (const Cost cost : costs_) total_ += cost;
  return true;
}

// Best first. Leaves are never dropped because of a good solution: later cores may exclude it.
bool LevelCover::solve(Group& group, LimitMonitor& limits) {
  const auto is_later = [](const Leaf& a, const Leaf& b) { return a.bound > b.bound; };
  const auto push = [&](Leaf leaf) {
    group.open.push_back(std::move(leaf));
    std::push_heap(group.open.begin(), group.open.end(), is_later);
  };
  const auto price = [&](const IdVector<AgentId, Cost>& costs) {
    Cost sum = 0;
    for (const AgentId i : group.agents) sum += costs[i] - free_costs_[i];
    return sum;
  };
  group.cost = price(group.best);
  while (true) {
    QUADRILLE_REQUIRE(!group.open.empty(), "raising every level hits all cores");
    if (group.open.front().bound >= group.cost) return true;
    if (limits.exhausted()) return false;
    std::pop_heap(group.open.begin(), group.open.end(), is_later);
    Leaf leaf = std::move(group.open.back());
    group.open.pop_back();
    constexpr std::int64_t kProgramsPerCompletion = 16;
    const bool wants_costs = num_programs_++ % kProgramsPerCompletion == 0;
    const Relaxation relaxation = LeafProgram(*this, group, leaf).solve(wants_costs);
    if (relaxation.is_empty) continue;
    if (relaxation.costs) {
      if (const Cost cost = price(*relaxation.costs); cost < group.cost) {
        group.cost = cost;
        group.best = *relaxation.costs;
      }
    }
    leaf.bound = std::max(leaf.bound, relaxation.bound);
    if (leaf.bound >= group.cost || !relaxation.branch ||
        (!group.open.empty() && leaf.bound > group.open.front().bound)) {
      push(std::move(leaf));
      continue;
    }
    Leaf below = leaf;
    below.high[relaxation.branch->agent] = relaxation.branch->cost;
    leaf.low[relaxation.branch->agent] = relaxation.branch->cost;
    push(std::move(below));
    push(std::move(leaf));
  }
}

void LevelCover::complete(const Cores& cores, IdVector<AgentId, Cost>& costs) const {
  Cores open;
  for (const LevelCore* core : cores)
    if (!hits(costs, *core)) open.push_back(core);
  std::vector<AgentId> raised;
  while (!open.empty()) {
    std::map<Level, int> uses;
    for (const LevelCore* core : open)
      for (const Level& level : *core) ++uses[level];
    // The most cores for the price; a level serves the cores of lower levels of its agent too.
    const Level* best = nullptr;
    double best_score = 0;
    AgentId last;
    int below = 0;
    for (const auto& [level, count] : uses) {
      below = (level.agent == last ? below : 0) + count;
      last = level.agent;
      const double score = below / static_cast<double>(level.cost - costs[level.agent]);
      if (best == nullptr || score > best_score) {
        best = &level;
        best_score = score;
      }
    }
    costs[best->agent] = best->cost;
    std::erase_if(open, [&](const LevelCore* core) { return hits(costs, *core); });
  }
  // Dearest first; each goes down to the lowest level that the cores still allow.
  std::vector<AgentId> order;
  for (const AgentId i : IdRange<AgentId>(costs.size()))
    if (costs[i] > free_costs_[i]) order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](AgentId a, AgentId b) {
    return costs[a] - free_costs_[a] > costs[b] - free_costs_[b];
  });
  for (const AgentId i : order) {
    const Cost before = costs[i];
    Cost needed = free_costs_[i];
    bool has_level = false;
    for (const LevelCore* core : cores) {
      Cost own = 0;
      bool by_others = false;
      for (const Level& level : *core) {
        if (level.agent == i)
          own = level.cost;
        else
          by_others = by_others || costs[level.agent] >= level.cost;
      }
      has_level = has_level || own > 0;
      if (own > 0 && own <= before && !by_others) needed = std::max(needed, own);
    }
    // Agents of other groups are none of our business.
    if (has_level) costs[i] = needed;
  }
}

IdVector<AgentId, Cost> LevelCover::quick_costs() const {
  IdVector<AgentId, Cost> costs = costs_;
  Cores cores;
  for (const LevelCore& core : cores_) cores.push_back(&core);
  complete(cores, costs);
  return costs;
}

}  // namespace quadrille::continuous
