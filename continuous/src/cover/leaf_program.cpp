// SPDX-License-Identifier: MIT
#include "cover/leaf_program.hpp"

#include <algorithm>

namespace quadrille::continuous {
namespace {

/// Multipliers are rounded down to fractions of a tick, so that many of them lose less than one.
constexpr Cost kFraction = 1024;
constexpr double kTiny = 1e-6;

}  // namespace

LeafProgram::LeafProgram(const IdVector<AgentId, Cost>& free_costs)
    : free_costs_(free_costs),
      low_(free_costs),
      high_(free_costs.size(), CoverLeaf::Range().high) {}

void LeafProgram::set_cores(const CoreTable& table) {
  table_ = &table;
  number_.assign(table.rows().size(), kNoRow);
}

void LeafProgram::load(const CoverLeaf& leaf) {
  for (const CoverLeaf::Range& range : leaf.ranges) {
    low_[range.agent] = std::max(low_[range.agent], range.low);
    high_[range.agent] = range.high;
  }
}

void LeafProgram::unload(const CoverLeaf& leaf) {
  for (const CoverLeaf::Range& range : leaf.ranges) {
    low_[range.agent] = free_costs_[range.agent];
    high_[range.agent] = CoverLeaf::Range().high;
  }
}

bool LeafProgram::is_known(const CoverLeaf& leaf) {
  if (!leaf.branch) return false;
  load(leaf);
  find_parts(leaf);
  unload(leaf);
  for (std::size_t c = 0; c < table_->num_cores(); ++c)
    if (covered(table_->rows_of(c)) < 1 - kTiny) return false;
  return true;
}

/// Of the leaf's fractional cover, in the leaf at work.
void LeafProgram::find_parts(const CoverLeaf& leaf) {
  const std::vector<Level>& levels = table_->rows();
  part_.assign(levels.size(), 0);
  auto share = leaf.shares.begin();
  double part = 0;
  for (std::size_t r = levels.size(); r-- > 0;) {
    const Level& level = levels[r];
    if (r + 1 == levels.size() || levels[r + 1].agent != level.agent) part = 0;
    for (; share != leaf.shares.end() && share->level >= level; ++share)
      part = share->level.agent == level.agent ? share->part : 0;
    part_[r] = level.cost <= low_[level.agent] ? 1 : level.cost < high_[level.agent] ? part : 0;
  }
}

double LeafProgram::covered(std::span<const std::uint32_t> rows) const {
  double covered = 0;
  for (const std::uint32_t r : rows) covered += part_[r];
  return covered;
}

bool LeafProgram::solve(CoverLeaf& leaf, IdVector<AgentId, Cost>& costs) {
  load(leaf);
  const bool has_solution = solve_loaded(leaf, costs);
  unload(leaf);
  return has_solution;
}

bool LeafProgram::solve_loaded(CoverLeaf& leaf, IdVector<AgentId, Cost>& costs) {
  Cost base = 0;
  for (const CoverLeaf::Range& range : leaf.ranges)
    base += low_[range.agent] - free_costs_[range.agent];
  if (!collect()) return false;
  choose_tight(leaf);
  PackingSolution solution;
  do {
    make_program();
    solution = solve_packing(program_);
    effort_ += solution.effort + static_cast<std::int64_t>(active_.size());
  } while (choose_violated(solution.dual));
  leaf.bound = std::max(leaf.bound, base + certified_bound(solution.primal));
  costs = low_;
  round(solution.dual, leaf, costs);
  return true;
}

/// False: a core cannot be hit within the leaf.
bool LeafProgram::collect() {
  const std::vector<Level>& levels = table_->rows();
  active_.clear();
  active_begins_.assign(1, 0);
  for (std::size_t c = 0; c < table_->num_cores(); ++c) {
    const auto rows = table_->rows_of(c);
    if (std::any_of(rows.begin(), rows.end(),
                    [&](std::uint32_t r) { return levels[r].cost <= low_[levels[r].agent]; }))
      continue;
    for (const std::uint32_t r : rows)
      if (levels[r].cost < high_[levels[r].agent]) active_.push_back(r);
    if (active_.size() == active_begins_.back()) return false;
    active_begins_.push_back(active_.size());
  }
  return true;
}

// Most cores have no say in the optimum: the program has those that the last fractional cover,
// which may be that of a larger leaf, does not cover or only just; then those that its own does
// not cover, until it covers all. The optimum is that of the program with all of them.
void LeafProgram::choose_tight(const CoverLeaf& leaf) {
  find_parts(leaf);
  chosen_.clear();
  is_chosen_.assign(active_begins_.size() - 1, 0);
  choose_below(1 + kTiny);
}

/// False: the fractional cover of the program, with these shares by row, covers all active cores.
bool LeafProgram::choose_violated(const std::vector<double>& dual) {
  const std::vector<Level>& levels = table_->rows();
  part_.assign(levels.size(), 0);
  std::size_t row = rows_.size();
  for (std::size_t r = levels.size(); r-- > 0;) {
    if (r + 1 < levels.size() && levels[r + 1].agent == levels[r].agent) part_[r] = part_[r + 1];
    for (; row > 0 && rows_[row - 1] >= levels[r]; --row) part_[r] += dual[row - 1];
  }
  return choose_below(1 - kTiny);
}

bool LeafProgram::choose_below(double part) {
  const std::size_t before = chosen_.size();
  for (std::size_t c = 0; c < is_chosen_.size(); ++c) {
    if (is_chosen_[c] != 0 || covered(active_rows(c)) >= part) continue;
    is_chosen_[c] = 1;
    chosen_.push_back(c);
  }
  return chosen_.size() > before;
}

// One row per level: what the cores ask for that the agent hits there or below is at most what
// the level costs.
void LeafProgram::make_program() {
  const std::vector<Level>& levels = table_->rows();
  number_.assign(levels.size(), kNoRow);
  for (const std::size_t c : chosen_)
    for (const std::uint32_t r : active_rows(c)) number_[r] = 0;
  rows_.clear();
  program_.capacity.clear();
  for (std::size_t r = 0; r < levels.size(); ++r) {
    if (number_[r] == kNoRow) continue;
    number_[r] = static_cast<std::uint32_t>(rows_.size());
    rows_.push_back(levels[r]);
    program_.capacity.push_back(static_cast<double>(levels[r].cost - low_[levels[r].agent]));
  }
  program_.column_begins.assign(1, 0);
  program_.column_rows.clear();
  for (const std::size_t c : chosen_) {
    for (const std::uint32_t r : active_rows(c))
      for (auto row = number_[r]; row < rows_.size() && rows_[row].agent == levels[r].agent; ++row)
        program_.column_rows.push_back(row);
    program_.column_begins.push_back(program_.column_rows.size());
  }
}

/// A lower bound on what the agents pay above their low ends, from multipliers of any quality: if
/// in integers they exceed no row, their sum is one. For each core is hit by some agent, and for
/// each agent the row of the highest level that it reaches says that the cores it hits ask for
/// no more than it pays.
Cost LeafProgram::certified_bound(const std::vector<double>& multipliers) {
  units_.clear();
  for (const double u : multipliers)
    units_.push_back(u > 0 ? static_cast<Cost>(u * static_cast<double>(kFraction)) : 0);
  used_.assign(rows_.size(), 0);
  for (std::size_t c = 0; c < units_.size(); ++c)
    for (const std::uint32_t r : program_.rows_of(c)) used_[r] += units_[c];
  // What a row is asked for too much is cut from the columns as they come.
  Cost sum = 0;
  for (std::size_t c = 0; c < units_.size(); ++c) {
    Cost cut = 0;
    for (const std::uint32_t r : program_.rows_of(c))
      cut = std::max(cut, used_[r] - (rows_[r].cost - low_[rows_[r].agent]) * kFraction);
    cut = std::min(cut, units_[c]);
    if (cut > 0)
      for (const std::uint32_t r : program_.rows_of(c)) used_[r] -= cut;
    sum += units_[c] - cut;
  }
  return (sum + kFraction - 1) / kFraction;  // costs are integers
}

/// Costs near the fractional cover, and the most undecided level.
void LeafProgram::round(const std::vector<double>& dual, CoverLeaf& leaf,
                        IdVector<AgentId, Cost>& costs) {
  leaf.branch.reset();
  if (!active_.empty()) leaf.branch = table_->rows()[active_.front()];
  is_integral_ = true;
  leaf.shares.clear();
  double best = 0, share = 0;
  for (std::size_t r = rows_.size(); r-- > 0;) {
    const Level& row = rows_[r];
    const bool is_top = r + 1 == rows_.size() || rows_[r + 1].agent != row.agent;
    share = (is_top ? 0 : share) + dual[r];  // how much of the agent is at this level or above
    if (share > 0) leaf.shares.push_back({row, share});
    const double undecided = std::min(share, 1 - share);
    const double score = undecided * static_cast<double>(row.cost - low_[row.agent]);
    if (undecided > kTiny && score > best) {
      best = score;
      leaf.branch = row;
      is_integral_ = false;
    }
    if (share >= 0.5) costs[row.agent] = std::max(costs[row.agent], row.cost);
  }
}

}  // namespace quadrille::continuous
