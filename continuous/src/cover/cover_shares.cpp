// SPDX-License-Identifier: MIT
#include "cover/cover_shares.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "cover/level_simplex.hpp"

namespace quadrille::continuous {
namespace {

/// Whole multipliers of the cores near those of the linear program of all costs, see LevelSimplex,
/// that keep to its rows; then more, as far as there is room.
std::vector<Cost> round_down(const IdVector<AgentId, Cost>& free_costs, const CoreTable& table) {
  const std::vector<Level>& levels = table.rows();
  LevelSimplex simplex(free_costs);
  simplex.set_levels(levels);
  for (std::size_t c = 0; c < table.num_cores(); ++c)
    static_cast<void>(simplex.add_column(table.rows_of(c), 1));
  simplex.begin(free_costs,
                IdVector<AgentId, Cost>(free_costs.size(), std::numeric_limits<Cost>::max()));
  simplex.solve();
  std::vector<Cost> room;
  for (const Level& level : levels) room.push_back(level.cost - free_costs[level.agent]);
  std::vector<Cost> units(table.num_cores(), 0);
  const auto add = [&](std::size_t core, Cost wanted) {
    // What a core asks for counts at its level and at the agent's higher ones, see LevelSimplex.
    std::vector<std::size_t> rows;
    for (const std::size_t first : table.rows_of(core))
      for (std::size_t r = first; r < levels.size() && levels[r].agent == levels[first].agent; ++r)
        rows.push_back(r);
    for (const std::size_t r : rows) wanted = std::min(wanted, room[r]);
    for (const std::size_t r : rows) room[r] -= wanted;
    units[core] += wanted;
  };
  const std::vector<double> multipliers = simplex.multipliers();
  for (std::size_t k = 0; k < multipliers.size(); ++k)
    if (multipliers[k] > 0)
      add(simplex.basis().columns[k] - simplex.num_lows(), static_cast<Cost>(multipliers[k]));
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
