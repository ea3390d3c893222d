// SPDX-License-Identifier: MIT
#include "quadrille/discrete/session.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include "quadrille/discrete/verify.hpp"
#include "session/history.hpp"
#include "session/mending.hpp"

namespace quadrille::discrete {
namespace {

using Closed = AnswerDomain::Closed;

Error invalid(const std::string& message) { return {ErrorCode::invalid_instance, message, {}}; }

Error no_member(MemberId member) {
  return invalid("there is no member " + std::to_string(member.index()));
}

Closed closed_of(VertexId vertex, std::optional<VertexId> to) {
  return to && *to < vertex ? Closed{*to, vertex} : Closed{vertex, to};
}

std::string name(const Graph& graph, VertexId vertex, std::optional<VertexId> to) {
  if (!to) return "vertex " + vertex_name(graph, vertex);
  return "the edge between " + vertex_name(graph, vertex) + " and " + vertex_name(graph, *to);
}

/// What a session asks for besides, to be kept.
bool may_explain(const Instance& instance, const SolveOptions& options) {
  return instance.is_plain() && options.system == System::dpll && !options.proof &&
         options.objective == Objective::sum_of_costs;
}

}  // namespace

struct Session::Parts {
  [[nodiscard]] std::optional<Error> refuse(const Agent& agent) const;
  [[nodiscard]] bool has(VertexId vertex, std::optional<VertexId> to) const;
  /// What is known of the cost; 0: nothing.
  [[nodiscard]] Cost bound(const Instance& instance, Objective objective) const;

  std::shared_ptr<const Graph> graph;
  Rules rules;
  std::size_t num_added = 0;
  Situation now = {};
  BoundCache answers = {};
};

std::optional<Error> Session::Parts::refuse(const Agent& agent) const {
  std::vector<VertexId> all{agent.start};
  all.insert(all.end(), agent.goals.vertices().begin(), agent.goals.vertices().end());
  if (all.size() == 1) return invalid("a member has no goal");
  all.insert(all.end(), agent.waypoints.begin(), agent.waypoints.end());
  for (const VertexId v : all)
    if (v.index() >= graph->num_vertices())
      return invalid("there is no vertex " + std::to_string(v.index()));
  return std::nullopt;
}

bool Session::Parts::has(VertexId vertex, std::optional<VertexId> to) const {
  const auto exists = [&](VertexId v) { return v.index() < graph->num_vertices(); };
  if (!exists(vertex) || (to && !exists(*to))) return false;
  return !to || graph->adjacent(vertex, *to) || graph->adjacent(*to, vertex);
}

Cost Session::Parts::bound(const Instance& instance, Objective objective) const {
  auto groups = answers.bounds(now, objective);
  if (groups.empty()) return 0;
  IdVector<AgentId, Cost> free_costs(instance.num_agents(), 0);
  for (const AgentId i : instance.agent_ids()) {
    const Agent& agent = instance.agents()[i];
    const auto way = distances_to_nearest(instance.graph(), agent.goals)[agent.start];
    if (way != kUnreachable) free_costs[i] = way;
  }
  return solve::bound_of_all(std::move(groups), free_costs, objective);
}

Session::Session(std::shared_ptr<const Graph> graph, Timestep now, Rules rules)
    : parts_(std::make_unique<Parts>(Parts{std::move(graph), std::move(rules)})) {
  QUADRILLE_REQUIRE(parts_->graph != nullptr, "a session has a graph");
  parts_->now.begin = now;
}

Session::~Session() = default;
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;

Result<MemberId> Session::add(const Agent& agent) {
  if (auto error = parts_->refuse(agent)) return *std::move(error);
  const MemberId member(parts_->num_added);
  parts_->now.tasks.emplace(member, agent);
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
  at->second = agent;
  return std::nullopt;
}

std::optional<Error> Session::assign(MemberId member, const Goals& goals) {
  const auto at = parts_->now.tasks.find(member);
  if (at == parts_->now.tasks.end()) return no_member(member);
  Agent agent = at->second;
  agent.goals = goals;
  return change(member, agent);
}

std::optional<Error> Session::advance_to(Timestep now, const Plan& plan) {
  const Timestep begin = parts_->now.begin;
  if (now < begin || now > kMaxNow)
    return Error{ErrorCode::out_of_range,
                 now < begin
                     ? "time goes back from " + std::to_string(begin) + " to " + std::to_string(now)
                     : "time goes on to " + std::to_string(now) + ", and at most to " +
                           std::to_string(kMaxNow),
                 {}};
  if (parts_->rules.turn > 0)
    return Error{ErrorCode::out_of_range,
                 "where turns take time, plans do not say how far somebody has turned",
                 {}};
  const auto instance = this->instance();
  if (!instance) return instance.error();
  const VerifyReport found = verify(*instance, plan);
  if (!found.valid()) return Error{ErrorCode::invalid_plan, found.violations.front().message, {}};
  if (now == begin) return std::nullopt;
  const Timestep time = now - begin;
  const auto rest = [&](const Agent& agent, const Later& done, AgentId i) -> std::optional<Agent> {
    if (done.ends && agent.leaves) return std::nullopt;
    return rest_of(agent, plan.paths[i], time);
  };
  History history = solve::follow(parts_->now, plan, now, time, rest);
  // What was done and what is left, together, may come too close where they meet.
  if (parts_->rules.robust > 0)
    parts_->answers.clear();
  else
    parts_->answers.advance(history);
  parts_->now = std::move(history.after);
  return std::nullopt;
}

std::optional<Error> Session::close(VertexId vertex, std::optional<VertexId> to) {
  if (!parts_->has(vertex, to)) return invalid("there is no such place to close");
  if (!parts_->now.closed.insert(closed_of(vertex, to)).second)
    return invalid(name(*parts_->graph, vertex, to) + " is closed already");
  return std::nullopt;
}

std::optional<Error> Session::open(VertexId vertex, std::optional<VertexId> to) {
  if (!parts_->has(vertex, to)) return invalid("there is no such place to open");
  if (parts_->now.closed.erase(closed_of(vertex, to)) == 0)
    return invalid(name(*parts_->graph, vertex, to) + " is not closed");
  return std::nullopt;
}

std::vector<MemberId> Session::members() const { return parts_->now.members(); }

const Agent& Session::agent(MemberId member) const {
  const auto at = parts_->now.tasks.find(member);
  QUADRILLE_REQUIRE(at != parts_->now.tasks.end(), "a member of the session");
  return at->second;
}

bool Session::is_closed(VertexId vertex, std::optional<VertexId> to) const {
  return parts_->now.closed.contains(closed_of(vertex, to));
}

Timestep Session::now() const noexcept { return parts_->now.begin; }

Result<Instance> Session::instance() const {
  std::vector<Agent> agents;
  for (const auto& [member, agent] : parts_->now.tasks) agents.push_back(agent);
  Rules rules = parts_->rules;
  for (const auto& [vertex, to] : parts_->now.closed)
    rules.blockages.push_back({vertex, to, parts_->now.begin, std::nullopt});
  return Instance::make(parts_->graph, std::move(agents), parts_->now.begin, std::move(rules));
}

Result<SolveOutcome> Session::solve(const SolveOptions& options) {
  const auto instance = this->instance();
  if (!instance) return instance.error();
  SolveOptions asked = options;
  asked.explain = options.explain || may_explain(*instance, options);
  bool is_kept = false;  // the bound to begin with
  if (!options.proof) {
    const Cost bound = parts_->bound(*instance, options.objective);
    is_kept = bound > 0 && bound >= options.known_lower_bound.value_or(0);
    if (is_kept) asked.known_lower_bound = bound;
  }
  if (!options.initial_plan) {
    LimitMonitor limits(options.limits);
    for (auto& paths : parts_->answers.drafts(parts_->now, *instance))
      if (!asked.initial_plan)
        asked.initial_plan = mend(*instance, std::move(paths), options.seed, limits);
    // One limit for both.
    if (asked.limits.wall_s)
      asked.limits.wall_s = std::max(0.0, *asked.limits.wall_s - limits.elapsed_wall());
    if (asked.limits.cpu_s)
      asked.limits.cpu_s = std::max(0.0, *asked.limits.cpu_s - limits.elapsed_cpu());
  }
  auto outcome = discrete::solve(*instance, asked);
  if (!outcome) return outcome;
  const bool rests_on_kept = is_kept && outcome->rests_on_known_bound;
  if (rests_on_kept) outcome->rests_on_known_bound = false;
  // What an explanation is about is what was proved this time.
  SolveOutcome learned = *outcome;
  if (rests_on_kept) learned.attribution.reset();
  parts_->answers.add(parts_->now, options.objective, learned);
  if (!options.explain) outcome->attribution.reset();
  return outcome;
}

}  // namespace quadrille::discrete
