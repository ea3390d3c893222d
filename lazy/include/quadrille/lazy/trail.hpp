// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "quadrille/core/ids.hpp"
#include "quadrille/sat/lit.hpp"

namespace quadrille::lazy {

/// A thing that one agent must not do while a literal, `allowed`, is false. What it is, the domain
/// knows.
using ObstacleId = StrongId<struct ObstacleTag>;

/// The current paths, one per agent, as a domain keeps them for an ObstacleTrail. `set_path` makes
/// a path the agent's current one; `breaks` says whether a path does what an obstacle forbids.
template <class P>
concept TrailPaths = std::copyable<typename P::Path> && std::totally_ordered<typename P::Cost> &&
    requires(P& paths, const P& known, const typename P::Path& path, AgentId agent, ObstacleId id) {
  { known.path(agent) } -> std::convertible_to<const typename P::Path&>;
  { known.cost(path) } -> std::convertible_to<typename P::Cost>;
  { known.breaks(path, id) } -> std::convertible_to<bool>;
  paths.set_path(agent, path);
};

/// What the literals on a theory's stack demand of the agents' paths: which obstacles are active,
/// and within which bounds the costs are. Follows the stack back and forth, and knows whose path
/// may have to be replaced.
///
/// An obstacle is active while its literal is false, also if it was made after that. The active
/// obstacles of an agent are kept in the order in which they became active. When a path gives way
/// to a costlier one, it comes back as soon as the stack is shorter than it was then: so if each
/// replacement is a cheapest path, no agent has a path that is costlier than it has to be, whatever
/// was retracted since.
///
/// Pushing and retracting take O(1) for each literal, for each obstacle that it controls, and for
/// each bound and path that is taken back. Obstacles that stay active take no time, except where
/// one of the same agent ceases to be active that became so earlier.
template <TrailPaths Paths>
class ObstacleTrail {
 public:
  using Path = typename Paths::Path;
  using Cost = typename Paths::Cost;

  /// `paths` outlives the trail. Caps begin with `no_cap`, floors with Cost().
  ObstacleTrail(Paths& paths, std::size_t num_agents, Cost no_cap)
      : paths_(paths), agents_(num_agents, Agent{no_cap}) {}

  // ---- the stack --------------------------------------------------------------------------------

  [[nodiscard]] sat::Truth value(sat::Lit lit) const {
    const auto index = static_cast<std::size_t>(lit.variable());
    const sat::Truth positive =
        index < variables_.size() ? variables_[index].value : sat::Truth::unassigned;
    if (positive == sat::Truth::unassigned || lit.positive()) return positive;
    return positive == sat::Truth::is_true ? sat::Truth::is_false : sat::Truth::is_true;
  }
  /// Makes an unassigned literal true: the obstacles that it controls become active.
  void push(sat::Lit lit) {
    Variable& var = variable(lit);
    var.value = lit.positive() ? sat::Truth::is_true : sat::Truth::is_false;
    stack_.push_back(lit);
    if (var.controls) for_each_controlled(lit, [this](ObstacleId id) { activate(id); });
  }
  /// Keeps the first `kept` literals.
  void retract(std::size_t kept) {
    for (; !changes_.empty() && changes_.back().height > kept; changes_.pop_back())
      undo(changes_.back());
    for (; stack_.size() > kept; stack_.pop_back()) {
      const sat::Lit lit = stack_.back();
      Variable& var = variable(lit);
      var.value = sat::Truth::unassigned;
      if (var.controls) for_each_controlled(lit, [this](ObstacleId id) { deactivate(id); });
    }
    for (; !thinned_.empty(); thinned_.pop_back()) drop_inactive(agents_[thinned_.back()]);
  }
  /// Hears of obstacles that were made since the last call. `all` has them in the order of their
  /// ids, each with its `agent` and its literal `allowed`.
  template <class Obstacles>
  void notice(const Obstacles& all) {
    while (obstacles_.size() < all.size()) {
      const ObstacleId id = obstacles_.next_id();
      const sat::Lit allowed = all[id].allowed;
      obstacles_.push_back({all[id].agent, allowed});
      variable(allowed).controls = true;
      const auto index = static_cast<std::size_t>(allowed.variable());
      if (controlled_.size() <= index) controlled_.resize(index + 1);
      controlled_[index].push_back(id);
      if (value(allowed) == sat::Truth::is_false) activate(id);
    }
  }

  // ---- what it demands --------------------------------------------------------------------------

  /// What the agent may cost at most, and what it is said to cost at least.
  [[nodiscard]] Cost cap(AgentId i) const { return agents_[i].cap; }
  [[nodiscard]] Cost floor(AgentId i) const { return agents_[i].floor; }
  /// Follows from the literal that was pushed last.
  void lower_cap(AgentId i, Cost cap) {
    Agent& agent = agents_[i];
    if (cap >= agent.cap) return;
    note({Change::Kind::cap, i, agent.cap});
    agent.cap = cap;
    if (paths_.cost(paths_.path(i)) > cap) mark_violated(i);
  }
  void raise_floor(AgentId i, Cost floor) {
    Agent& agent = agents_[i];
    if (floor <= agent.floor) return;
    note({Change::Kind::floor, i, agent.floor});
    agent.floor = floor;
  }
  [[nodiscard]] bool is_active(ObstacleId id) const { return obstacles_[id].is_active; }
  /// The active obstacles of an agent, in the order in which they became active. Valid until the
  /// trail changes.
  [[nodiscard]] const std::vector<ObstacleId>& active(AgentId i) const { return agents_[i].active; }
  /// The first active obstacle of the agent that the path breaks.
  [[nodiscard]] std::optional<ObstacleId> find_broken(AgentId i, const Path& path) const {
    for (const ObstacleId id : agents_[i].active)
      if (paths_.breaks(path, id)) return id;
    return std::nullopt;
  }

  // ---- paths ------------------------------------------------------------------------------------

  /// False: the agent's path keeps the cap and breaks no active obstacle. True: it may not.
  [[nodiscard]] bool is_violated(AgentId i) const { return agents_[i].is_violated; }
  /// Whether some violated agent satisfies the predicate.
  template <class Predicate>
  [[nodiscard]] bool any_violated(const Predicate& predicate) const {
    return std::any_of(listed_.begin(), listed_.end(),
                       [&](AgentId i) { return agents_[i].is_violated && predicate(i); });
  }
  /// Calls `mend` for each violated agent, ascending, until it returns false; then returns false.
  template <class Mend>
  bool mend_violated(const Mend& mend) {
    std::sort(listed_.begin(), listed_.end());
    const bool all = std::all_of(listed_.begin(), listed_.end(),
                                 [&](AgentId i) { return !agents_[i].is_violated || mend(i); });
    std::erase_if(listed_, [&](AgentId i) {
      agents_[i].is_listed = agents_[i].is_violated;
      return !agents_[i].is_listed;
    });
    return all;
  }
  /// The path of a violated agent turned out to keep the cap and to break nothing.
  void keep_path(AgentId i) { agents_[i].is_violated = false; }
  /// Replaces the path by one that keeps the cap and breaks nothing.
  void replace_path(AgentId i, const Path& path) {
    const Path& old = paths_.path(i);
    if (paths_.cost(path) > paths_.cost(old) && note({Change::Kind::path, i, Cost()}))
      replaced_paths_.push_back(old);
    paths_.set_path(i, path);
    agents_[i].is_violated = false;
  }

 private:
  struct Variable {
    sat::Truth value = sat::Truth::unassigned;  // of the positive literal
    bool controls = false;                      // some obstacle
  };
  struct Obstacle {
    AgentId agent;
    sat::Lit allowed;
    bool is_active = false;
  };
  struct Agent {
    Cost cap;
    Cost floor = Cost();
    bool is_violated = false;  // then it is listed, too
    bool is_listed = false;    // in listed_
    std::vector<ObstacleId> active = {};
    std::size_t num_dropped = 0;  // obstacles in `active` that are so no longer
  };
  struct Change {
    enum class Kind : std::uint8_t { cap, floor, path };
    Kind kind;
    AgentId agent;
    Cost before;             // cap and floor
    std::size_t height = 0;  // of the stack; it is undone when the stack gets lower
  };

  [[nodiscard]] Variable& variable(sat::Lit lit) {
    const auto index = static_cast<std::size_t>(lit.variable());
    if (variables_.size() <= index) variables_.resize(index + 1);
    return variables_[index];
  }
  template <class Tell>
  void for_each_controlled(sat::Lit lit, const Tell& tell) {
    for (const ObstacleId id : controlled_[static_cast<std::size_t>(lit.variable())])
      if (obstacles_[id].allowed == ~lit) tell(id);
  }

  void activate(ObstacleId id) {
    Obstacle& obstacle = obstacles_[id];
    Agent& agent = agents_[obstacle.agent];
    obstacle.is_active = true;
    agent.active.push_back(id);
    if (!agent.is_violated && paths_.breaks(paths_.path(obstacle.agent), id))
      mark_violated(obstacle.agent);
  }
  void deactivate(ObstacleId id) {
    Obstacle& obstacle = obstacles_[id];
    obstacle.is_active = false;
    if (agents_[obstacle.agent].num_dropped++ == 0) thinned_.push_back(obstacle.agent);
  }
  // They are at the end; between them are only such as became active late.
  void drop_inactive(Agent& agent) {
    const auto is_dropped = [&](ObstacleId id) { return !obstacles_[id].is_active; };
    auto at = agent.active.end();
    while (agent.num_dropped > 0)
      if (is_dropped(*--at)) --agent.num_dropped;
    agent.active.erase(std::remove_if(at, agent.active.end(), is_dropped), agent.active.end());
  }
  void mark_violated(AgentId i) {
    agents_[i].is_violated = true;
    if (agents_[i].is_listed) return;
    agents_[i].is_listed = true;
    listed_.push_back(i);
  }
  /// False if nothing can take the change back.
  bool note(Change change) {
    if (stack_.empty()) return false;
    change.height = stack_.size();
    changes_.push_back(change);
    return true;
  }
  void undo(const Change& change) {
    switch (change.kind) {
      case Change::Kind::cap:
        agents_[change.agent].cap = change.before;
        break;
      case Change::Kind::floor:
        agents_[change.agent].floor = change.before;
        break;
      case Change::Kind::path:
        paths_.set_path(change.agent, replaced_paths_.back());
        replaced_paths_.pop_back();
        // It was violated when it was replaced, and may still be.
        mark_violated(change.agent);
        break;
    }
  }

  Paths& paths_;
  IdVector<AgentId, Agent> agents_;
  std::vector<AgentId> thinned_;  // those with num_dropped > 0, during a retraction
  std::vector<AgentId> listed_;   // those that are violated or were so lately
  IdVector<ObstacleId, Obstacle> obstacles_;
  std::vector<Variable> variables_;                  // by variable
  std::vector<std::vector<ObstacleId>> controlled_;  // by variable
  std::vector<sat::Lit> stack_;
  std::vector<Change> changes_;
  std::vector<Path> replaced_paths_;  // of the path changes
};

}  // namespace quadrille::lazy
