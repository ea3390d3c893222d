// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "quadrille/continuous/solver.hpp"
#include "quadrille/fleet/fleet.hpp"

namespace quadrille::fleet {

/// Robots in the middle of a move begin at a place that is rounded. Where robots have to touch,
/// that can be why there is no plan: whether it is, is found out with bodies that are smaller by as
/// much as the places are off. If there was a plan from the true places, there is one then.
class PlaceRounding {
 public:
  /// `fleet` outlives it.
  explicit PlaceRounding(const Fleet& fleet) : fleet_(fleet) {}

  /// For the end of an explanation why the instance cannot have a plan; empty if that does not rest
  /// on the rounding.
  [[nodiscard]] std::string doubt_about_refusal() const;
  /// The same of a search that found no plan for these robots (none: for all of them together).
  /// Looks for a plan of theirs alone, within `limits` and some effort.
  [[nodiscard]] std::string doubt_about(std::vector<AgentId> blocked,
                                        const quadrille::Limits& limits) const;

 private:
  /// The agents, smaller where their places are off; `most`: by how many length units at most.
  struct Smaller {
    std::vector<continuous::Agent> agents;
    double most = 0;
    bool has_polygons = false;  ///< That are off, and are as they were.
  };
  [[nodiscard]] static Smaller smaller(const Fleet::Parts& parts, const std::vector<AgentId>& whom);
  [[nodiscard]] Result<continuous::Instance> make(const Fleet::Parts& parts,
                                                  const Smaller& smaller) const;
  [[nodiscard]] std::string say(const Smaller& smaller, bool is_sure) const;

  const Fleet& fleet_;
};

}  // namespace quadrille::fleet
