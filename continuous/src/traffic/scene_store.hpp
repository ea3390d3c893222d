// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "contacts/contact_store.hpp"
#include "paths/goal_distances.hpp"

namespace quadrille::continuous {

/// What scenes of instances on one roadmap have in common, and leave to the next one: contacts, and
/// the distances to goals as far as what was closed or opened since does not change them. As for
/// ContactStore; between two instances edges may have been closed and opened again.
class SceneStore {
 public:
  explicit SceneStore(std::shared_ptr<const Roadmap> base);

  /// From now on, answers are for this instance.
  void adopt(const Instance& instance);
  [[nodiscard]] ContactStore& contacts() noexcept { return contacts_; }
  /// Of an agent of the instance.
  [[nodiscard]] GoalDistances distances(const Instance& instance, AgentId agent);

 private:
  struct Change {
    EdgeId edge;
    Groups before, after;
  };
  struct Known {
    std::vector<Ticks> ticks;  // by vertex of the base
    bool is_used = true;       // by the instance, or the one before
  };
  [[nodiscard]] std::vector<Change> changes_to(const Instance& instance) const;
  void forget(const Instance& instance, const std::vector<Change>& changes);

  const std::shared_ptr<const Roadmap> base_;
  ContactStore contacts_;
  std::vector<Groups> open_to_;  // by edge of the base: in the instance
  /// By class and goal.
  std::map<std::pair<ClassKey, std::vector<VertexId>>, Known> distances_;  // by goals
};

}  // namespace quadrille::continuous
