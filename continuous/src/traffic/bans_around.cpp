// SPDX-License-Identifier: MIT
#include "traffic/bans_around.hpp"

#include <utility>

namespace quadrille::continuous {

void BansAround::add(ClassId a, ClassId b, const std::vector<Step>& steps, std::vector<Ban>& bans) {
  for (const Step& step : steps) {
    if (step.is_move) {
      for (Ban ban : of_move(a, b, step.edge)) {
        ban.when = ban.when.shifted(step.begin);
        bans.push_back(ban);
      }
    } else {
      for (Ban ban : of_stay(a, b, step.vertex)) {
        ban.when = starts_meeting(ban.when, step.begin, step.end);
        bans.push_back(ban);
      }
    }
  }
}

const std::vector<Ban>& BansAround::of_move(ClassId a, ClassId b, EdgeId e) {
  if (const auto at = moves_.find(key(a, b, e.value())); at != moves_.end()) return at->second;
  Contacts& contacts = scene_.contacts();
  const auto& near = contacts.near_edge(b, e, a);
  std::vector<Ban> bans;
  for (const EdgeId f : near.edges)
    if (const auto& offsets = contacts.offsets(b, e, a, f))
      bans.push_back(Ban::start(f, starts_against(*offsets, 0)));
  for (const VertexId v : near.vertices)
    if (const auto& window = contacts.window(b, e, a, v)) bans.push_back(Ban::stay(v, *window));
  return moves_.emplace(key(a, b, e.value()), std::move(bans)).first->second;
}

const std::vector<Ban>& BansAround::of_stay(ClassId a, ClassId b, VertexId v) {
  if (const auto at = stays_.find(key(a, b, v.value())); at != stays_.end()) return at->second;
  Contacts& contacts = scene_.contacts();
  std::vector<Ban> bans;
  for (const EdgeId e : contacts.near_vertex(b, v, a).edges)
    if (const auto& window = contacts.window(a, e, b, v)) bans.push_back(Ban::start(e, *window));
  return stays_.emplace(key(a, b, v.value()), std::move(bans)).first->second;
}

std::uint64_t BansAround::key(ClassId a, ClassId b, std::uint32_t place) const {
  const std::uint64_t classes = a.index() * scene_.instance().num_classes() + b.index();
  return classes << 32 | place;
}

}  // namespace quadrille::continuous
