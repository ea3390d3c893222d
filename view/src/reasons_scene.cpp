// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>

#include "quadrille/execution/precedences.hpp"
#include "scene.hpp"

namespace quadrille::view {
namespace {

/// Sites beyond these, those with the fewest lemmas, would make a page heavy and show nothing.
constexpr std::size_t kMostSites = 3000;
/// Nor would anybody look at the order of thousands of moves; it takes time, too.
constexpr std::size_t kMostMoves = 20'000;
constexpr std::size_t kMostPrecedences = 10'000;

using Line = std::vector<Position>;

/// `line`: where the site is, from a place.
template <class LineOf>
void add_sites(const Attribution& attribution, const LineOf& line, Scene& scene) {
  scene.has_attribution = true;
  scene.free_bound = attribution.free_bound;
  scene.lower_bound = attribution.lower_bound;
  scene.raises = attribution.raises;
  std::vector<const CollisionSite*> sites;
  for (const CollisionSite& site : attribution.sites) sites.push_back(&site);
  std::stable_sort(sites.begin(), sites.end(),
                   [](const auto* a, const auto* b) { return a->num_lemmas > b->num_lemmas; });
  if (sites.size() > kMostSites) sites.resize(kMostSites);
  for (const CollisionSite* site : sites) {
    SceneSite added{site->first.index(),     site->second.index(), {line(site->place)},
                    site->begin - scene.now, std::nullopt,         site->num_lemmas};
    if (site->other) added.lines.push_back(line(*site->other));
    if (site->end != CollisionSite::kForever) added.end = site->end - scene.now;
    scene.sites.push_back(std::move(added));
  }
}

/// A shortest way through the graph; straight if there is none.
Line way_between(const discrete::Graph& graph, VertexId from, VertexId to, const Scene& scene) {
  const auto distances = distances_from(graph, to);
  Line line{scene.places[from.index()]};
  if (distances[from] == discrete::kUnreachable) return {line[0], scene.places[to.index()]};
  while (from != to) {
    const auto neighbours = graph.neighbours(from);
    from = *std::find_if(neighbours.begin(), neighbours.end(),
                         [&, d = distances[from]](VertexId w) { return distances[w] == d - 1; });
    line.push_back(scene.places[from.index()]);
  }
  return line;
}

template <class Instance, class Plan>
void add_precedences_of(const Instance& instance, const Plan& plan, Scene& scene) {
  std::size_t moves = 0;
  for (const auto& path : plan.paths) moves += path.size();
  if (!scene.violations.empty() || moves > kMostMoves) return;
  const auto found = execution::precedences(instance, plan);
  if (!found || found->list.size() > kMostPrecedences) return;
  const auto time = [&scene](execution::Ticks ticks) { return ticks.value() - scene.now; };
  for (const execution::Precedence& precedence : found->list) {
    const auto &leader = found->at(precedence.leader), &follower = found->at(precedence.follower);
    scene.precedences.push_back({precedence.leader.agent.index(), time(leader.begin),
                                 time(leader.end), precedence.follower.agent.index(),
                                 time(follower.begin), time(follower.end),
                                 precedence.slack.value()});
  }
}

}  // namespace

void add_attribution(const discrete::Instance& instance, const Attribution& attribution,
                     Scene& scene) {
  const auto line = [&](const Place& place) -> Line {
    const Position from = scene.places[place.from.index()], to = scene.places[place.to.index()];
    if (place.kind == Place::Kind::corridor)
      return way_between(instance.graph(), place.from, place.to, scene);
    if (place.kind == Place::Kind::rectangle)
      return {from, {to.x, from.y}, to, {from.x, to.y}, from};
    return place.from == place.to ? Line{from} : Line{from, to};
  };
  add_sites(attribution, line, scene);
}

void add_attribution(const Attribution& attribution, Scene& scene) {
  add_sites(
      attribution,
      [&](const Place& place) -> Line {
        const Position from = scene.places[place.from.index()], to = scene.places[place.to.index()];
        return place.from == place.to ? Line{from} : Line{from, to};
      },
      scene);
}

void add_precedences(const discrete::Instance& instance, const discrete::Plan& plan, Scene& scene) {
  add_precedences_of(instance, plan, scene);
}
void add_precedences(const continuous::Instance& instance, const continuous::Plan& plan,
                     Scene& scene) {
  add_precedences_of(instance, plan, scene);
}

}  // namespace quadrille::view
