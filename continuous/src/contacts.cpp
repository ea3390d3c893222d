// SPDX-License-Identifier: MIT
#include "contacts.hpp"

#include <utility>

namespace quadrille::continuous {
namespace {

geometry::Disc disc(const Instance& instance, ClassId c) {
  return geometry::Disc{instance.radius(c)};
}

std::uint64_t key(std::uint32_t first, std::uint32_t second) {
  return static_cast<std::uint64_t>(first) << 32 | second;
}

}  // namespace

Contacts::Contacts(const Instance& instance) : instance_(instance) {
  const IdRange<ClassId> classes(instance.num_classes());
  for (const ClassId a : classes)
    for (const ClassId b : classes)
      pairs_.push_back({geometry::BodyPair(disc(instance, a), disc(instance, b)), {}, {}, {}, {}});
  volumes_.resize(instance.num_classes());
}

Contacts::Offsets Contacts::offsets(ClassId a, EdgeId e, ClassId b, EdgeId f) {
  Pair& p = pair(a, b);
  const auto [at, is_new] = p.offsets.try_emplace(key(e.value(), f.value()));
  if (is_new) at->second = p.bodies.unsafe_offsets(instance_.motion(a, e), instance_.motion(b, f));
  return at->second;
}

Contacts::Window Contacts::window(ClassId a, EdgeId e, ClassId b, VertexId v) {
  Pair& p = pair(a, b);
  const auto [at, is_new] = p.windows.try_emplace(key(e.value(), v.value()));
  if (is_new)
    at->second = p.bodies.contact_window(instance_.motion(a, e), instance_.roadmap().position(v));
  return at->second;
}

bool Contacts::overlap(ClassId a, VertexId v, ClassId b, VertexId w) const {
  return pairs_[a.index() * instance_.num_classes() + b.index()].bodies.overlap(
      instance_.roadmap().position(v), instance_.roadmap().position(w));
}

const geometry::SweptVolumes& Contacts::volumes(ClassId c) {
  auto& known = volumes_[c.index()];
  if (known == nullptr) {
    std::vector<geometry::Motion> motions;
    const Roadmap& roadmap = instance_.roadmap();
    motions.reserve(roadmap.num_edges() + roadmap.num_vertices());
    for (std::size_t e = 0; e < roadmap.num_edges(); ++e)
      motions.push_back(instance_.motion(c, EdgeId(e)));
    for (const Point& position : roadmap.positions())
      motions.push_back(geometry::rest(position, 1));
    known = std::make_unique<geometry::SweptVolumes>(disc(instance_, c), std::move(motions));
  }
  return *known;
}

const Contacts::Neighbours& Contacts::near(
    std::unordered_map<std::uint32_t, std::unique_ptr<Neighbours>>& known, std::uint32_t key,
    ClassId a, const geometry::Motion& motion, ClassId b) {
  auto& entry = known[key];
  if (entry == nullptr) {
    entry = std::make_unique<Neighbours>();
    const std::size_t num_edges = instance_.roadmap().num_edges();
    for (const std::size_t index : volumes(b).near(disc(instance_, a), motion)) {
      if (index < num_edges)
        entry->edges.emplace_back(index);
      else
        entry->vertices.emplace_back(index - num_edges);
    }
  }
  return *entry;
}

const Contacts::Neighbours& Contacts::near_edge(ClassId a, EdgeId e, ClassId b) {
  return near(pair(a, b).near_edges, e.value(), a, instance_.motion(a, e), b);
}

const Contacts::Neighbours& Contacts::near_vertex(ClassId a, VertexId v, ClassId b) {
  return near(pair(a, b).near_vertices, v.value(), a,
              geometry::rest(instance_.roadmap().position(v), 1), b);
}

}  // namespace quadrille::continuous
