// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

#include "contacts/contacts.hpp"

namespace quadrille::continuous {

/// Agents of the same body and speed to whom the same edges were open if none were closed: classes
/// of different instances with the same one are alike. The numbers of the body, the speed, and the
/// group, or kMaxGroups.
using ClassKey = std::tuple<std::vector<Length>, Speed, std::size_t>;

/// Contacts that live longer than the instances they are of: all of these have the vertices and
/// edges of one roadmap, and perhaps further ones after them, which may be others each time. Edges
/// may be open to fewer groups than in that roadmap. One scene at a time uses it.
class ContactStore {
 public:
  explicit ContactStore(std::shared_ptr<const Roadmap> base);

  /// From now on, answers are for this instance. Forgets those about vertices and edges that are
  /// not of the roadmap: in time linear in what is known, if there are or were any.
  void adopt(const Instance& instance);
  /// Of the instance's class, which has been adopted.
  [[nodiscard]] const ClassKey& key(ClassId c) const { return keys_[c.index()]; }

  // For Contacts.
  [[nodiscard]] std::shared_ptr<Contacts::Pair> pair(const Instance& instance, ClassId a,
                                                     ClassId b);
  /// Null: not known yet.
  [[nodiscard]] const std::shared_ptr<const Contacts::Volumes>& volumes() const noexcept {
    return volumes_;
  }
  void keep(std::shared_ptr<const Contacts::Volumes> volumes) { volumes_ = std::move(volumes); }
  /// Whether the edge is open to the class as long as none are closed.
  [[nodiscard]] bool is_ever_open(const Instance& instance, ClassId c, EdgeId e) const;

 private:
  [[nodiscard]] ClassKey key_of(const Agent& agent) const;
  void forget_classes();

  const std::shared_ptr<const Roadmap> base_;
  std::size_t most_edges_, most_vertices_;  // that tables have room for
  bool has_more_ = false;                   // than the roadmap has
  std::vector<ClassKey> keys_;              // by class
  std::vector<GroupId> groups_;             // by class: of an agent
  std::vector<bool> is_all_open_;           // by group, in the roadmap
  std::map<std::pair<ClassKey, ClassKey>, std::shared_ptr<Contacts::Pair>> pairs_;
  std::shared_ptr<const Contacts::Volumes> volumes_;
};

}  // namespace quadrille::continuous
