// SPDX-License-Identifier: MIT
#include "contacts/contact_store.hpp"

#include <algorithm>

#include "model/body_numbers.hpp"

namespace quadrille::continuous {
namespace {

/// Room for vertices and edges that come and go.
std::size_t with_room(std::size_t count) { return count + count / 4 + 64; }

}  // namespace

ContactStore::ContactStore(std::shared_ptr<const Roadmap> base)
    : base_(std::move(base)),
      most_edges_(with_room(base_->num_edges())),
      most_vertices_(with_room(base_->num_vertices())) {
  for (std::size_t group = 0; group < kMaxGroups; ++group)
    is_all_open_.push_back(
        std::all_of(base_->edges().begin(), base_->edges().end(),
                    [&](const Edge& edge) { return edge.open_to.contains(GroupId(group)); }));
}

void ContactStore::adopt(const Instance& instance) {
  const Roadmap& roadmap = instance.roadmap();
  const bool has_more =
      roadmap.num_edges() > base_->num_edges() || roadmap.num_vertices() > base_->num_vertices();
  if (roadmap.num_edges() > most_edges_ || roadmap.num_vertices() > most_vertices_) {
    most_edges_ = with_room(std::max(most_edges_, roadmap.num_edges()));
    most_vertices_ = with_room(std::max(most_vertices_, roadmap.num_vertices()));
    pairs_.clear();
    volumes_.reset();
  } else if (has_more || has_more_) {
    for (auto& [keys, pair] : pairs_) {
      pair->offsets.keep(base_->num_edges(), base_->num_edges());
      pair->windows.keep(base_->num_edges(), base_->num_vertices());
      pair->near_edges.clear();
      pair->near_vertices.clear();
    }
    volumes_.reset();
  }
  has_more_ = has_more;
  keys_.assign(instance.num_classes(), {});
  groups_.assign(instance.num_classes(), {});
  for (const AgentId i : instance.agent_ids()) {
    const ClassId c = instance.class_of(i);
    keys_[c.index()] = key_of(instance.agent(i));
    groups_[c.index()] = instance.agent(i).group;
  }
  forget_classes();
}

// Agents of ever new bodies would fill the memory.
void ContactStore::forget_classes() {
  if (pairs_.size() <= 64 + 4 * keys_.size() * keys_.size()) return;
  const auto is_used = [&](const ClassKey& key) {
    return std::find(keys_.begin(), keys_.end(), key) != keys_.end();
  };
  std::erase_if(pairs_, [&](const auto& entry) {
    return !is_used(entry.first.first) || !is_used(entry.first.second);
  });
}

ClassKey ContactStore::key_of(const Agent& agent) const {
  const std::size_t group = agent.group.index();
  return {numbers_of(agent), agent.speed, is_all_open_[group] ? kMaxGroups : group};
}

std::shared_ptr<Contacts::Pair> ContactStore::pair(const Instance& instance, ClassId a, ClassId b) {
  auto& known = pairs_[{key(a), key(b)}];
  if (known == nullptr)
    known = std::make_shared<Contacts::Pair>(
        Contacts::Pair{shape_pairs(instance, a, b), IntervalTable(most_edges_, most_edges_),
                       IntervalTable(most_edges_, most_vertices_)});
  return known;
}

bool ContactStore::is_ever_open(const Instance& instance, ClassId c, EdgeId e) const {
  if (e.index() >= base_->num_edges()) return instance.may_use(c, e);
  return base_->edge(e).open_to.contains(groups_[c.index()]);
}

}  // namespace quadrille::continuous
