// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdlib>
#include <deque>
#include <limits>
#include <unordered_map>
#include <utility>

#include "read/basics.hpp"

namespace quadrille_check {

/// The variables of a file by their numbers, which may be far apart.
template <class Variable>
class VariableTable {
 public:
  /// Throws Rejected.
  void add(Int number, Variable made) {
    require(number > 0 && number <= std::numeric_limits<std::int32_t>::max(), "no such variable");
    require(places_.try_emplace(number, variables_.size()).second, "a variable has two meanings");
    variables_.push_back(std::move(made));
    last_ = std::max(last_, number);
  }
  /// Of the literal. Throws Rejected if it has no meaning.
  [[nodiscard]] const Variable& operator[](Int lit) const {
    const auto place = places_.find(std::abs(std::max(lit, -std::numeric_limits<Int>::max())));
    require(place != places_.end(), "a variable without a meaning");
    return variables_[place->second];
  }
  /// The largest number.
  [[nodiscard]] Int last() const { return last_; }

 private:
  std::unordered_map<Int, std::size_t> places_;
  std::deque<Variable> variables_;
  Int last_ = 0;
};

}  // namespace quadrille_check
