// SPDX-License-Identifier: MIT
#include "cover/half_sums.hpp"

#include <algorithm>
#include <utility>

namespace quadrille::continuous {
namespace {

constexpr double kTiny = 1e-6;
/// Less is not worth a sum.
constexpr double kLeastViolation = 0.2;
/// Of the summands, those with the least excess.
constexpr std::size_t kMostLines = 60;

}  // namespace

HalfSums::HalfSums(std::span<const Level> levels, std::span<const double> parts)
    : levels_(levels), parts_(parts) {}

void HalfSums::add(const Summand& summand) {
  Line line{summand, {}, static_cast<double>(-summand.least)};
  bool is_integral = true;
  for (const std::uint32_t r : summand.rows) {
    const double part = parts_[r];
    line.excess += part;
    if (part > kTiny && part < 1 - kTiny) is_integral = false;
    if (part > kTiny) line.terms.push_back({levels_[r].agent, part});
  }
  if (is_integral || line.excess >= 1) return;
  lines_.push_back(std::move(line));
}

/// What rounding saves of the parts of two summands: of each agent the second, fourth, ... part.
double HalfSums::saved(const Line& a, const Line& b) {
  double saved = 0;
  auto i = a.terms.begin(), j = b.terms.begin();
  AgentId agent;
  bool is_even = false, has_agent = false;
  while (i != a.terms.end() || j != b.terms.end()) {
    const bool is_first = j == b.terms.end() ||
                          (i != a.terms.end() &&
                           (i->agent < j->agent || (i->agent == j->agent && i->part >= j->part)));
    const Term& term = is_first ? *i++ : *j++;
    if (!has_agent || term.agent != agent) {
      agent = term.agent;
      has_agent = true;
      is_even = false;
    } else {
      is_even = !is_even;
      if (is_even) saved += term.part;
    }
  }
  effort_ += static_cast<std::int64_t>(a.terms.size() + b.terms.size());
  return saved;
}

/// The terms of two, as if of one.
void HalfSums::merge(const Line& a, const Line& b) {
  merged_.terms.resize(a.terms.size() + b.terms.size());
  std::merge(a.terms.begin(), a.terms.end(), b.terms.begin(), b.terms.end(), merged_.terms.begin(),
             [](const Term& x, const Term& y) {
               return x.agent < y.agent || (x.agent == y.agent && x.part > y.part);
             });
}

std::vector<LevelSum> HalfSums::find(std::size_t most) {
  std::stable_sort(lines_.begin(), lines_.end(),
                   [](const Line& a, const Line& b) { return a.excess < b.excess; });
  if (lines_.size() > kMostLines) lines_.resize(kMostLines);
  common_.assign(lines_.size() * lines_.size(), 0);
  for (std::size_t a = 0; a < lines_.size(); ++a)
    for (std::size_t b = a + 1; b < lines_.size(); ++b)
      common_[a * lines_.size() + b] = saved(lines_[a], lines_[b]);
  std::vector<Found> found;
  for (std::size_t a = 0; a < lines_.size(); ++a)
    for (std::size_t b = a + 1; b < lines_.size(); ++b) look(a, b, found);
  std::stable_sort(found.begin(), found.end(),
                   [](const Found& x, const Found& y) { return x.violation > y.violation; });
  std::vector<LevelSum> sums;
  for (const Found& f : found) {
    if (sums.size() == most) break;
    LevelSum sum = sum_of(f);
    if (std::find(sums.begin(), sums.end(), sum) == sums.end()) sums.push_back(std::move(sum));
  }
  return sums;
}

// The sum of the parts is the excess and all `least`, n; of that rounding saves some. What is asked
// for is (n + 1) / 2.
void HalfSums::look(std::size_t a, std::size_t b, std::vector<Found>& found) {
  const double excess = lines_[a].excess + lines_[b].excess;
  const int n = lines_[a].summand.least + lines_[b].summand.least;
  if (n % 2 != 0) {
    const double violation = common(a, b) - excess - (n - 1) / 2.0;
    if (violation > kLeastViolation) found.push_back({violation, a, b, b});
  }
  bool is_merged = false;
  for (std::size_t c = b + 1; c < lines_.size(); ++c) {
    const int all = n + lines_[c].summand.least;
    if (all % 2 == 0) continue;
    const double needed = excess + lines_[c].excess + (all - 1) / 2.0;
    ++effort_;
    if (common(a, b) + common(a, c) + common(b, c) <= needed + kLeastViolation) continue;
    if (!is_merged) merge(lines_[a], lines_[b]);
    is_merged = true;
    const double violation = saved(merged_, lines_[c]) - needed;
    if (violation > kLeastViolation) found.push_back({violation, a, b, c});
  }
}

LevelSum HalfSums::sum_of(const Found& found) const {
  std::vector<Level> all;
  LevelSum sum{{}, 0};
  const auto take = [&](std::size_t k) {
    for (const std::uint32_t r : lines_[k].summand.rows) all.push_back(levels_[r]);
    sum.least += lines_[k].summand.least;
  };
  take(found.a);
  take(found.b);
  if (found.c != found.b) take(found.c);
  std::sort(all.begin(), all.end());
  sum.least = (sum.least + 1) / 2;
  bool is_odd = false;
  for (std::size_t k = 0; k < all.size(); ++k) {
    is_odd = k == 0 || all[k].agent != all[k - 1].agent || !is_odd;
    if (is_odd) sum.levels.push_back(all[k]);
  }
  return sum;
}

}  // namespace quadrille::continuous
