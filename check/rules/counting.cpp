// SPDX-License-Identifier: MIT
#include <algorithm>

#include "rules/rules.hpp"

namespace quadrille_check {

bool is_sum(const Meanings& meanings, Clause clause) {
  for (const Int sum : clause) {
    const Variable& s = meanings.variable(sum);
    if (sum < 0 || s.kind != Variable::Kind::number_is_at_least) continue;
    const Node& n = meanings.node(s.node);
    // If the others are false, these parts are at least so large.
    Int left = 0, right = 0, whole = 0;
    for (const Int lit : clause) {
      if (lit == sum) continue;
      whole = std::max(whole, meanings.implied(s.node, -lit));
      left = std::max(left, meanings.implied(n.of, -lit));
      right = std::max(right, meanings.implied(n.base, -lit));
    }
    if (std::max(whole, left + right) >= s.number) return true;
  }
  return false;
}

bool is_order(const Meanings& meanings, Clause clause) {
  return clause.size() == 2 &&
         (meanings.implies(-clause[0], clause[1]) || meanings.implies(-clause[1], clause[0]));
}

}  // namespace quadrille_check
