// SPDX-License-Identifier: MIT
#include "theory/lemma_auditor.hpp"

#include <algorithm>
#include <utility>

#include "model/parked.hpp"
#include "theory/pair_replay.hpp"
#include "theory/path_replay.hpp"

namespace quadrille::continuous {
namespace {

using Kind = Model::VariableKind;

/// Of lemmas of pairs.
constexpr std::size_t kMaxStates = 200'000;

bool contains(std::span<const sat::Lit> clause, sat::Lit lit) {
  return std::find(clause.begin(), clause.end(), lit) != clause.end();
}

}  // namespace

LemmaAuditor::LemmaAuditor(const Model& model, bool derive, const std::optional<Plan>& known_plan)
    : ClauseAuditor(derive, known_plan.has_value()), model_(model) {
  if (!known_plan) return;
  const Instance& instance = model.instance();
  for (const AgentId i : instance.agent_ids()) {
    paths_.push_back(without_stops(instance, i, known_plan->paths[i]));
    PathUses uses;
    uses.assign(instance, i, paths_[i]);
    uses_.push_back(uses);
  }
}

std::string LemmaAuditor::audit(const sat::Lemma& lemma) {
  ++num_derived_;
  if (const auto* path = std::get_if<sat::why::Path>(&lemma.why))
    return audit_path(lemma, path->agent);
  if (lemma.is<sat::why::Moves>() || lemma.is<sat::why::Stay>() || lemma.is<sat::why::Goal>())
    return audit_collision(lemma);
  if (lemma.is<sat::why::Rest>()) return audit_rest(lemma);
  if (const auto* taken = std::get_if<sat::why::Taken>(&lemma.why))
    return audit_taken(lemma, taken->goal);
  if (lemma.is<sat::why::Pair>()) return audit_pair(lemma);
  if (lemma.is<sat::why::Order>() || lemma.is<sat::why::Ceiling>()) return audit_order(lemma);
  return "continuous time has no such lemmas";
}

std::optional<bool> LemmaAuditor::find_in_plan(sat::Lit lit) const {
  const auto meaning = model_.variable(lit);
  switch (meaning.kind) {
    case Kind::cost:
      return (as_cost(paths_[meaning.agent].arrival) >= meaning.cost) == lit.positive();
    case Kind::usage:  // the variable forbids
      return uses_[meaning.agent].breaks(model_.obstacles()[meaning.obstacle].bans) !=
             lit.positive();
    case Kind::rest: {
      const TimedPath& path = paths_[meaning.agent];
      const bool rests = uses_[meaning.agent].breaks(Ban::end(meaning.goal)) &&
                         as_cost(path.arrival) < meaning.cost;
      return rests == lit.positive();
    }
    case Kind::left_over:
      return std::none_of(uses_.begin(), uses_.end(), [&](const PathUses& uses) {
               return uses.breaks(Ban::end(meaning.goal));
             }) == lit.positive();
    case Kind::auxiliary:
    case Kind::own:
      break;
  }
  return std::nullopt;
}

std::string LemmaAuditor::describe(Clause clause) const {
  std::string text;
  for (const sat::Lit lit : clause) text += " " + std::to_string(lit.dimacs());
  return text;
}

std::string LemmaAuditor::audit_usages(const sat::Lemma& lemma) const {
  for (const sat::Usage& usage : lemma.usages) {
    if (usage.resource >= model_.obstacles().size()) return "a lemma names an unknown obstacle";
    const Obstacle& o = obstacle(usage);
    if (o.agent != usage.agent) return "a lemma mistakes the agent of an obstacle";
    const auto meaning = model_.variable(o.allowed);
    if (meaning.kind == Kind::cost || meaning.kind == Kind::rest) {
      const bool is_rest = meaning.kind == Kind::rest;
      const Goals& goals = model_.instance().agent(meaning.agent).goals;
      if (o.allowed.positive() == is_rest || meaning.agent == o.agent ||
          (!is_rest && !goals.is_single()))
        return "an obstacle has a literal that says something else";
      if (std::string wrong = audit_goal_bans(
              o, meaning.agent, is_rest ? meaning.goal : goals.only(), as_ticks(meaning.cost));
          !wrong.empty())
        return wrong;
    } else if (meaning.kind != Kind::usage || o.allowed.positive() ||
               meaning.obstacle.index() != usage.resource) {
      return "an obstacle has the literal of another one";
    }
  }
  return "";
}

// The resident is at its goal from tick - 1 at the latest. What begins later meets no less of that.
std::string LemmaAuditor::audit_goal_bans(const Obstacle& o, AgentId resident, VertexId goal,
                                          Ticks tick) const {
  const Instance& instance = model_.instance();
  if (instance.agent(resident).leaves) return "an agent that leaves is said to stay at its goal";
  for (const Ban& ban : o.bans) {
    bool holds = false;
    if (ban.kind == Ban::Kind::stay) {
      holds = ban.when.begin >= tick - 1 && overlap(o.agent, VertexId(ban.place), resident, goal);
    } else {
      const Ticks duration = instance.duration(instance.class_of(o.agent), EdgeId(ban.place));
      const Ticks arrive = std::max(ban.when.begin, tick - 1);
      const Ticks leave = ban.when.begin + duration;
      holds = arrive <= leave &&
              collides(o.agent, EdgeId(ban.place), ban.when.begin, resident, goal, arrive, leave);
    }
    if (!holds) return "an agent may pass where another one stands at its goal";
  }
  return "";
}

std::string LemmaAuditor::audit_path(const sat::Lemma& lemma, AgentId i) const {
  if (lemma.usages.empty()) return "a path lemma without obstacles";
  if (std::string wrong = audit_usages(lemma); !wrong.empty()) return wrong;
  std::vector<Ban> bans;
  for (const sat::Usage& usage : lemma.usages) {
    const Obstacle& o = obstacle(usage);
    if (o.agent != i) return "a path lemma of several agents";
    if (!contains(lemma.clause, o.allowed)) return "a path lemma lacks the literal of an obstacle";
    bans.insert(bans.end(), o.bans.begin(), o.bans.end());
  }
  Ticks bound = kForever;
  for (const sat::Lit lit : lemma.clause) {
    const auto meaning = model_.variable(lit);
    if (meaning.kind == Kind::cost && meaning.agent == i && lit.positive())
      bound = std::min(bound, as_ticks(meaning.cost));
  }
  const std::vector<Ban>& standing = model_.standing_bans(i);
  bans.insert(bans.end(), standing.begin(), standing.end());
  return PathReplay(model_.instance(), i, bans).has_path(bound) ? "some path breaks a path lemma"
                                                                : "";
}

std::string LemmaAuditor::audit_collision(const sat::Lemma& lemma) const {
  if (std::string wrong = audit_usages(lemma); !wrong.empty()) return wrong;
  if (lemma.usages.size() != 2 || lemma.clause.size() != 2) return "a collision has two sides";
  const Obstacle &a = obstacle(lemma.usages[0]), &b = obstacle(lemma.usages[1]);
  if (a.agent == b.agent) return "a collision has two agents";
  if (!contains(lemma.clause, ~a.allowed) || !contains(lemma.clause, ~b.allowed))
    return "a collision lemma does not say what its obstacles say";
  for (const Ban& x : a.bans)
    for (const Ban& y : b.bans)
      if (!all_collide(a.agent, x, b.agent, y))
        return "two agents can do what a collision lemma says they cannot";
  return "";
}

// Unsafe offsets have no gaps and contacts neither, so that the extreme cases decide.
bool LemmaAuditor::all_collide(AgentId i, const Ban& a, AgentId j, const Ban& b) const {
  if (a.is_end() && b.is_end()) return overlap(i, VertexId(a.place), j, VertexId(b.place));
  if (a.kind == Ban::Kind::stay) return b.kind == Ban::Kind::start && all_collide(j, b, i, a);
  if (a.when.end >= kForever || b.when.end >= kForever) return false;
  if (b.kind == Ban::Kind::start) {
    ShapePairs pair = bodies(i, j);
    const ShapePairs::Move e = move(i, a.place), f = move(j, b.place);
    return pair.collide(e, f, b.when.first() - a.when.last()) &&
           pair.collide(e, f, b.when.last() - a.when.first());
  }
  // Of the stays that break b, each contains one of a tick or less.
  const Ticks early = b.when.begin + 1, late = b.when.end - 1;
  for (const Ticks s : {a.when.first(), a.when.last()})
    if (!collides(i, EdgeId(a.place), s, j, VertexId(b.place), std::min(early, late), early) ||
        !collides(i, EdgeId(a.place), s, j, VertexId(b.place), late, std::max(early, late)))
      return false;
  return true;
}

bool LemmaAuditor::collides(AgentId i, EdgeId e, Ticks start, AgentId j, VertexId place,
                            Ticks arrive, Ticks leave) const {
  ShapePairs pair = bodies(i, j);
  if (ParkedPlaces(model_.instance()).may_move(e, place, pair)) return false;
  const ShapePairs::Stand there = stand(place);
  return pair.collide(move(i, e.value()),
                      {there.shape, geometry::rest(there.place, leave - arrive)}, arrive - start);
}

bool LemmaAuditor::overlap(AgentId i, VertexId v, AgentId j, VertexId w) const {
  return !ParkedPlaces(model_.instance()).may_stand(v, w) &&
         bodies(i, j).overlap(stand(v), stand(w));
}

ShapePairs LemmaAuditor::bodies(AgentId i, AgentId j) const {
  const Instance& instance = model_.instance();
  return shape_pairs(instance, instance.class_of(i), instance.class_of(j));
}

ShapePairs::Move LemmaAuditor::move(AgentId i, std::uint32_t edge) const {
  const Instance& instance = model_.instance();
  return move_of(instance, instance.class_of(i), EdgeId(edge));
}

ShapePairs::Stand LemmaAuditor::stand(VertexId v) const {
  return stand_at(model_.instance().roadmap(), v);
}

std::string LemmaAuditor::audit_pair(const sat::Lemma& lemma) {
  if (std::string wrong = audit_usages(lemma); !wrong.empty()) return wrong;
  PairReplay::Party parties[2];
  for (const std::size_t side : {0U, 1U}) {
    const auto meaning =
        side < lemma.clause.size() ? model_.variable(lemma.clause[side]) : Model::Variable{};
    if (meaning.kind != Kind::cost || !lemma.clause[side].positive())
      return "a lemma of a pair begins with two costs";
    parties[side] = {meaning.agent, as_ticks(meaning.cost), model_.standing_bans(meaning.agent)};
  }
  if (parties[0].agent == parties[1].agent) return "a pair has two agents";
  for (const sat::Usage& usage : lemma.usages) {
    const Obstacle& o = obstacle(usage);
    if (!contains(lemma.clause, o.allowed))
      return "a lemma of a pair lacks the literal of an obstacle";
    const std::size_t side = usage.agent == parties[0].agent ? 0 : 1;
    if (usage.agent != parties[side].agent) return "a lemma of a pair has an obstacle of a third";
    parties[side].bans.insert(parties[side].bans.end(), o.bans.begin(), o.bans.end());
  }
  const auto has_plan = PairReplay(model_.instance(), parties[0], parties[1]).has_plan(kMaxStates);
  if (!has_plan) ++num_skipped_;
  return has_plan.value_or(false) ? "some plan breaks a lemma of a pair" : "";
}

std::string LemmaAuditor::audit_rest(const sat::Lemma& lemma) const {
  if (lemma.clause.size() != 3) return "a rest has three sides";
  const auto ends = model_.variable(lemma.clause[0]), late = model_.variable(lemma.clause[1]),
             rests = model_.variable(lemma.clause[2]);
  const bool is_of_one = ends.agent == rests.agent && late.agent == rests.agent;
  const bool holds = ends.kind == Kind::usage && lemma.clause[0].positive() &&
                     model_.obstacles()[ends.obstacle].bans == std::vector{Ban::end(rests.goal)} &&
                     late.kind == Kind::cost && lemma.clause[1].positive() &&
                     rests.kind == Kind::rest && lemma.clause[2].positive();
  return holds && is_of_one && late.cost <= rests.cost ? "" : "a rest that does not follow";
}

// "Nobody ends there, or one of all those who can does not end elsewhere."
std::string LemmaAuditor::audit_taken(const sat::Lemma& lemma, VertexId goal) const {
  if (std::string wrong = audit_usages(lemma); !wrong.empty()) return wrong;
  const auto left_over = model_.variable(lemma.clause.front());
  if (left_over.kind != Kind::left_over || left_over.goal != goal ||
      !lemma.clause.front().positive())
    return "a goal that is taken begins with that it is left over";
  for (const AgentId i : model_.instance().agent_ids()) {
    const Goals& goals = model_.instance().agent(i).goals;
    if (!goals.contains(goal)) continue;
    std::vector<Ban> elsewhere;
    for (const VertexId other : goals.vertices())
      if (other != goal) elsewhere.push_back(Ban::end(other));
    const bool is_named =
        std::any_of(lemma.clause.begin() + 1, lemma.clause.end(), [&](sat::Lit lit) {
          const auto usage = model_.variable(lit);
          return usage.kind == Kind::usage && usage.agent == i && lit.positive() &&
                 model_.obstacles()[usage.obstacle].bans == elsewhere;
        });
    if (!is_named) return "somebody else can take the goal";
  }
  return "";
}

std::string LemmaAuditor::audit_order(const sat::Lemma& lemma) const {
  if (lemma.clause.size() == 1) {
    const auto late = model_.variable(lemma.clause[0]);
    const auto deadline = late.kind == Kind::cost && !lemma.clause[0].positive()
                              ? model_.instance().agent(late.agent).deadline
                              : std::nullopt;
    return deadline && as_ticks(late.cost) > *deadline ? "" : "a cost that is not too late";
  }
  if (lemma.clause.size() != 2) return "an order has two sides";
  const auto stronger = model_.variable(lemma.clause[0]), weaker = model_.variable(lemma.clause[1]);
  const bool holds = stronger.kind == weaker.kind && stronger.agent == weaker.agent &&
                     stronger.kind == Kind::cost && !lemma.clause[0].positive() &&
                     lemma.clause[1].positive() && stronger.cost >= weaker.cost;
  return holds ? "" : "an order that does not hold";
}

}  // namespace quadrille::continuous
