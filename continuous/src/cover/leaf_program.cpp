// SPDX-License-Identifier: MIT
#include "cover/leaf_program.hpp"

#include <algorithm>
#include <utility>

namespace quadrille::continuous {
namespace {

/// Multipliers are rounded down to fractions of a tick, so that many of them lose less than one.
constexpr Cost kFraction = 1024;
constexpr double kTiny = 1e-6;
/// Sums are looked for where there are more programs than so many, at each so many, and until there
/// are so many. Measured on the cores of six hard instances, 600 to 900 of each: 0.1 to 0.66 of the
/// programs, and 0.22 (`dense`, task 4) to 1.4 times the time; with up to 200 sums there are fewer
/// programs, and these take longer.
constexpr int kProgramsBeforeSums = 20;
constexpr std::size_t kSumsPerProgram = 3, kMostSums = 100;

}  // namespace

LeafProgram::LeafProgram(const IdVector<AgentId, Cost>& free_costs)
    : free_costs_(free_costs),
      low_(free_costs),
      high_(free_costs.size(), CoverLeaf::Range().high) {}

void LeafProgram::set_cores(const CoreTable& table) {
  table_ = &table;
  sums_ = nullptr;
}

void LeafProgram::set_sums(std::vector<CoverSum>& sums) {
  const std::vector<Level>& levels = table_->rows();
  std::erase_if(sums, [&](const CoverSum& known) {
    return !known.was_used ||
           !std::all_of(known.sum.levels.begin(), known.sum.levels.end(), [&](const Level& level) {
             return std::binary_search(levels.begin(), levels.end(), level);
           });
  });
  sums_ = &sums;
  sum_rows_.clear();
  sum_begins_.assign(1, 0);
  for (CoverSum& known : sums) {
    list_rows(known.sum);
    known.was_used = false;
  }
  num_solved_ = 0;
}

void LeafProgram::list_rows(const LevelSum& sum) {
  const std::vector<Level>& levels = table_->rows();
  for (const Level& level : sum.levels)
    sum_rows_.push_back(static_cast<std::uint32_t>(
        std::lower_bound(levels.begin(), levels.end(), level) - levels.begin()));
  sum_begins_.push_back(sum_rows_.size());
}

std::span<const std::uint32_t> LeafProgram::rows_of(std::size_t c) const {
  if (c < table_->num_cores()) return table_->rows_of(c);
  const std::size_t k = c - table_->num_cores();
  return {sum_rows_.data() + sum_begins_[k], sum_rows_.data() + sum_begins_[k + 1]};
}

int LeafProgram::least(std::size_t c) const {
  return c < table_->num_cores() ? 1 : (*sums_)[c - table_->num_cores()].sum.least;
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
  for (std::size_t c = 0; c < num_all(); ++c)
    if (covered(rows_of(c)) < least(c) - kTiny) return false;
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
  begin_program();
  solve_program();
  if (sums_ != nullptr && ++num_solved_ > kProgramsBeforeSums && sums_->size() < kMostSums &&
      add_sums())
    solve_program();
  const std::vector<double> primal = program_.primal();
  note_uses(primal);
  list_columns();
  leaf.bound = std::max(leaf.bound, base + certified_bound(primal));
  costs = low_;
  round(program_.dual(), leaf, costs);
  return true;
}

/// The chosen cores, and as many more as have a say.
void LeafProgram::solve_program() {
  const std::int64_t before = program_.effort();
  do {
    extend_program();
    program_.solve();
    effort_ += static_cast<std::int64_t>(active_.size());
  } while (choose_violated(program_.dual()));
  effort_ += program_.effort() - before;
}

void LeafProgram::note_uses(const std::vector<double>& multipliers) {
  for (std::size_t k = 0; k < multipliers.size(); ++k)
    if (const std::size_t c = active_numbers_[chosen_[k]];
        c >= table_->num_cores() && multipliers[k] > kTiny)
      (*sums_)[c - table_->num_cores()].was_used = true;
}

/// False: a core cannot be hit within the leaf.
bool LeafProgram::collect() {
  active_.clear();
  active_begins_.assign(1, 0);
  active_least_.clear();
  active_numbers_.clear();
  for (std::size_t c = 0; c < num_all(); ++c)
    if (!activate(c)) return false;
  return true;
}

/// False: that cannot be satisfied within the leaf.
bool LeafProgram::activate(std::size_t c) {
  const std::vector<Level>& levels = table_->rows();
  int missing = least(c);
  for (const std::uint32_t r : rows_of(c))
    if (levels[r].cost <= low_[levels[r].agent]) --missing;
  if (missing <= 0) return true;
  for (const std::uint32_t r : rows_of(c))
    if (levels[r].cost > low_[levels[r].agent] && levels[r].cost < high_[levels[r].agent])
      active_.push_back(r);
  if (active_.size() < active_begins_.back() + static_cast<std::size_t>(missing)) {
    active_.resize(active_begins_.back());
    return false;
  }
  active_begins_.push_back(active_.size());
  active_least_.push_back(missing);
  active_numbers_.push_back(c);
  return true;
}

/// Sums that the fractional cover does not satisfy, in the program, too. False: none were found.
bool LeafProgram::add_sums() {
  const std::vector<Level>& levels = table_->rows();
  for (std::size_t r = 0; r < levels.size(); ++r) {
    const AgentId i = levels[r].agent;
    if (levels[r].cost <= low_[i]) part_[r] = 1;
    if (levels[r].cost >= high_[i]) part_[r] = 0;
  }
  HalfSums finder(levels, part_);
  for (const std::size_t c : chosen_)
    finder.add({rows_of(active_numbers_[c]), least(active_numbers_[c])});
  const std::vector<LevelSum> found = finder.find(kSumsPerProgram);
  effort_ += finder.effort();
  const std::size_t before = chosen_.size();
  for (const LevelSum& sum : found) {
    if (std::any_of(sums_->begin(), sums_->end(), [&](const auto& k) { return k.sum == sum; }))
      continue;
    sums_->push_back({sum, false});
    list_rows(sum);
    const std::size_t num_active = active_numbers_.size();
    // Where it cannot be satisfied the cores cannot be hit: that is left to the leaf's parts.
    if (!activate(num_all() - 1) || active_numbers_.size() == num_active) continue;
    is_chosen_.push_back(1);
    chosen_.push_back(num_active);
  }
  return chosen_.size() > before;
}

// Most cores have no say in the optimum: the program has those that the last fractional cover,
// which may be that of a larger leaf, does not cover or only just; then those that its own does
// not cover, until it covers all. The optimum is that of the program with all of them.
void LeafProgram::choose_tight(const CoverLeaf& leaf) {
  find_parts(leaf);
  chosen_.clear();
  is_chosen_.assign(active_begins_.size() - 1, 0);
  choose_below(kTiny);
}

/// False: the fractional cover of the program, with these shares by row, covers all active cores.
bool LeafProgram::choose_violated(const std::vector<double>& dual) {
  const std::vector<Level>& levels = table_->rows();
  part_.assign(levels.size(), 0);
  for (std::size_t r = levels.size(); r-- > 0;) {
    if (r + 1 < levels.size() && levels[r + 1].agent == levels[r].agent) part_[r] = part_[r + 1];
    if (number_[r] != kNoRow) part_[r] += dual[number_[r]];
  }
  return choose_below(-kTiny);
}

bool LeafProgram::choose_below(double excess) {
  const std::size_t before = chosen_.size();
  for (std::size_t c = 0; c < is_chosen_.size(); ++c) {
    if (is_chosen_[c] != 0 || covered(active_rows(c)) >= active_least_[c] + excess) continue;
    is_chosen_[c] = 1;
    chosen_.push_back(c);
  }
  return chosen_.size() > before;
}

/// Without rows and columns.
void LeafProgram::begin_program() {
  Cost largest = 1;
  for (const std::uint32_t r : active_) largest = std::max(largest, room(table_->rows()[r]));
  program_ = Packing(static_cast<double>(largest));
  number_.assign(table_->rows().size(), kNoRow);
  rows_.clear();
}

// One row per level: what the cores ask for that the agent hits there or below is at most what
// the level costs. A row that comes later is kept by the columns before: those in it are in the
// row of the next lower level, too, which costs less.
void LeafProgram::extend_program() {
  const std::size_t before = program_.num_columns();
  for (std::size_t k = before; k < chosen_.size(); ++k)
    for (const std::uint32_t r : active_rows(chosen_[k]))
      if (number_[r] == kNoRow) add_row(r);
  for (std::size_t k = before; k < chosen_.size(); ++k) {
    listed_.clear();
    list_rows(chosen_[k], listed_);
    static_cast<void>(program_.add_column(listed_, active_least_[chosen_[k]]));
  }
}

void LeafProgram::add_row(std::uint32_t row) {
  const Level& level = table_->rows()[row];
  listed_.clear();
  for (std::size_t k = 0; k < program_.num_columns(); ++k)
    for (const std::uint32_t r : active_rows(chosen_[k]))
      if (r <= row && table_->rows()[r].agent == level.agent)
        listed_.push_back(static_cast<std::uint32_t>(k));
  number_[row] = program_.add_row(static_cast<double>(room(level)), listed_);
  rows_.push_back(row);
}

/// The rows of the program that an active core is in, as often as it is.
void LeafProgram::list_rows(std::size_t active, std::vector<std::uint32_t>& rows) const {
  const std::vector<Level>& levels = table_->rows();
  for (const std::uint32_t first : active_rows(active))
    for (auto r = first; r < levels.size() && levels[r].agent == levels[first].agent; ++r)
      if (number_[r] != kNoRow) rows.push_back(number_[r]);
}

void LeafProgram::list_columns() {
  columns_.clear();
  column_begins_.assign(1, 0);
  for (std::size_t k = 0; k < program_.num_columns(); ++k) {
    list_rows(chosen_[k], columns_);
    column_begins_.push_back(columns_.size());
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
    for (const std::uint32_t r : column(c)) used_[r] += units_[c];
  // What a row is asked for too much is cut from the columns as they come.
  Cost sum = 0;
  for (std::size_t c = 0; c < units_.size(); ++c) {
    Cost cut = 0;
    for (const std::uint32_t r : column(c))
      cut = std::max(cut, used_[r] - room(table_->rows()[rows_[r]]) * kFraction);
    cut = std::min(cut, units_[c]);
    if (cut > 0)
      for (const std::uint32_t r : column(c)) used_[r] -= cut;
    sum += (units_[c] - cut) * active_least_[chosen_[c]];
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
  const std::vector<Level>& levels = table_->rows();
  double best = 0, share = 0;
  for (std::size_t r = levels.size(); r-- > 0;) {
    const Level& row = levels[r];
    if (r + 1 == levels.size() || levels[r + 1].agent != row.agent) share = 0;
    if (number_[r] == kNoRow) continue;
    share += dual[number_[r]];  // how much of the agent is at this level or above
    if (share > 0) leaf.shares.push_back({row, share});
    const double undecided = std::min(share, 1 - share);
    const double score = undecided * static_cast<double>(room(row));
    if (undecided > kTiny && score > best) {
      best = score;
      leaf.branch = row;
      is_integral_ = false;
    }
    if (share >= 0.5) costs[row.agent] = std::max(costs[row.agent], row.cost);
  }
}

}  // namespace quadrille::continuous
