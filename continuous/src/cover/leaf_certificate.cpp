// SPDX-License-Identifier: MIT
#include "cover/leaf_certificate.hpp"

#include <algorithm>

namespace quadrille::continuous {
namespace {

/// Room in a row beyond kMostRoom times what is taken off all columns is of no use.
constexpr Cost kMostRoom = 4;

}  // namespace

void LeafCertificate::clear() {
  columns_.clear();
  units_.assign(simplex_.num_lows() + simplex_.num_columns(), 0);
}

void LeafCertificate::add(std::span<const std::uint32_t> columns,
                          const std::vector<double>& multipliers, Cost factor) {
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const double units = multipliers[k] * static_cast<double>(factor);
    if (!(units >= 1)) continue;
    Cost& known = units_[columns[k]];
    if (known == 0) columns_.push_back(columns[k]);
    known += static_cast<Cost>(units);
  }
}

/// Visits the rows of the leaf that a column is in, as often as it is.
template <class Visit>
void LeafCertificate::visit_rows(std::uint32_t column, const Visit& visit) const {
  const auto lines = simplex_.lines();
  if (column < simplex_.num_lows()) {
    visit(simplex_.low_row(column));
    for (std::uint32_t r = lines[column].first; r < lines[column].last; ++r) visit(r);
    return;
  }
  for (const std::uint32_t level : simplex_.rows_of(column - simplex_.num_lows())) {
    const std::size_t at = simplex_.line_of(level);
    const LevelSimplex::Line& line = lines[at];
    if (level < line.first && line.is_raised) visit(simplex_.low_row(at));
    for (std::uint32_t r = std::max(level, line.first); r < line.last; ++r) visit(r);
  }
}

/// What the rows of the leaf are asked for. Says whether it is too much of one.
bool LeafCertificate::find_used() {
  used_.assign(simplex_.num_rows(), 0);
  for (const std::uint32_t column : columns_) {
    if (column < simplex_.num_lows())
      used_[simplex_.low_row(column)] += units_[column];
    else
      for (const std::uint32_t r : simplex_.rows_of(column - simplex_.num_lows()))
        used_[r] += units_[column];
  }
  bool is_exceeded = false;
  for (std::size_t k = 0; k < simplex_.num_lows(); ++k) {
    const LevelSimplex::Line& line = simplex_.lines()[k];
    const std::uint32_t low = simplex_.low_row(k);
    for (std::uint32_t r = line.begin; r < line.first; ++r) used_[low] += used_[r];
    if (line.is_raised && used_[low] > room(low)) is_exceeded = true;
    Cost sum = used_[low];
    for (std::uint32_t r = line.first; r < line.last; ++r) {
      used_[r] = sum += used_[r];
      if (sum > room(r)) is_exceeded = true;
    }
  }
  return is_exceeded;
}

Cost LeafCertificate::bound() {
  const bool is_exceeded = find_used();
  Cost sum = 0;
  for (const std::uint32_t column : columns_) {
    Cost cut = 0;
    if (is_exceeded)
      visit_rows(column, [&](std::uint32_t r) { cut = std::max(cut, used_[r] - room(r)); });
    cut = std::min(cut, units_[column]);
    if (cut > 0) visit_rows(column, [&](std::uint32_t r) { used_[r] -= cut; });
    units_[column] -= cut;
    const int worth =
        column < simplex_.num_lows() ? 1 : simplex_.least(column - simplex_.num_lows());
    sum += units_[column] * worth;
  }
  std::erase_if(columns_, [&](std::uint32_t column) { return units_[column] == 0; });
  return (sum + kFraction - 1) / kFraction;
}

LeafCertificate::Rest LeafCertificate::take_off(Cost margin,
                                                std::span<const std::uint32_t> columns) {
  Rest rest{{}, std::vector<double>(columns.size(), 0)};
  Cost sum = margin;
  const auto take = [&](std::uint32_t column) {
    const Cost taken = std::min(units_[column], margin);
    units_[column] -= taken;
    sum += taken;
    return taken;
  };
  for (std::size_t k = 0; k < columns.size(); ++k)
    rest.multipliers[k] = static_cast<double>(take(columns[k]));
  std::erase_if(columns_, [&](std::uint32_t column) { return units_[column] == 0; });
  static_cast<void>(find_used());
  rest.rooms.assign(simplex_.num_rows(), 0);
  const auto leave = [&](std::uint32_t row) {
    rest.rooms[row] = std::clamp<Cost>(room(row) - used_[row], 0, kMostRoom * sum);
  };
  for (std::size_t k = 0; k < simplex_.num_lows(); ++k) {
    const LevelSimplex::Line& line = simplex_.lines()[k];
    if (line.is_raised) leave(simplex_.low_row(k));
    for (std::uint32_t r = line.first; r < line.last; ++r) leave(r);
  }
  return rest;
}

Cost LeafCertificate::largest() const {
  Cost largest = 0;
  for (const std::uint32_t column : columns_) largest = std::max(largest, units_[column]);
  return largest;
}

}  // namespace quadrille::continuous
