// SPDX-License-Identifier: MIT
#include "cover/core_table.hpp"

#include <algorithm>

namespace quadrille::continuous {

CoreTable::CoreTable(std::span<const LevelCore* const> cores) : row_begins_{0} {
  for (const LevelCore* core : cores) rows_.insert(rows_.end(), core->begin(), core->end());
  std::sort(rows_.begin(), rows_.end());
  rows_.erase(std::unique(rows_.begin(), rows_.end()), rows_.end());
  core_begins_.assign(rows_.size() + 1, 0);
  for (const LevelCore* core : cores) {
    for (const Level& level : *core) {
      const auto at = std::lower_bound(rows_.begin(), rows_.end(), level);
      core_rows_.push_back(static_cast<std::uint32_t>(at - rows_.begin()));
      ++core_begins_[core_rows_.back() + 1];
    }
    row_begins_.push_back(core_rows_.size());
  }
  for (std::size_t r = 0; r < rows_.size(); ++r) core_begins_[r + 1] += core_begins_[r];
  row_cores_.resize(core_rows_.size());
  std::vector<std::size_t> next = core_begins_;
  for (std::size_t c = 0; c < cores.size(); ++c)
    for (const std::uint32_t r : rows_of(c)) row_cores_[next[r]++] = static_cast<std::uint32_t>(c);
}

void CoreTable::complete(const IdVector<AgentId, Cost>& free_costs,
                         IdVector<AgentId, Cost>& costs) const {
  std::vector<char> is_open(num_cores(), 0);
  std::vector<int> open_cores_of(rows_.size(), 0);
  std::size_t num_open = 0;
  for (std::size_t c = 0; c < num_cores(); ++c) {
    const auto rows = rows_of(c);
    if (std::any_of(rows.begin(), rows.end(),
                    [&](std::uint32_t r) { return costs[rows_[r].agent] >= rows_[r].cost; }))
      continue;
    is_open[c] = 1;
    ++num_open;
    for (const std::uint32_t r : rows) ++open_cores_of[r];
  }
  while (num_open > 0) {
    const std::size_t best = best_row(open_cores_of, costs);
    const AgentId agent = rows_[best].agent;
    costs[agent] = rows_[best].cost;
    for (std::size_t r = best + 1; r-- > 0 && rows_[r].agent == agent;)
      for (const std::uint32_t c : cores_of(r)) {
        if (is_open[c] == 0) continue;
        is_open[c] = 0;
        --num_open;
        for (const std::uint32_t of_core : rows_of(c)) --open_cores_of[of_core];
      }
  }
  lower(free_costs, costs);
}

// A level serves the cores of lower levels of its agent too.
std::size_t CoreTable::best_row(const std::vector<int>& open_cores_of,
                                const IdVector<AgentId, Cost>& costs) const {
  std::size_t best = rows_.size();
  double best_score = 0;
  int below = 0;
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    if (r > 0 && rows_[r].agent != rows_[r - 1].agent) below = 0;
    if (open_cores_of[r] == 0) continue;
    below += open_cores_of[r];
    const double score = below / static_cast<double>(rows_[r].cost - costs[rows_[r].agent]);
    if (best == rows_.size() || score > best_score) {
      best = r;
      best_score = score;
    }
  }
  return best;
}

// Dearest first; each goes down to the lowest level that the cores still allow.
void CoreTable::lower(const IdVector<AgentId, Cost>& free_costs,
                      IdVector<AgentId, Cost>& costs) const {
  struct Rows {
    std::size_t begin, end;
  };
  std::vector<Rows> order;  // of the agents
  std::vector<int> hits(num_cores(), 0);
  for (std::size_t begin = 0, end = 0; begin < rows_.size(); begin = end) {
    const AgentId i = rows_[begin].agent;
    for (end = begin; end < rows_.size() && rows_[end].agent == i; ++end)
      if (rows_[end].cost <= costs[i])
        for (const std::uint32_t c : cores_of(end)) ++hits[c];
    if (costs[i] > free_costs[i]) order.push_back({begin, end});
  }
  const auto price = [&](const Rows& rows) {
    const AgentId i = rows_[rows.begin].agent;
    return costs[i] - free_costs[i];
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](const Rows& a, const Rows& b) { return price(a) > price(b); });
  for (const Rows& rows : order) {
    Cost& cost = costs[rows_[rows.begin].agent];
    std::size_t end = rows.begin;  // of the rows that it reaches
    while (end < rows.end && rows_[end].cost <= cost) ++end;
    const auto is_needed = [&](std::size_t r) {
      const auto cores = cores_of(r);
      return std::any_of(cores.begin(), cores.end(), [&](std::uint32_t c) { return hits[c] == 1; });
    };
    for (; end > rows.begin && !is_needed(end - 1); --end)
      for (const std::uint32_t c : cores_of(end - 1)) --hits[c];
    cost = end > rows.begin ? rows_[end - 1].cost : free_costs[rows_[rows.begin].agent];
  }
}

}  // namespace quadrille::continuous
