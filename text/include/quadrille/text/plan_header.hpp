// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>

#include "quadrille/core/stated_outcome.hpp"
#include "quadrille/text/document.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::text {

/// The version of the JSON files of plans.
inline constexpr std::int64_t kPlanJsonVersion = 1;

/// What the JSON files of plans and results say beside paths, which is the same in both domains.
/// As with Checker, functions return whether all is well, and the checker has the error.
class PlanHeader {
 public:
  using Node = Document::Node;

  PlanHeader(const Document& document, Checker& check) : document_(document), check_(check) {}

  /// Finds the members of the root, `more` of the domain among them, and reads the kind of the
  /// file, the status, the objective and the gap.
  bool read(std::initializer_list<Checker::Member> more, StatedOutcome& stated);
  /// The members "cost" and "lower_bound", in the domain's units.
  [[nodiscard]] const std::optional<Node>& cost() const noexcept { return cost_; }
  [[nodiscard]] const std::optional<Node>& lower_bound() const noexcept { return bound_; }
  /// A file that states `what` has to say of which objective.
  bool needs_objective(Node node, const std::string& what);
  /// There is a plan; `paths` is its list.
  bool plan(Node& paths);
  /// The number of agents, if it is stated, is that of the paths.
  bool agents(std::size_t num_paths);

  /// Whether there is no such member, or null.
  [[nodiscard]] bool is_null(const std::optional<Node>& node) const;

 private:
  bool read_kind(StatedOutcome& stated);
  bool read_objective(StatedOutcome& stated);
  bool read_gap(StatedOutcome& stated);

  const Document& document_;
  Checker& check_;
  std::optional<Node> kind_, version_, status_, objective_, cost_, bound_, gap_, plan_, agents_;
};

}  // namespace quadrille::text

QUADRILLE_API_END
