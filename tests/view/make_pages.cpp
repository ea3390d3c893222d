// SPDX-License-Identifier: MIT
//
// make_pages <folder> <cases>: pages of random plans in both domains, valid and broken, and beside
// each a JSON file of what its page has to say: where agents are, as this program computes it from
// the plan, and clearances and violations, as verify does.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <queue>
#include <string>

#include "continuous/support/random_instance.hpp"
#include "quadrille/continuous/verify.hpp"
#include "quadrille/discrete/verify.hpp"
#include "quadrille/view/page.hpp"
#include "support/generators.hpp"

namespace quadrille::view::test {
namespace {

using Json = nlohmann::json;
using continuous::Ticks;
using continuous::test::Draw;

constexpr int kSamples = 40;
constexpr double kResolution = 0.125;  // of time
constexpr double kLengthResolution = 0.5;

/// A shortest way, in edges; empty if there is none.
template <class Neighbours>
std::vector<VertexId> way(std::size_t vertices, VertexId from, VertexId to,
                          const Neighbours& neighbours) {
  std::vector<int> before(vertices, -1);
  std::queue<VertexId> open;
  open.push(from);
  before[from.index()] = static_cast<int>(from.index());
  while (!open.empty() && before[to.index()] < 0) {
    const VertexId v = open.front();
    open.pop();
    for (const VertexId w : neighbours(v)) {
      if (before[w.index()] >= 0) continue;
      before[w.index()] = static_cast<int>(v.index());
      open.push(w);
    }
  }
  if (before[to.index()] < 0) return {};
  std::vector<VertexId> result{to};
  while (result.back() != from)
    result.emplace_back(static_cast<std::size_t>(before[result.back().index()]));
  std::reverse(result.begin(), result.end());
  return result;
}

/// Goes about at random, then home if there is a way.
template <class Neighbours>
std::vector<VertexId> walk(Draw& draw, std::size_t vertices, VertexId start, VertexId goal,
                           const Neighbours& neighbours) {
  std::vector<VertexId> result{start};
  for (auto steps = draw.number(0, 8); steps > 0; --steps) {
    const auto next = neighbours(result.back());
    if (next.empty()) break;
    result.push_back(
        next[static_cast<std::size_t>(draw.number(0, static_cast<std::int64_t>(next.size()) - 1))]);
  }
  auto home = way(vertices, result.back(), goal, neighbours);
  if (home.empty()) {
    home = way(vertices, start, goal, neighbours);
    result = {start};
  }
  if (!home.empty()) result.insert(result.end(), home.begin() + 1, home.end());
  return result;
}

void save(const std::string& name, const std::string& text) { std::ofstream(name) << text; }

template <class Report>
Json violations_of(const Report& report) {
  Json list = Json::array();
  for (const auto& violation : report.violations) list.push_back(violation.message);
  return list;
}

// ---- discrete

discrete::Plan random_plan(Draw& draw, const discrete::Instance& instance) {
  const discrete::Graph& graph = instance.graph();
  discrete::Plan plan;
  for (const discrete::Agent& task : instance.agents()) {
    const auto neighbours = [&](VertexId v) {
      const auto span = graph.neighbours(v);
      return std::vector<VertexId>(span.begin(), span.end());
    };
    discrete::Path path;
    for (const VertexId v : walk(draw, graph.num_vertices(), task.start, task.goal(), neighbours))
      path.insert(path.end(), draw.chance(20) ? 3 : 1, v);
    plan.paths.push_back(path);
  }
  return plan;
}

Json sample(Draw& draw, const discrete::Instance& instance, const discrete::Plan& plan) {
  Json list = Json::array();
  const auto& layout = instance.graph().layout();
  for (int k = 0; layout && k < kSamples && plan.paths.size() > 0; ++k) {
    const AgentId i(
        static_cast<std::size_t>(draw.number(0, static_cast<std::int64_t>(plan.paths.size()) - 1)));
    const auto& path = plan.paths[i];
    const auto t = static_cast<Timestep>(draw.number(0, 25));
    const double share = static_cast<double>(draw.number(0, 7)) / 8;
    const auto from = layout->cell_of(discrete::position(path, t));
    const auto to = layout->cell_of(discrete::position(path, t + 1));
    list.push_back(
        {i.index(), t + share, from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)});
  }
  return list;
}

void make_discrete(const std::string& name, std::uint32_t seed) {
  Draw draw(seed);
  discrete::support::Random random(seed);
  const discrete::Instance instance =
      seed % 4 == 3 ? discrete::support::random_graph(random, 12, 4)
                    : discrete::support::random_grid(random, {3, 9, 30, 1, 6});
  discrete::Plan plan = random_plan(draw, instance);
  if (seed % 3 == 0 && plan.paths.size() > 0) {
    // To the last vertex of the graph, which is a jump from most others.
    plan.paths[AgentId(0)].emplace_back(instance.graph().num_vertices() - 1);
  }
  if (seed % 5 == 0 && plan.paths.size() > 1) plan.paths.resize(plan.paths.size() - 1);
  const auto report = verify(instance, plan);
  PageOptions options;
  options.title = "case " + std::to_string(seed) + " </title><script>&";
  save(name + ".html", page(instance, plan, options));
  Json expected;
  expected["title"] = options.title;
  expected["agents"] = instance.num_agents();
  expected["positions"] = sample(draw, instance, plan);
  expected["violations"] = violations_of(report);
  expected["sumOfCosts"] = report.valid() ? Json(report.sum_of_costs) : Json(nullptr);
  expected["clearances"] = Json::array();
  save(name + ".json", expected.dump());
}

// ---- continuous

continuous::Plan random_plan(Draw& draw, const continuous::Instance& instance) {
  const continuous::Roadmap& roadmap = instance.roadmap();
  continuous::Plan plan;
  for (const AgentId i : instance.agent_ids()) {
    const continuous::Agent& agent = instance.agent(i);
    const auto neighbours = [&](VertexId v) {
      std::vector<VertexId> list;
      for (const auto e : roadmap.out_edges(v)) list.push_back(roadmap.edge(e).to);
      return list;
    };
    continuous::Path path;
    Ticks now = 0;
    for (const VertexId v :
         walk(draw, roadmap.num_vertices(), agent.start, agent.goal(), neighbours)) {
      if (!path.empty())
        for (const auto e : roadmap.out_edges(path.back().vertex))
          if (roadmap.edge(e).to == v) {
            now += instance.duration(instance.class_of(i), e);
            break;
          }
      const Ticks arrive = now;
      if (draw.chance(40)) now += draw.ticks(1, 30);
      path.push_back({v, arrive, now});
    }
    path.back().depart = path.back().arrive;
    plan.paths.push_back(path);
  }
  return plan;
}

/// In units of the input, with the height if there are any.
Json place_of(const continuous::Instance& instance, double x, double y, double z) {
  Json place = {x * kLengthResolution, y * kLengthResolution};
  if (!instance.is_flat()) place.push_back(z * kLengthResolution);
  return place;
}

Json position(const continuous::Instance& instance, const continuous::Path& path, double tick) {
  for (std::size_t k = 0; k < path.size(); ++k) {
    const auto real = [](auto quantity) { return static_cast<double>(quantity.value()); };
    const continuous::Point from = instance.roadmap().position(path[k].vertex);
    const bool is_last = k + 1 == path.size();
    if (is_last || tick <= real(path[k].depart))
      return place_of(instance, real(from.x), real(from.y), real(from.z));
    if (tick > real(path[k + 1].arrive)) continue;
    const continuous::Point to = instance.roadmap().position(path[k + 1].vertex);
    const double begin = real(path[k].depart);
    const double share = (tick - begin) / (real(path[k + 1].arrive) - begin);
    const auto between = [&](continuous::Length a, continuous::Length b) {
      return real(a) + share * real(b - a);
    };
    return place_of(instance, between(from.x, to.x), between(from.y, to.y), between(from.z, to.z));
  }
  return place_of(instance, 0, 0, 0);
}

/// What comes before the place, and the place.
Json entry(std::size_t index, double time, const Json& place) {
  Json list = {index, time};
  list.insert(list.end(), place.begin(), place.end());
  return list;
}

Json sample(Draw& draw, const continuous::Instance& instance, const continuous::Plan& plan) {
  Json list = Json::array();
  for (int k = 0; k < kSamples; ++k) {
    const AgentId i(
        static_cast<std::size_t>(draw.number(0, static_cast<std::int64_t>(plan.paths.size()) - 1)));
    const double tick = static_cast<double>(draw.number(0, 3000)) / 8;
    list.push_back(entry(i.index(), tick * kResolution, position(instance, plan.paths[i], tick)));
  }
  return list;
}

/// [obstacle, time, x, y] at all stops, and [obstacle, time, null] where it is nowhere.
Json obstacles_of(const continuous::Instance& instance) {
  Json list = Json::array();
  for (std::size_t k = 0; k < instance.obstacles().size(); ++k) {
    const auto& [body, path, leaves] = instance.obstacles()[k];
    const auto add = [&](Ticks tick, const continuous::MovingObstacle::Stop* stop) {
      const auto real = [](continuous::Length length) {
        return static_cast<double>(length.value());
      };
      const Json place = stop == nullptr ? Json::array({nullptr})
                                         : place_of(instance, real(stop->at.x), real(stop->at.y),
                                                    real(stop->at.z));
      list.push_back(entry(k, static_cast<double>(tick.value()) * kResolution, place));
    };
    for (const auto& stop : path) {
      add(stop.arrive, &stop);
      add(stop.depart, &stop);
    }
    add(path.front().arrive - 1, nullptr);
    add(path.back().depart + 1, leaves ? nullptr : &path.back());
  }
  return list;
}

/// Per agent whether it is there at its arrival, and a tick later: [agent, arrival, later, there].
Json presence_of(const continuous::Instance& instance, const continuous::Plan& plan) {
  Json list = Json::array();
  for (const AgentId i : instance.agent_ids()) {
    const auto arrival = static_cast<double>(plan.paths[i].back().arrive.value());
    list.push_back(
        {i.index(), arrival * kResolution, (arrival + 1) * kResolution, !instance.agent(i).leaves});
  }
  return list;
}

void make_continuous(const std::string& name, std::uint32_t seed, bool in_space) {
  Draw draw(seed);
  continuous::test::RandomOptions random;
  random.num_agents = 2 + seed % 4;
  random.num_vertices = 8;
  random.polygon_percent = 40;
  random.space_percent = in_space ? 100 : 0;
  random.obstacles_percent = random.leaves_percent = 50;
  const auto drawn = continuous::test::random_instance(seed, random);
  const auto instance =
      continuous::Instance::make(drawn.shared_roadmap(), drawn.agents().items(),
                                 continuous::Resolution(kLengthResolution, kResolution), {},
                                 drawn.obstacles())
          .value();
  const continuous::Plan plan = random_plan(draw, instance);
  const auto report = verify(instance, plan, continuous::kAllClearances);
  save(name + ".html", page(instance, plan, {}));
  Json expected;
  expected["title"] = "Plan of " + std::to_string(instance.num_agents()) + " agents";
  expected["agents"] = instance.num_agents();
  expected["heights"] = !instance.is_flat();
  expected["positions"] = sample(draw, instance, plan);
  expected["obstacles"] = obstacles_of(instance);
  expected["present"] = presence_of(instance, plan);
  expected["violations"] = violations_of(report);
  expected["clearances"] = Json::array();
  for (const auto& c : report.clearances)
    expected["clearances"].push_back(
        {c.agent.index(), c.other.index(), c.gap * kLengthResolution, c.tick * kResolution});
  save(name + ".json", expected.dump());
}

}  // namespace
}  // namespace quadrille::view::test

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: make_pages <folder> <cases>\n";
    return 1;
  }
  const auto cases = static_cast<std::uint32_t>(std::max(1, std::atoi(argv[2])));
  for (std::uint32_t seed = 1; seed <= cases; ++seed) {
    const std::string number = std::to_string(seed);
    quadrille::view::test::make_discrete(std::string(argv[1]) + "/grid-" + number, seed);
    quadrille::view::test::make_continuous(std::string(argv[1]) + "/roadmap-" + number, seed,
                                           false);
    quadrille::view::test::make_continuous(std::string(argv[1]) + "/space-" + number, seed, true);
  }
}
