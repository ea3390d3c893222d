// SPDX-License-Identifier: MIT
#include "contacts/contacts.hpp"

#include <algorithm>
#include <utility>

#include "contacts/contact_store.hpp"

namespace quadrille::continuous {
Contacts::Contacts(const Instance& instance, LimitMonitor& limits, ContactStore* store)
    : instance_(instance), parked_(instance), limits_(limits), store_(store) {
  const IdRange<ClassId> classes(instance.num_classes());
  const std::size_t num_edges = instance.roadmap().num_edges();
  for (const ClassId a : classes)
    for (const ClassId b : classes) {
      limits_.check();
      pairs_.push_back(
          store != nullptr
              ? store->pair(instance, a, b)
              : std::make_shared<Pair>(Pair{
                    shape_pairs(instance, a, b),
                    IntervalTable(num_edges, std::max<std::size_t>(num_edges, 1)),
                    IntervalTable(num_edges,
                                  std::max<std::size_t>(instance.roadmap().num_vertices(), 1))}));
    }
}

Contacts::Offsets Contacts::offsets(ClassId a, EdgeId e, ClassId b, EdgeId f) {
  Pair& p = pair(a, b);
  return p.offsets.get(e.index(), f.index(), [&] {
    limits_.check();
    return p.bodies.unsafe_offsets(move(a, e), move(b, f));
  });
}

Contacts::Window Contacts::window(ClassId a, EdgeId e, ClassId b, VertexId v) {
  Pair& p = pair(a, b);
  return p.windows.get(e.index(), v.index(), [&]() -> Window {
    limits_.check();
    if (parked_.may_move(e, v, p.bodies)) return std::nullopt;
    return p.bodies.contact_window(move(a, e), stand(v));
  });
}

bool Contacts::overlap(ClassId a, VertexId v, ClassId b, VertexId w) const {
  return !parked_.may_stand(v, w) &&
         pairs_[a.index() * instance_.num_classes() + b.index()]->bodies.overlap(stand(v),
                                                                                 stand(w));
}

// One tree is enough for all classes. Edges between the same two vertices are one line, in whatever
// direction and time.
const Contacts::Volumes& Contacts::volumes() {
  if (volumes_ == nullptr && store_ != nullptr) volumes_ = store_->volumes();
  if (volumes_ != nullptr) return *volumes_;
  const Roadmap& roadmap = instance_.roadmap();
  const auto ends = [&](EdgeId e) {
    const Edge& edge = roadmap.edge(e);
    return std::minmax(edge.from, edge.to);
  };
  std::vector<EdgeId> edges;
  for (const EdgeId e : IdRange<EdgeId>(roadmap.num_edges())) edges.push_back(e);
  std::sort(edges.begin(), edges.end(),
            [&](EdgeId e, EdgeId f) { return std::pair(ends(e), e) < std::pair(ends(f), f); });
  std::vector<std::size_t> begins;
  std::vector<geometry::Motion> motions;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    if (k > 0 && ends(edges[k]) == ends(edges[k - 1])) continue;
    begins.push_back(k);
    motions.push_back(instance_.motion(ClassId(0), edges[k]));
  }
  begins.push_back(edges.size());
  for (const VertexId v : IdRange<VertexId>(roadmap.num_vertices()))
    motions.push_back(geometry::rest(roadmap.place(v), 1));
  volumes_ = std::make_shared<const Volumes>(
      Volumes{geometry::SweptVolumes(std::move(motions)), std::move(edges), std::move(begins)});
  if (store_ != nullptr) store_->keep(volumes_);
  return *volumes_;
}

// What a store keeps has to do for roadmaps in which other edges are closed.
bool Contacts::is_listed(ClassId c, EdgeId e) const {
  return store_ != nullptr ? store_->is_ever_open(instance_, c, e) : instance_.may_use(c, e);
}

const Contacts::Neighbours& Contacts::near(
    std::unordered_map<std::uint32_t, std::unique_ptr<Neighbours>>& known, std::uint32_t key,
    ClassId a, const ShapePairs::Move& move, ClassId b) {
  auto& entry = known[key];
  if (entry == nullptr) {
    limits_.check();
    auto made = std::make_unique<Neighbours>();
    const Roadmap& roadmap = instance_.roadmap();
    ShapePairs& bodies = pair(a, b).bodies;
    const bool has_shapes = bodies.has_shapes();
    const Volumes& all = volumes();
    const std::size_t num_segments = all.segment_begins.size() - 1;
    for (const auto& [index, is_sure] : all.tree.near(move.motion, bodies.around(move.shape))) {
      if (index < num_segments) {
        const std::size_t begin = all.segment_begins[index];
        // Without shapes one edge of a segment speaks for all of them.
        const auto can_meet = [&](std::size_t k) {
          return bodies.can_meet(move, this->move(b, all.segment_edges[k]));
        };
        if (has_shapes || is_sure || can_meet(begin))
          for (std::size_t k = begin; k < all.segment_begins[index + 1]; ++k)
            if (is_listed(b, all.segment_edges[k]) && (!has_shapes || can_meet(k)))
              made->edges.push_back(all.segment_edges[k]);
      } else {
        const VertexId v(index - num_segments);
        if ((is_sure && !has_shapes) || bodies.can_meet(move, rest_at(roadmap, v)))
          made->vertices.push_back(v);
      }
    }
    std::sort(made->edges.begin(), made->edges.end());
    entry = std::move(made);
  }
  return *entry;
}

const Contacts::Neighbours& Contacts::near_edge(ClassId a, EdgeId e, ClassId b) {
  return near(pair(a, b).near_edges, e.value(), a, move(a, e), b);
}

const Contacts::Neighbours& Contacts::near_vertex(ClassId a, VertexId v, ClassId b) {
  return near(pair(a, b).near_vertices, v.value(), a, rest_at(instance_.roadmap(), v), b);
}

}  // namespace quadrille::continuous
