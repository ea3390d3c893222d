// SPDX-License-Identifier: MIT
#include "cover/cover_shares.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "cover/packing.hpp"

namespace quadrille::continuous {
namespace {

/// As in LeafProgram: what the cores ask for that an agent hits at a level or below is at most what
/// the level costs.
Packing packing_of(const IdVector<AgentId, Cost>& free_costs, const CoreTable& table) {
  const std::vector<Level>& rows = table.rows();
  Packing packing;
  for (const Level& row : rows)
    packing.capacity.push_back(static_cast<double>(row.cost - free_costs[row.agent]));
  packing.column_begins.assign(1, 0);
  for (std::size_t c = 0; c < table.num_cores(); ++c) {
    for (const std::uint32_t first : table.rows_of(c))
      for (auto r = first; r < rows.size() && rows[r].agent == rows[first].agent; ++r)
        packing.column_rows.push_back(r);
    packing.column_begins.push_back(packing.column_rows.size());
  }
  return packing;
}

/// Whole multipliers near those of the solution that exceed no row; then more, as far as there is
/// room.
std::vector<Cost> round_down(const IdVector<AgentId, Cost>& free_costs, const CoreTable& table,
                             const Packing& packing) {
  const PackingSolution solution = solve_packing(packing);
  std::vector<Cost> room;
  for (const Level& row : table.rows()) room.push_back(row.cost - free_costs[row.agent]);
  std::vector<Cost> units(table.num_cores(), 0);
  const auto add = [&](std::size_t core, Cost wanted) {
    for (const std::uint32_t r : packing.rows_of(core)) wanted = std::min(wanted, room[r]);
    for (const std::uint32_t r : packing.rows_of(core)) room[r] -= wanted;
    units[core] += wanted;
  };
  for (std::size_t c = 0; c < units.size(); ++c)
    if (solution.primal[c] > 0) add(c, static_cast<Cost>(solution.primal[c]));
  for (std::size_t c = 0; c < units.size(); ++c) add(c, std::numeric_limits<Cost>::max());
  return units;
}

}  // namespace

std::vector<CoverShare> share_out(const IdVector<AgentId, Cost>& free_costs,
                                  std::span<const LevelCore* const> cores, Cost bound) {
  const CoreTable table(cores);
  const std::vector<Cost> units = round_down(free_costs, table, packing_of(free_costs, table));
  std::vector<CoverShare> shares;
  std::vector<AgentId> all;
  for (std::size_t c = 0; c < units.size(); ++c) {
    std::vector<AgentId> agents;
    for (const Level& level : *cores[c]) agents.push_back(level.agent);
    all.insert(all.end(), agents.begin(), agents.end());
    if (units[c] > 0) shares.push_back({units[c], std::move(agents), true});
    bound -= units[c];
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  if (bound > 0) shares.push_back({bound, std::move(all), false});
  return shares;
}

}  // namespace quadrille::continuous
