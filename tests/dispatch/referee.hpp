// SPDX-License-Identifier: MIT
//
// Who touches whom, seen from outside: by places alone, whatever anybody has planned or computed.
#pragma once

#include <cstddef>
#include <vector>

namespace quadrille::dispatch::test {

struct Place {
  double x = 0, y = 0;
};

class Referee {
 public:
  explicit Referee(std::vector<double> radii) : radii_(std::move(radii)) {}

  /// Between two looks everybody goes straight and evenly. Counts the pairs that come nearer to
  /// each other than their radii allow, by more than a millionth of a unit.
  void look(const std::vector<Place>& places);

  [[nodiscard]] std::size_t num_contacts() const { return num_contacts_; }
  [[nodiscard]] double least_gap() const { return least_gap_; }
  /// How far everybody has gone in all.
  [[nodiscard]] const std::vector<double>& ways() const { return ways_; }

 private:
  std::vector<double> radii_, ways_;
  std::vector<Place> before_;
  std::size_t num_contacts_ = 0;
  double least_gap_ = 1e9;
};

}  // namespace quadrille::dispatch::test
