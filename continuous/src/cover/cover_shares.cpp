// SPDX-License-Identifier: MIT
#include "cover/cover_shares.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "cover/packing.hpp"

namespace quadrille::continuous {
namespace {

using Columns = std::vector<std::vector<std::uint32_t>>;

/// By core the rows of its levels and of higher ones of the same agents. As in LeafProgram: what
/// the cores ask for that an agent hits at a level or below is at most what the level costs.
Columns columns_of(const CoreTable& table) {
  const std::vector<Level>& rows = table.rows();
  Columns columns(table.num_cores());
  for (std::size_t c = 0; c < columns.size(); ++c)
    for (const std::uint32_t first : table.rows_of(c))
      for (auto r = first; r < rows.size() && rows[r].agent == rows[first].agent; ++r)
        columns[c].push_back(r);
  return columns;
}

/// Whole multipliers near those of the solution that exceed no row; then more, as far as there is
/// room.
std::vector<Cost> round_down(const IdVector<AgentId, Cost>& free_costs, const CoreTable& table) {
  std::vector<Cost> room;
  for (const Level& row : table.rows()) room.push_back(row.cost - free_costs[row.agent]);
  Cost largest = 1;
  for (const Cost cost : room) largest = std::max(largest, cost);
  Packing packing(static_cast<double>(largest));
  for (const Cost cost : room) static_cast<void>(packing.add_row(static_cast<double>(cost), {}));
  const Columns columns = columns_of(table);
  for (const auto& rows : columns) static_cast<void>(packing.add_column(rows, 1));
  packing.solve();
  std::vector<Cost> units(columns.size(), 0);
  const auto add = [&](std::size_t core, Cost wanted) {
    for (const std::uint32_t r : columns[core]) wanted = std::min(wanted, room[r]);
    for (const std::uint32_t r : columns[core]) room[r] -= wanted;
    units[core] += wanted;
  };
  const std::vector<double> primal = packing.primal();
  for (std::size_t c = 0; c < units.size(); ++c)
    if (primal[c] > 0) add(c, static_cast<Cost>(primal[c]));
  for (std::size_t c = 0; c < units.size(); ++c) add(c, std::numeric_limits<Cost>::max());
  return units;
}

}  // namespace

std::vector<CoverShare> share_out(const IdVector<AgentId, Cost>& free_costs,
                                  std::span<const LevelCore* const> cores, Cost bound) {
  const CoreTable table(cores);
  const std::vector<Cost> units = round_down(free_costs, table);
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
