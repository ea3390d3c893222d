// SPDX-License-Identifier: MIT
#include "joint/joint_space.hpp"

#include <utility>

#include "quadrille/core/contract.hpp"

namespace quadrille::continuous {

JointSpace::JointSpace(Scene& scene, std::vector<AgentId> agents, JointRules rules)
    : instance_(scene.instance()),
      contacts_(scene.contacts()),
      agents_(std::move(agents)),
      num_edges_(instance_.roadmap().num_edges()),
      left_(num_edges_ + instance_.roadmap().num_vertices()),
      clock_(rules == JointRules::all ? JointClock(scene, agents_) : JointClock()) {
  QUADRILLE_REQUIRE(agents_.size() <= kMaxJointAgents, "a joint search is for few agents");
}

bool JointSpace::is_at_goal(const JointPlaces& places, std::size_t k) const {
  if (has_left(places, k)) return true;
  if (!stands(places, k)) return false;
  const VertexId v = vertex(places, k);
  return instance_.agent(agents_[k]).goals.contains(v) &&
         clock_.stays(k, v)[places.stay[k]].until >= kForever;
}

std::optional<JointPlaces> JointSpace::starts() const {
  JointPlaces places;
  for (std::size_t k = 0; k < size(); ++k) {
    const Agent& agent = instance_.agent(agents_[k]);
    const bool is_gone = agent.leaves && agent.goals.contains(agent.start);
    places.place[k] =
        static_cast<std::uint32_t>(is_gone ? left_ : num_edges_ + agent.start.index());
    if (is_gone) continue;
    const auto stays = clock_.stays(k, agent.start);
    if (stays.empty() || stays.front().from > 0) return std::nullopt;
  }
  return places;
}

bool JointSpace::are_goals(const JointPlaces& places) const {
  for (std::size_t k = 0; k < size(); ++k)
    if (!is_at_goal(places, k)) return false;
  return true;
}

bool JointSpace::leaves_after(const JointStep& step) const {
  const Agent& agent = instance_.agent(agents_[step.agent]);
  return !step.begins && agent.leaves &&
         agent.goals.contains(instance_.roadmap().edge(EdgeId(step.edge)).to);
}

ClockSpan JointSpace::when(const JointStep& step) const {
  const EdgeId e(step.edge);
  if (step.begins) return clock_.starts(step.agent, e)[step.span];
  const VertexId to = instance_.roadmap().to(e);
  ClockSpan span = leaves_after(step) ? ClockSpan() : clock_.stays(step.agent, to)[step.span];
  span.until = std::min(span.until, clock_.latest(step.agent, to));
  return span;
}

Ticks JointSpace::latest(const JointPlaces& places) const {
  Ticks latest = kForever;
  for (std::size_t k = 0; k < size(); ++k)
    if (stands(places, k))
      latest = std::min(latest, clock_.stays(k, vertex(places, k))[places.stay[k]].until);
  return latest;
}

std::optional<TickInterval> JointSpace::bad_ages(const JointPlaces& places, const JointStep& step,
                                                 std::size_t mover) {
  const ClassId a = class_of(mover), b = class_of(step.agent);
  if (leaves_after(step)) return std::nullopt;  // no stay begins
  const EdgeId e = edge(places, mover), f(step.edge);
  if (step.begins) {
    const auto& offsets = contacts_.offsets(a, e, b, f);
    // The stretch whose inner ticks are the unsafe offsets.
    return offsets ? std::optional(TickInterval{offsets->begin - 1, offsets->end}) : std::nullopt;
  }
  // A stay begins, which has to end before the contact, or to begin after it.
  return contacts_.window(a, e, b, instance_.roadmap().to(f));
}

Ticks JointSpace::latest_leave(const JointPlaces& places, std::size_t mover, std::size_t k) {
  if ((places.late & bit(mover, k)) != 0) return kForever;
  const auto& window =
      contacts_.window(class_of(mover), edge(places, mover), class_of(k), vertex(places, k));
  return window ? window->begin : kForever;
}

void JointSpace::list_steps(const JointPlaces& places, std::vector<JointStep>& steps) {
  steps.clear();
  for (std::uint32_t k = 0; k < size(); ++k) {
    if (is_moving(places, k)) {
      const EdgeId e = edge(places, k);
      const JointStep step{k, e.value(), false, 0, 0};
      const VertexId to = instance_.roadmap().to(e);
      add_variants(places, step, leaves_after(step) ? 1 : clock_.stays(k, to).size(), steps);
      continue;
    }
    if (has_left(places, k)) continue;
    for (const EdgeId e : instance_.out_edges(class_of(k), vertex(places, k))) {
      bool can_begin = true;
      for (std::size_t j = 0; j < size() && can_begin; ++j) {
        if (j == k || !stands(places, j)) continue;
        const auto& window = contacts_.window(class_of(k), e, class_of(j), vertex(places, j));
        can_begin = !window || window->begin >= 0;
      }
      if (can_begin)
        add_variants(places, {k, e.value(), true, 0, 0}, clock_.starts(k, e).size(), steps);
    }
  }
}

void JointSpace::add_variants(const JointPlaces& places, JointStep step, std::size_t num_spans,
                              std::vector<JointStep>& steps) {
  const std::size_t first = steps.size();
  for (; step.span < num_spans; ++step.span) steps.push_back(step);
  for (std::size_t j = 0; j < size(); ++j) {
    if (j == step.agent || !is_moving(places, j)) continue;
    const auto bad = bad_ages(places, step, j);
    if (!bad) continue;
    const bool can_be_young = bad->begin >= 0;
    const bool can_be_old = bad->end <= duration(j, edge(places, j));
    const std::uint32_t old = std::uint32_t{1} << j;
    const std::size_t last = steps.size();
    if (!can_be_young && !can_be_old) {
      steps.resize(first);
      return;
    }
    for (std::size_t s = first; s < last; ++s) {
      if (can_be_young && can_be_old) steps.push_back(steps[s]);
      if (can_be_old) steps[s].old_moves |= old;
    }
  }
}

void JointSpace::list_limits(const JointPlaces& places, const JointStep& step,
                             std::vector<AgeLimit>& limits) {
  limits.clear();
  if (!step.begins) {
    const Ticks age = duration(step.agent, EdgeId(step.edge));
    limits.push_back({step.agent, true, age});
    limits.push_back({step.agent, false, age});
  }
  for (std::uint32_t j = 0; j < size(); ++j) {
    if (j == step.agent || !is_moving(places, j)) continue;
    if (step.begins) {
      const Ticks leave = latest_leave(places, j, step.agent);
      if (leave < kForever) limits.push_back({j, false, leave});
    }
    const auto bad = bad_ages(places, step, j);
    if (!bad) continue;
    const bool is_old = (step.old_moves >> j & 1) != 0;
    limits.push_back({j, is_old, is_old ? bad->end : bad->begin});
  }
}

JointPlaces JointSpace::after(const JointPlaces& places, const JointStep& step) {
  JointPlaces next = places;
  // Nothing that was said about the agent is true any longer.
  for (std::size_t j = 0; j < size(); ++j) next.late &= ~(bit(step.agent, j) | bit(j, step.agent));
  next.stay[step.agent] = 0;
  if (step.begins) {
    next.place[step.agent] = step.edge;
    return next;
  }
  if (leaves_after(step)) {
    next.place[step.agent] = static_cast<std::uint32_t>(left_);
    return next;
  }
  next.stay[step.agent] = step.span;
  next.place[step.agent] = static_cast<std::uint32_t>(
      num_edges_ + instance_.roadmap().edge(EdgeId(step.edge)).to.index());
  for (std::size_t j = 0; j < size(); ++j)
    if ((step.old_moves >> j & 1) != 0) next.late |= bit(j, step.agent);
  return next;
}

void JointSpace::list_deadlines(const JointPlaces& places, std::vector<AgeLimit>& limits) {
  limits.clear();
  for (std::uint32_t j = 0; j < size(); ++j) {
    if (!is_moving(places, j)) continue;
    Ticks most = duration(j, edge(places, j));
    for (std::size_t k = 0; k < size(); ++k)
      if (k != j && stands(places, k)) most = std::min(most, latest_leave(places, j, k));
    limits.push_back({j, false, most});
  }
}

}  // namespace quadrille::continuous
