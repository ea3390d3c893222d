// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "read/basics.hpp"

namespace quadrille_check {

/// Clauses that are true in every plan, by their numbers, from 1.
class Clauses {
 public:
  void add(std::span<const Int> clause);
  /// Throw Rejected if there is no such clause any more.
  [[nodiscard]] std::vector<Int> operator[](Int number) const;
  void remove(Int number);
  /// The number of the last one.
  [[nodiscard]] Int last() const { return static_cast<Int>(where_.size()) - 1; }

  /// Whether the clause follows by unit propagation: with its literals false, the hints, in their
  /// order, each imply one literal more, until one is false. Hints that imply nothing are passed
  /// over. `hints`: how many clauses before the next one they are.
  [[nodiscard]] bool implied(std::span<const Int> clause, std::span<const Int> hints);

 private:
  struct Place {
    std::size_t begin = 0, size = 0;
    bool is_alive = false;
  };
  [[nodiscard]] const Place& place(Int number) const;
  [[nodiscard]] int value(std::int32_t lit) const;
  void make_true(std::int32_t lit);

  /// Variables are numbered again, without gaps.
  [[nodiscard]] std::int32_t dense(Int lit);

  std::unordered_map<Int, std::int32_t> dense_;
  std::vector<Int> numbers_ = std::vector<Int>(1);  // by dense number
  std::vector<std::int32_t> literals_;
  std::vector<Place> where_ = std::vector<Place>(1);
  std::vector<signed char> values_ = std::vector<signed char>(1);
  std::vector<std::int32_t> trail_;
};

}  // namespace quadrille_check
