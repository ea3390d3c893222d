// SPDX-License-Identifier: MIT
#include "quadrille/continuous/session.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "quadrille/continuous/quantise.hpp"
#include "quadrille/continuous/under_way.hpp"
#include "quadrille/continuous/verify.hpp"
#include "session/bound_cache.hpp"
#include "session/history.hpp"
#include "session/lemma_store.hpp"
#include "solve/warm_start.hpp"
#include "traffic/scene_store.hpp"

namespace quadrille::continuous {
namespace {

Error invalid(const std::string& message) { return {ErrorCode::invalid_instance, message, {}}; }

std::string name(MemberId member) { return "member " + std::to_string(member.index()); }
std::string name(EdgeId edge) { return "edge " + std::to_string(edge.index()); }

Error no_member(MemberId member) { return invalid("there is no " + name(member)); }

/// What the agent still has to do.
Task rest_of(const Task& task, const Later& done, const Instance& instance, AgentId i) {
  Task rest = task;
  if (!done.moves) {
    rest.under_way.reset();
    rest.agent.under_way = false;
    rest.agent.start = done.at;
    return rest;
  }
  rest.agent.under_way = true;
  rest.agent.release = 0;
  if (done.is_first && task.under_way) {
    rest.under_way->behind += done.begun;
    return rest;
  }
  const ClassId c = instance.class_of(i);
  const Ticks whole = done.begun + done.rest[1].arrive;
  const auto out = instance.out_edges(c, done.at);
  const auto edge = std::find_if(out.begin(), out.end(), [&](EdgeId e) {
    return instance.roadmap().to(e) == done.to && instance.duration(c, e) == whole;
  });
  QUADRILLE_REQUIRE(edge != out.end(), "a valid plan moves along edges");
  rest.agent.start = done.at;
  rest.under_way = {*edge, done.begun};
  return rest;
}

}  // namespace

struct Session::Parts {
  Parts(std::shared_ptr<const Roadmap> the_roadmap, Resolution the_resolution,
        std::vector<MovingObstacle> the_obstacles, Ticks the_begin)
      : roadmap(std::move(the_roadmap)),
        resolution(the_resolution),
        obstacles(std::move(the_obstacles)),
        store(roadmap),
        lemmas(roadmap) {
    now.begin = the_begin;
  }

  /// Of an instance that begins at 0.
  [[nodiscard]] Result<SolveOutcome> solve(const Instance& instance, const SolveOptions& options);
  [[nodiscard]] std::optional<Error> refuse(const Agent& agent) const;
  [[nodiscard]] std::optional<Ticks> duration(const Edge& edge, const Agent& agent) const;
  /// The roadmap as it is now, and the agents with their starts on it.
  [[nodiscard]] std::shared_ptr<const Roadmap> roads(std::vector<Agent>& agents) const;

  std::shared_ptr<const Roadmap> roadmap;
  Resolution resolution;
  std::vector<MovingObstacle> obstacles;
  bool whole_moves = false;
  std::size_t num_added = 0;
  Situation now;
  // What is learned is in the times of searches, which count from `now.begin`.
  SceneStore store;
  BoundCache bounds;
  LemmaStore lemmas;
};

std::optional<Error> Session::Parts::refuse(const Agent& agent) const {
  std::vector<VertexId> ends{agent.start};
  ends.insert(ends.end(), agent.goals.vertices().begin(), agent.goals.vertices().end());
  for (const VertexId v : ends)
    if (v.index() >= roadmap->num_vertices())
      return invalid("there is no vertex " + std::to_string(v.index()));
  if (ends.size() == 1) return invalid("a member has no goal");
  if (agent.under_way) return invalid("a member is put under way by its edge");
  if (agent.overlaps_at_start) return invalid("members do not overlap at their starts");
  return std::nullopt;
}

std::optional<Ticks> Session::Parts::duration(const Edge& edge, const Agent& agent) const {
  return travel_time(*roadmap, edge, agent.speed);
}

std::shared_ptr<const Roadmap> Session::Parts::roads(std::vector<Agent>& agents) const {
  RoadmapParts parts(*roadmap);
  for (const auto& [member, task] : now.tasks) {
    agents.push_back(task.agent);
    if (!task.under_way) continue;
    const Edge& edge = roadmap->edge(task.under_way->edge);
    const Ticks whole = duration(edge, task.agent).value();
    agents.back().start = add_lane_place(parts, edge.from, edge.to, whole, task.under_way->behind);
  }
  const bool has_places = parts.vertices.size() > roadmap->num_vertices();
  if (!has_places && now.closed.empty()) return roadmap;
  const std::vector<EdgeId> closed(now.closed.begin(), now.closed.end());
  // Places lie between points that are in range.
  return std::make_shared<const Roadmap>(has_places
                                             ? std::move(parts).make().value().with_closed(closed)
                                             : roadmap->with_closed(closed));
}

Session::Session(std::shared_ptr<const Roadmap> roadmap, Resolution resolution,
                 std::vector<MovingObstacle> obstacles, Ticks now, bool whole_moves) {
  QUADRILLE_REQUIRE(roadmap != nullptr, "a session has a roadmap");
  parts_ = std::make_unique<Parts>(std::move(roadmap), resolution, std::move(obstacles), now);
  parts_->whole_moves = whole_moves;
}

Session::~Session() = default;
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;

Result<MemberId> Session::add(const Agent& agent) {
  if (auto error = parts_->refuse(agent)) return *std::move(error);
  const MemberId member(parts_->num_added);
  parts_->now.tasks.emplace(member, Task{agent});
  ++parts_->num_added;
  return member;
}

std::optional<Error> Session::remove(MemberId member) {
  if (parts_->now.tasks.erase(member) == 0) return no_member(member);
  return std::nullopt;
}

std::optional<Error> Session::change(MemberId member, const Agent& agent) {
  const auto at = parts_->now.tasks.find(member);
  if (at == parts_->now.tasks.end()) return no_member(member);
  if (auto error = parts_->refuse(agent)) return error;
  at->second = {agent, std::nullopt};
  return std::nullopt;
}

std::optional<Error> Session::put_under_way(MemberId member, EdgeId edge, Ticks behind) {
  const auto at = parts_->now.tasks.find(member);
  if (at == parts_->now.tasks.end()) return no_member(member);
  if (edge.index() >= parts_->roadmap->num_edges()) return invalid("there is no " + name(edge));
  const Edge& on = parts_->roadmap->edge(edge);
  Agent agent = at->second.agent;
  if (!on.open_to.contains(agent.group)) return invalid(name(edge) + " is not for " + name(member));
  const auto whole = parts_->duration(on, agent);
  if (!whole || behind < 0 || behind >= *whole)
    return Error{ErrorCode::out_of_range,
                 name(member) + " cannot have " + std::to_string(behind.value()) + " ticks of " +
                     name(edge) + " behind it, which takes " +
                     (whole ? std::to_string(whole->value()) : "too few or too many"),
                 {}};
  agent.start = on.from;
  agent.under_way = true;
  agent.release = 0;
  at->second = {agent, UnderWay{edge, behind}};
  return std::nullopt;
}

std::optional<Error> Session::assign(MemberId member, const Goals& goals) {
  const auto at = parts_->now.tasks.find(member);
  if (at == parts_->now.tasks.end()) return no_member(member);
  Agent agent = at->second.agent;
  agent.goals = goals;
  agent.under_way = false;
  if (auto error = parts_->refuse(agent)) return error;
  at->second.agent.goals = goals;
  return std::nullopt;
}

std::optional<Error> Session::advance_to(Ticks now, const Plan& plan) {
  const Ticks begin = parts_->now.begin;
  if (now < begin)
    return Error{ErrorCode::out_of_range,
                 "time goes back from " + std::to_string(begin.value()) + " to " +
                     std::to_string(now.value()),
                 {}};
  const auto instance = this->instance();
  if (!instance) return instance.error();
  const VerifyReport found = verify(*instance, plan);
  if (!found.valid()) return Error{ErrorCode::invalid_plan, found.violations.front().message, {}};
  if (now == begin) return std::nullopt;
  const auto rest = [&](const Task& task, const Later& done, AgentId i) -> std::optional<Task> {
    if (done.ends && task.agent.leaves) return std::nullopt;
    return rest_of(task, done, *instance, i);
  };
  History history = solve::follow(parts_->now, plan, now, now, rest);
  parts_->bounds.advance(history);
  parts_->now = std::move(history.after);
  return std::nullopt;
}

std::optional<Error> Session::close(EdgeId edge) {
  if (edge.index() >= parts_->roadmap->num_edges()) return invalid("there is no " + name(edge));
  if (!parts_->now.closed.insert(edge).second) return invalid(name(edge) + " is closed already");
  return std::nullopt;
}

std::optional<Error> Session::open(EdgeId edge) {
  if (parts_->now.closed.erase(edge) == 0) return invalid(name(edge) + " is not closed");
  return std::nullopt;
}

std::vector<MemberId> Session::members() const { return parts_->now.members(); }

const Agent& Session::agent(MemberId member) const {
  const auto at = parts_->now.tasks.find(member);
  QUADRILLE_REQUIRE(at != parts_->now.tasks.end(), "a member of the session");
  return at->second.agent;
}

bool Session::is_closed(EdgeId edge) const { return parts_->now.closed.contains(edge); }

Ticks Session::now() const noexcept { return parts_->now.begin; }

Result<Instance> Session::instance() const {
  std::vector<Agent> agents;
  auto roads = parts_->roads(agents);
  auto made = Instance::make(std::move(roads), std::move(agents), parts_->resolution, {},
                             parts_->obstacles, parts_->now.begin);
  if (!made) return made;
  return made->with_whole_moves(parts_->whole_moves);
}

Result<SolveOutcome> Session::solve(const SolveOptions& options) {
  const auto instance = this->instance();
  if (!instance) return instance.error();
  return search_from_0(*instance, options,
                       [this](const Instance& from_0, const SolveOptions& asked) {
                         return parts_->solve(from_0, asked);
                       });
}

Result<SolveOutcome> Session::Parts::solve(const Instance& instance, const SolveOptions& options) {
  store.adopt(instance);
  std::optional<Learned> learned;
  const WarmStart warm{&store, bounds.bounds(now, options.objective), bounds.drafts(now, instance),
                       lemmas.learned(now), &learned};
  SolveOptions traced = options;
  traced.explain = options.explain || options.threads == 1;
  auto outcome = solve_from_0(instance, traced, warm);
  if (!outcome) return outcome;
  bounds.add(now, options.objective, *outcome);
  if (learned && !outcome->internal_error) lemmas.put(now, *std::move(learned));
  if (!options.explain) outcome->attribution.reset();
  return outcome;
}

}  // namespace quadrille::continuous
