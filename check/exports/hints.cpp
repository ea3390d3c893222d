// SPDX-License-Identifier: MIT
#include "exports/hints.hpp"

#include <cstdlib>

namespace quadrille_check {

std::vector<UsedHint> used_hints(const Ints& clause, const Ints& hints,
                                 const std::map<Int, Ints>& literals) {
  std::vector<UsedHint> used;
  std::map<Int, bool> value;
  for (const Int lit : clause) value[std::abs(lit)] = lit < 0;
  for (const Int hint : hints) {
    Ints open;
    bool is_true = false;
    for (const Int lit : literals.at(hint)) {
      const auto known = value.find(std::abs(lit));
      if (known == value.end())
        open.push_back(lit);
      else
        is_true = is_true || known->second == (lit > 0);
    }
    if (is_true || open.size() > 1) continue;
    used.push_back({hint, open.empty() ? 0 : open[0]});
    if (open.empty()) return used;
    value[std::abs(open[0])] = open[0] > 0;
  }
  return {};
}

}  // namespace quadrille_check
