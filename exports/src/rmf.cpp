// SPDX-License-Identifier: MIT
#include "quadrille/exports/rmf.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "quadrille/continuous/quantise.hpp"
#include "quadrille/exports/exports.hpp"

namespace quadrille::exports {
namespace {

using continuous::Instance;
using continuous::Path;
using continuous::Ticks;
using execution::MoveId;
using execution::Precedence;
using execution::Precedences;
using Json = nlohmann::ordered_json;

/// The same text gives the same 16 bytes (FNV-1a, twice).
Json uuid(std::string_view text) {
  Json bytes = Json::array();
  for (const std::uint64_t seed : {0xcbf29ce484222325U, 0x84222325cbf29ce4U}) {
    std::uint64_t hash = seed;
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
    for (int k = 0; k < 8; ++k) bytes.push_back(hash >> (8 * k) & 0xffU);
  }
  return {{"uuid", bytes}};
}

Json stamp(double time) {
  const auto nanoseconds = std::llround(time * 1e9);
  return {{"sec", nanoseconds / 1'000'000'000}, {"nanosec", nanoseconds % 1'000'000'000}};
}

class Writer {
 public:
  Writer(const Instance& instance, const continuous::Plan& plan, const Precedences& order,
         const RmfHeads& heads)
      : instance_(instance), plan_(plan), order_(order), heads_(heads) {
    for (const AgentId agent : instance.agent_ids())
      blockers_.push_back(std::vector<std::vector<Blocker>>(order.moves[agent].size()));
    for (const Precedence& precedence : order.list)
      if (const auto blocker = blocker_of(order, precedence))
        blockers_[precedence.follower.agent][order.entry(precedence.follower).move].push_back(
            *blocker);
  }

  [[nodiscard]] Json message(AgentId agent) const {
    Json waypoints = Json::array();
    for (std::size_t k = 0; k < plan_.paths[agent].size(); ++k)
      waypoints.push_back(waypoint(agent, k));
    return {
        {"waypoints", waypoints},
        {"start_time", stamp(continuous::in_input_units(instance_.now(), instance_.resolution()))},
        {"plan_id", plan_id(agent)},
        {"workflow", ""}};
  }

 private:
  /// Progress at a time: the nearest float32.
  [[nodiscard]] float level(Ticks time) const {
    return static_cast<float>(
        continuous::in_input_units(time - instance_.now(), instance_.resolution()));
  }
  /// Of who has arrived at a stop.
  [[nodiscard]] float reached(AgentId agent, std::size_t stop) const {
    return level(plan_.paths[agent][stop].depart);
  }
  /// No progress before that time is as much, and that of the end of the move is.
  [[nodiscard]] float required(const Blocker& blocker) const {
    const float end = reached(blocker.leader.agent, blocker.leader.move + 1);
    if (!blocker.until) return end;
    const float more =
        std::nextafter(level(*blocker.until), std::numeric_limits<float>::infinity());
    return std::min(more, end);
  }

  [[nodiscard]] Json plan_id(AgentId agent) const {
    return {{"destination_session", uuid(heads_.session + "/" + heads_.robots[agent])},
            {"plan_version", 0}};
  }
  [[nodiscard]] Json position(VertexId v) const {
    const auto& p = instance_.roadmap().position(v);
    const auto number = [&](continuous::Length length) {
      return static_cast<float>(continuous::in_input_units(length, instance_.resolution()));
    };
    return {number(p.x), number(p.y)};
  }
  [[nodiscard]] Json node(VertexId v) const {
    Json name = Json::array();
    if (v.index() < heads_.names.vertices.size()) {
      const Json known = Json::parse(heads_.names.vertices[v.index()]);
      name.push_back(known.is_string() ? known.get<std::string>() : known.dump());
    }
    return {{"graph_name", heads_.graph},
            {"key", {v.value()}},
            {"name", name},
            {"map", {heads_.map}},
            {"element_type", 1}};
  }

  [[nodiscard]] Json waypoint(AgentId agent, std::size_t k) const {
    const Path& path = plan_.paths[agent];
    const VertexId v = path[k].vertex;
    Json blockers = Json::array(), trajectories = Json::array(), nodes = Json::array();
    // A place in the middle of a move is none of the graph.
    if (instance_.roadmap().lane_place(v) == nullptr)
      nodes.push_back({{"key", node(v)}, {"orientations", Json::array()}});
    if (k + 1 < path.size()) {
      for (const Blocker& blocker : blockers_[agent][k])
        blockers.push_back({{"name", heads_.robots[blocker.leader.agent]},
                            {"plan_id", plan_id(blocker.leader.agent)},
                            {"required_progress", required(blocker)}});
      trajectories.push_back(trajectory(path[k], path[k + 1]));
    }
    return {{"position", position(v)},
            {"arrival_constraints", {{"regions", Json::array()}, {"nodes", nodes}}},
            {"progress", reached(agent, k)},
            {"maps", {heads_.map}},
            {"departure_blockers", blockers},
            {"departure_trajectory", trajectories},
            {"departure_action", ""},
            {"arrival_action", ""}};
  }
  /// A straight line; knots are times since its beginning.
  [[nodiscard]] Json trajectory(const continuous::Stop& from, const continuous::Stop& to) const {
    const auto time = static_cast<float>(
        continuous::in_input_units(to.arrive - from.depart, instance_.resolution()));
    const auto point = [&](VertexId v) {
      return Json{{"position", position(v)}, {"weight", 1.0F}};
    };
    return {{"curve",
             {{"degree", 1},
              {"control_points", {point(from.vertex), point(to.vertex)}},
              {"knots", {0.0F, 0.0F, time, time}}}},
            {"initial_progress_level", level(from.depart)},
            {"final_progress_level", level(to.arrive)},
            {"maps", {heads_.map}},
            {"keys", Json::array()}};
  }

  const Instance& instance_;
  const continuous::Plan& plan_;
  const Precedences& order_;
  const RmfHeads& heads_;
  IdVector<AgentId, std::vector<std::vector<Blocker>>> blockers_;  // by move
};

/// Numbers moves, one agent's after the other's.
class MoveNumbers {
 public:
  explicit MoveNumbers(const Precedences& order) {
    for (const auto& moves : order.moves) {
      first_.push_back(count_);
      count_ += moves.size();
    }
  }
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::size_t of(const MoveId& id) const { return first_[id.agent] + id.move; }
  [[nodiscard]] MoveId at(std::size_t number) const {
    const auto next = std::upper_bound(first_.begin(), first_.end(), number);
    const auto agent = static_cast<std::size_t>(next - first_.begin()) - 1;
    return {AgentId(agent), static_cast<std::uint32_t>(number - first_[AgentId(agent)])};
  }

 private:
  IdVector<AgentId, std::size_t> first_;
  std::size_t count_ = 0;
};

}  // namespace

std::optional<Blocker> blocker_of(const Precedences& order, const Precedence& precedence) {
  const auto& moves = order.moves[precedence.leader.agent];
  const Ticks needed = order.at(precedence.follower).end - precedence.slack;
  if (needed >= order.at(precedence.leader).end) return Blocker{precedence.leader, {}};
  for (std::uint32_t k = precedence.leader.move + 1; k-- > 0;) {
    if (needed <= moves[k].begin) continue;
    const MoveId leader{precedence.leader.agent, k};
    if (needed >= moves[k].end) return Blocker{leader, {}};
    return Blocker{leader, needed};
  }
  return std::nullopt;
}

std::string export_rmf_plan(const Instance& instance, const continuous::Plan& plan,
                            const Precedences& order, const RmfHeads& heads) {
  const Writer writer(instance, plan, order, heads);
  JsonLines lines;
  for (const AgentId agent : instance.agent_ids())
    lines.add(Json({{"name", heads.robots[agent]}, {"plan", writer.message(agent)}}).dump());
  return lines.text();
}

std::vector<MoveId> blocked_for_ever(const Precedences& order) {
  const MoveNumbers numbers(order);
  // Which moves have to have begun before each one begins.
  std::vector<std::vector<std::size_t>> before(numbers.count()), after(numbers.count());
  const auto add = [&](std::size_t first, std::size_t second) {
    before[second].push_back(first);
    after[first].push_back(second);
  };
  for (const AgentId agent : IdRange<AgentId>(order.num_agents()))
    for (std::uint32_t k = 1; k < order.moves[agent].size(); ++k)
      add(numbers.of({agent, k - 1}), numbers.of({agent, k}));
  for (const Precedence& precedence : order.list)
    if (const auto blocker = blocker_of(order, precedence))
      add(numbers.of(blocker->leader), numbers.of(order.entry(precedence.follower)));
  std::vector<std::size_t> waits(numbers.count()), ready;
  for (std::size_t m = 0; m < waits.size(); ++m) {
    waits[m] = before[m].size();
    if (waits[m] == 0) ready.push_back(m);
  }
  for (std::size_t k = 0; k < ready.size(); ++k)
    for (const std::size_t next : after[ready[k]])
      if (--waits[next] == 0) ready.push_back(next);
  if (ready.size() == waits.size()) return {};
  // From any that waits, back along those that wait, until one comes twice.
  const auto stuck = [&](std::size_t m) { return waits[m] > 0; };
  std::size_t at = 0;
  while (!stuck(at)) ++at;
  std::vector<std::size_t> way, place(waits.size(), SIZE_MAX);
  while (place[at] == SIZE_MAX) {
    place[at] = way.size();
    way.push_back(at);
    at = *std::find_if(before[at].begin(), before[at].end(), stuck);
  }
  std::vector<MoveId> cycle;
  for (std::size_t k = way.size(); k-- > place[at];) cycle.push_back(numbers.at(way[k]));
  return cycle;
}

}  // namespace quadrille::exports
