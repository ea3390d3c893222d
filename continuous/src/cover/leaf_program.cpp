// SPDX-License-Identifier: MIT
#include "cover/leaf_program.hpp"

#include <algorithm>
#include <utility>

namespace quadrille::continuous {
namespace {

constexpr double kTiny = 1e-6;
/// What doubles may be wrong by in the value of a linear program, as a part of it.
constexpr double kPromise = 1e-9;
/// Of the multipliers, what a refined linear program is about: much more than doubles are wrong by.
constexpr Cost kMarginPart = 1 << 20;
constexpr int kMostRounds = 3;
/// Sums are looked for after kProgramsBeforeSums programs, kSumsPerProgram of them at each, until
/// there are kMostSums. Measured on the cores of six hard instances, 600 to 900 of each: 0.1 to
/// 0.66 of the programs; up to 300 sums take 1.09 times the time, up to 150 as long.
constexpr int kProgramsBeforeSums = 20;
constexpr std::size_t kSumsPerProgram = 3, kMostSums = 200;
/// A sum that is of use in none of this number of calls goes.
constexpr int kCallsPerUse = 4;
constexpr double kMostExcess = 1e-6;
constexpr std::uint32_t kNone = LevelSimplex::kGone;
/// Of the kernels that leaves keep, the oldest ones are given up: 32 MB.
constexpr std::size_t kMostCells = 1 << 22;

}  // namespace

std::pair<CoverLeaf, CoverLeaf> split(CoverLeaf leaf) {
  const Level level = *leaf.branch;
  leaf.branch.reset();
  auto range = std::lower_bound(leaf.ranges.begin(), leaf.ranges.end(), level.agent,
                                [](const auto& r, AgentId i) { return r.agent < i; });
  if (range == leaf.ranges.end() || range->agent != level.agent)
    range = leaf.ranges.insert(range, {level.agent});
  CoverLeaf below = leaf;
  below.ranges[static_cast<std::size_t>(range - leaf.ranges.begin())].high = level.cost;
  range->low = level.cost;
  return {std::move(below), std::move(leaf)};
}

LeafProgram::LeafProgram(const IdVector<AgentId, Cost>& free_costs)
    : free_costs_(free_costs),
      low_(free_costs),
      high_(free_costs.size(), CoverLeaf::Range().high),
      simplex_(free_costs),
      certificate_(simplex_) {}

void LeafProgram::set_cores(const CoreTable& table, std::span<const std::uint32_t> numbers) {
  table_ = &table;
  sums_ = nullptr;
  simplex_.set_levels(table.rows());
  columns_.clear();
  numbers_.clear();
  const std::uint32_t next = next_core_;
  for (std::size_t c = 0; c < table.num_cores(); ++c) {
    const std::uint32_t column = simplex_.add_column(table.rows_of(c), 1);
    const auto number = numbers.empty() ? next + static_cast<std::uint32_t>(c) : numbers[c];
    numbers_.push_back(number);
    columns_.resize(number + 1, kNone);
    columns_[number] = column;
    next_core_ = number + 1;
  }
}

void LeafProgram::set_sums(std::vector<CoverSum>& sums) {
  const std::vector<Level>& levels = table_->rows();
  const bool is_due = num_set_++ % kCallsPerUse == 0;
  std::erase_if(sums, [&](const CoverSum& known) {
    return (is_due && !known.was_used) ||
           !std::all_of(known.sum.levels.begin(), known.sum.levels.end(), [&](const Level& level) {
             return std::binary_search(levels.begin(), levels.end(), level);
           });
  });
  sums_ = &sums;
  for (CoverSum& known : sums) {
    list_rows(known.sum);
    if (is_due) known.was_used = false;
  }
  num_solved_ = 0;
}

/// And makes them a column.
void LeafProgram::list_rows(const LevelSum& sum) {
  const std::vector<Level>& levels = table_->rows();
  listed_.clear();
  for (const Level& level : sum.levels)
    listed_.push_back(static_cast<std::uint32_t>(
        std::lower_bound(levels.begin(), levels.end(), level) - levels.begin()));
  static_cast<void>(simplex_.add_column(listed_, sum.least));
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
  for (std::size_t c = 0; c < simplex_.num_columns(); ++c)
    if (covered(c) < simplex_.least(c) - kTiny) return false;
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

double LeafProgram::covered(std::size_t column) const {
  double covered = 0;
  for (const std::uint32_t r : simplex_.rows_of(column)) covered += part_[r];
  return covered;
}

bool LeafProgram::solve(CoverLeaf& leaf, IdVector<AgentId, Cost>& costs) {
  load(leaf);
  const bool has_solution = solve_loaded(leaf, costs);
  unload(leaf);
  return has_solution;
}

bool LeafProgram::solve_loaded(CoverLeaf& leaf, IdVector<AgentId, Cost>& costs) {
  simplex_.begin(low_, high_);
  if (!has_levels()) return false;
  Cost low_ends = 0;
  for (const CoverLeaf::Range& range : leaf.ranges)
    low_ends += low_[range.agent] - free_costs_[range.agent];
  base_ = low_ends;
  for (const LevelSimplex::Line& line : simplex_.lines())
    base_ -= low_[line.agent] - free_costs_[line.agent];
  restore(leaf);
  simplex_.solve();
  if (sums_ != nullptr && ++num_solved_ > kProgramsBeforeSums && sums_->size() < kMostSums &&
      add_sums())
    simplex_.solve();
  const std::vector<double> multipliers = simplex_.multipliers();
  note_uses(multipliers);
  promised_ = static_cast<double>(base_) + simplex_.value(multipliers);
  // Where the low ends hit all cores, they are the bound, to the tick.
  leaf.bound = std::max({leaf.bound, low_ends, base_ + certified_bound(multipliers)});
  leaf.solution = remember(multipliers);
  costs = low_;
  round(leaf, costs);
  return true;
}

/// False: a core or sum cannot be satisfied within the leaf.
bool LeafProgram::has_levels() const {
  for (std::size_t c = 0; c < simplex_.num_columns(); ++c) {
    int missing = simplex_.least(c);
    for (const std::uint32_t r : simplex_.rows_of(c)) {
      if (missing == 0) break;
      if (r < simplex_.lines()[simplex_.line_of(r)].last) --missing;
    }
    if (missing > 0) return false;
  }
  return true;
}

void LeafProgram::restore(const CoverLeaf& leaf) {
  if (leaf.solution == nullptr) return;
  const CoverLeaf::Solution& solution = *leaf.solution;
  LevelSimplex::Basis basis;
  std::vector<double> multipliers;
  for (const CoverLeaf::Solution::Column& column : solution.columns) {
    basis.columns.push_back(column_of(column));
    multipliers.push_back(column.multiplier);
  }
  for (const Level& level : solution.rows) basis.rows.push_back(row_of(level));
  simplex_.restore(basis, multipliers, solution.kernel.size() > 0 ? &solution.kernel : nullptr);
}

/// `kNone`: it is gone.
std::uint32_t LeafProgram::column_of(const CoverLeaf::Solution::Column& column) const {
  using Kind = CoverLeaf::Solution::Kind;
  if (column.kind == Kind::low_end) {
    const std::size_t line = simplex_.line_of(AgentId(column.number));
    return line < simplex_.lines().size() && simplex_.lines()[line].is_raised
               ? static_cast<std::uint32_t>(line)
               : kNone;
  }
  if (column.kind == Kind::core) {
    const bool is_known = column.number < columns_.size() && columns_[column.number] != kNone;
    return is_known ? simplex_.num_lows() + columns_[column.number] : kNone;
  }
  if (sums_ == nullptr) return kNone;
  const auto sum = std::find_if(sums_->begin(), sums_->end(), [&](const CoverSum& known) {
    return known.number == column.number;
  });
  if (sum == sums_->end()) return kNone;
  return static_cast<std::uint32_t>(simplex_.num_lows() + table_->num_cores() +
                                    static_cast<std::size_t>(sum - sums_->begin()));
}

/// `kNone`: it is gone.
std::uint32_t LeafProgram::row_of(const Level& level) const {
  const std::vector<Level>& levels = table_->rows();
  const std::size_t k = simplex_.line_of(level.agent);
  if (k == simplex_.lines().size()) return kNone;
  const LevelSimplex::Line& line = simplex_.lines()[k];
  if (line.is_raised && line.low == level.cost) return simplex_.low_row(k);
  const auto end = levels.begin() + line.end;
  const auto at = std::lower_bound(levels.begin() + line.begin, end, level);
  return at != end && *at == level ? static_cast<std::uint32_t>(at - levels.begin()) : kNone;
}

std::shared_ptr<const CoverLeaf::Solution> LeafProgram::remember(
    const std::vector<double>& multipliers) {
  using Kind = CoverLeaf::Solution::Kind;
  auto solution = std::make_shared<CoverLeaf::Solution>();
  const LevelSimplex::Basis& basis = simplex_.basis();
  for (std::size_t i = 0; i < basis.columns.size(); ++i) {
    const double multiplier = std::max(multipliers[i], 0.0);
    const std::uint32_t c = basis.columns[i];
    if (c < simplex_.num_lows()) {
      const auto agent = static_cast<std::uint32_t>(simplex_.lines()[c].agent.value());
      solution->columns.push_back({Kind::low_end, agent, multiplier});
    } else if (const std::size_t k = c - simplex_.num_lows(); k < table_->num_cores()) {
      solution->columns.push_back({Kind::core, numbers_[k], multiplier});
    } else {
      const std::uint32_t sum = (*sums_)[k - table_->num_cores()].number;
      solution->columns.push_back({Kind::sum, sum, multiplier});
    }
  }
  for (const std::uint32_t r : basis.rows) {
    if (r < table_->rows().size()) {
      solution->rows.push_back(table_->rows()[r]);
    } else {
      const LevelSimplex::Line& line = simplex_.lines()[r - table_->rows().size()];
      solution->rows.push_back({line.agent, line.low});
    }
  }
  keep_kernel(solution);
  return solution;
}

void LeafProgram::keep_kernel(const std::shared_ptr<CoverLeaf::Solution>& solution) {
  solution->kernel.copy(simplex_.kernel());
  with_kernel_.push_back({solution, simplex_.kernel().size() * simplex_.kernel().size()});
  num_cells_ += with_kernel_.back().num_cells;
  while (num_cells_ > kMostCells) {
    if (const auto oldest = with_kernel_.front().solution.lock()) oldest->kernel = Kernel();
    num_cells_ -= with_kernel_.front().num_cells;
    with_kernel_.pop_front();
  }
}

void LeafProgram::note_uses(const std::vector<double>& multipliers) {
  const std::size_t first = simplex_.num_lows() + table_->num_cores();
  for (std::size_t k = 0; k < multipliers.size(); ++k)
    if (const std::size_t c = simplex_.basis().columns[k]; c >= first && multipliers[k] > kTiny)
      (*sums_)[c - first].was_used = true;
}

/// Sums that the fractional cover does not satisfy, in the program, too. False: none were found.
bool LeafProgram::add_sums() {
  const std::vector<double>& parts = simplex_.parts();
  HalfSums finder(table_->rows(), parts);
  for (std::size_t c = 0; c < simplex_.num_columns(); ++c)
    if (simplex_.excess(simplex_.num_lows() + static_cast<std::uint32_t>(c)) < kMostExcess)
      finder.add({simplex_.rows_of(c), simplex_.least(c)});
  const std::vector<LevelSum> found = finder.find(kSumsPerProgram);
  effort_ += finder.effort();
  bool is_more = false;
  for (const LevelSum& sum : found) {
    if (std::any_of(sums_->begin(), sums_->end(), [&](const auto& k) { return k.sum == sum; }))
      continue;
    sums_->push_back({sum, false, next_sum_++});
    list_rows(sum);
    // Where it cannot be satisfied the cores cannot be hit: that is left to the leaf's parts.
    is_more = true;
  }
  return is_more;
}

std::vector<std::pair<std::size_t, Cost>> LeafProgram::core_units() const {
  std::vector<std::pair<std::size_t, Cost>> units;
  for (std::size_t c = 0; c < table_->num_cores(); ++c)
    if (const Cost own = certificate_.units(simplex_.num_lows() + static_cast<std::uint32_t>(c));
        own > 0)
      units.emplace_back(c, own);
  return units;
}

Cost LeafProgram::certified_bound(const std::vector<double>& multipliers) {
  certificate_.clear();
  certificate_.add(simplex_.basis().columns, multipliers, LeafCertificate::kFraction);
  return certificate_.bound();
}

// A linear program of what is left (Gleixner, Steffy and Wolter, "Iterative refinement for linear
// programming", INFORMS Journal on Computing 2016): the numbers are a millionth as large, and so is
// what doubles lose of them.
void LeafProgram::refine(CoverLeaf& leaf, Cost wanted) {
  if (promised_ * (1 + kPromise) <= static_cast<double>(wanted - 1)) return;
  Cost margin = certificate_.largest() / kMarginPart + LeafCertificate::kFraction;
  for (int round = 0; round < kMostRounds && leaf.bound < wanted; ++round) {
    const LevelSimplex::Basis basis = simplex_.basis();
    Kernel kernel;
    kernel.copy(simplex_.kernel());
    const LeafCertificate::Rest rest = certificate_.take_off(margin, basis.columns);
    simplex_.set_rooms(rest.rooms);
    simplex_.restore(basis, rest.multipliers, &kernel);
    simplex_.solve();
    certificate_.add(simplex_.basis().columns, simplex_.multipliers(), 1);
    leaf.bound = std::max(leaf.bound, base_ + certificate_.bound());
    margin = margin / kMarginPart + LeafCertificate::kFraction;
  }
}

/// Costs near the fractional cover, and the most undecided level.
void LeafProgram::round(CoverLeaf& leaf, IdVector<AgentId, Cost>& costs) {
  leaf.branch.reset();
  leaf.shares.clear();
  const std::vector<Level>& levels = table_->rows();
  double best = 0;
  const auto lines = simplex_.lines();
  for (std::size_t k = lines.size(); k-- > 0;)
    for (std::uint32_t r = lines[k].last; r-- > lines[k].first;) {
      if (!simplex_.is_tight(r)) continue;
      const Level& row = levels[r];
      const double share = simplex_.parts()[r];
      if (share > 0) leaf.shares.push_back({row, share});
      const double undecided = std::min(share, 1 - share);
      const double score = undecided * static_cast<double>(row.cost - low_[row.agent]);
      if (undecided > kTiny && score > best) {
        best = score;
        leaf.branch = row;
      }
      if (share >= 0.5) costs[row.agent] = std::max(costs[row.agent], row.cost);
    }
  is_integral_ = !leaf.branch;
  if (is_integral_) leaf.branch = open_level();
}

/// A level of the leaf of a core that the low ends do not hit.
std::optional<Level> LeafProgram::open_level() const {
  const std::vector<Level>& levels = table_->rows();
  for (std::size_t c = 0; c < table_->num_cores(); ++c) {
    std::optional<Level> level;
    bool is_hit = false;
    for (const std::uint32_t r : table_->rows_of(c)) {
      const LevelSimplex::Line& line = simplex_.lines()[simplex_.line_of(r)];
      if (r < line.first) is_hit = true;
      if (r < line.last && !level) level = levels[r];
    }
    if (!is_hit) return level;
  }
  return std::nullopt;
}

}  // namespace quadrille::continuous
