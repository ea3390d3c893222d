// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "quadrille/core/contract.hpp"
#include "quadrille/core/ids.hpp"

namespace quadrille::lazy {

/// What a search for a cheapest path of one agent has found, in either domain. To be asked before
/// the next search only: path and blame are those of the search's state. `PathSearch` has it as a
/// friend, and `path_`, `num_searches_` and `blame`.
template <class PathSearch>
class Cheapest {
 public:
  Cheapest(PathSearch& search, AgentId agent, bool is_found)
      : search_(search), agent_(agent), is_found_(is_found), number_(search.num_searches_) {}

  /// Null: there is none within the bound that was asked for.
  [[nodiscard]] const auto* path() const {
    check();
    return is_found_ ? &search_.path_ : nullptr;
  }
  /// See PathSearch::blame.
  template <class Bound>
  [[nodiscard]] auto blame(Bound bound) const {
    check();
    return search_.blame(agent_, bound);
  }

 private:
  void check() const {
    QUADRILLE_REQUIRE(number_ == search_.num_searches_, "the last search is asked");
  }

  PathSearch& search_;
  AgentId agent_;
  bool is_found_;
  std::int64_t number_;
};

}  // namespace quadrille::lazy
