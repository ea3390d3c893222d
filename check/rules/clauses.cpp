// SPDX-License-Identifier: MIT
#include "rules/clauses.hpp"

#include <cstdlib>
#include <utility>

namespace quadrille_check {

void Clauses::add(std::span<const Int> clause) {
  where_.push_back({literals_.size(), clause.size(), true});
  for (const Int lit : clause) literals_.push_back(dense(lit));
}

std::int32_t Clauses::dense(Int lit) {
  const auto [at, is_new] =
      dense_.try_emplace(std::abs(lit), static_cast<std::int32_t>(numbers_.size()));
  if (is_new) {
    numbers_.push_back(at->first);
    values_.push_back(0);
  }
  return lit > 0 ? at->second : -at->second;
}

const Clauses::Place& Clauses::place(Int number) const {
  require(number > 0 && number <= last(), "no such clause");
  const Place& found = where_[static_cast<std::size_t>(number)];
  require(found.is_alive, "the clause was deleted");
  return found;
}

std::vector<Int> Clauses::operator[](Int number) const {
  const Place& at = place(number);
  std::vector<Int> clause;
  for (std::size_t k = at.begin; k < at.begin + at.size; ++k) {
    const Int variable = numbers_[static_cast<std::size_t>(std::abs(literals_[k]))];
    clause.push_back(literals_[k] > 0 ? variable : -variable);
  }
  return clause;
}

void Clauses::remove(Int number) {
  static_cast<void>(place(number));
  where_[static_cast<std::size_t>(number)].is_alive = false;
}

int Clauses::value(std::int32_t lit) const {
  const int known = values_[static_cast<std::size_t>(std::abs(lit))];
  return lit > 0 ? known : -known;
}

void Clauses::make_true(std::int32_t lit) {
  values_[static_cast<std::size_t>(std::abs(lit))] = lit > 0 ? 1 : -1;
  trail_.push_back(lit);
}

bool Clauses::implied(std::span<const Int> clause, std::span<const Int> hints) {
  for (const std::int32_t lit : std::exchange(trail_, {}))
    values_[static_cast<std::size_t>(std::abs(lit))] = 0;
  for (const Int number : clause) {
    const std::int32_t lit = dense(number);
    if (value(lit) > 0) return true;  // with its opposite
    if (value(lit) == 0) make_true(-lit);
  }
  for (const Int hint : hints) {
    const Place& at = place(last() + 1 - hint);
    std::int32_t open = 0;
    bool is_useless = false;
    for (std::size_t k = 0; k < at.size && !is_useless; ++k) {
      const std::int32_t lit = literals_[at.begin + k];
      const int known = value(lit);
      is_useless = known > 0 || (known == 0 && open != 0 && open != lit);
      if (known == 0) open = lit;
    }
    if (is_useless) continue;
    if (open == 0) return true;
    make_true(open);
  }
  return false;
}

}  // namespace quadrille_check
