// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "paths/timed_path.hpp"
#include "traffic/scene.hpp"

namespace quadrille::continuous {

/// The moves of one agent, whenever they begin.
struct Route {
  std::vector<EdgeId> edges;
  Ticks duration = 0;  ///< When it ends if nobody is in the way; 0 without moves.
};

/// All ways in which some agents can follow given routes, by the order in which moves and stays
/// that are in each other's way happen. Every order is a system of difference constraints on the
/// starts of the moves, whose least solution minimises every agent's arrival at once.
/// Soundness 11.18
class RouteOrders {
 public:
  /// `work` counts down comparisons; when it is below 0 the search ends early.
  RouteOrders(Scene& scene, Objective objective, std::int64_t& work)
      : scene_(scene),
        contacts_(scene.contacts()),
        instance_(scene.instance()),
        objective_(objective),
        work_(work) {}

  /// Without agents again.
  void clear();
  /// `route` outlives this. Agents are added in any order, each once.
  void add(AgentId agent, const Route& route);
  /// The least cost, if it is below `limit`. To be trusted if `work` is not below 0 then.
  [[nodiscard]] std::optional<Cost> least(Cost limit);
  /// After `least` has returned a cost: its paths, in the order in which agents were added.
  [[nodiscard]] std::vector<Path> paths() const;

 private:
  /// time[to] >= time[from] + gap. Variable 0 is tick 0, the others are starts of moves.
  struct Constraint {
    std::size_t from, to;
    Ticks gap;
  };
  /// One of two constraints has to hold; the second one may be impossible.
  struct Choice {
    Constraint first;
    std::optional<Constraint> second;
  };
  struct Traveller {
    AgentId agent;
    const Route* route;
    std::size_t first;  // the variable of its first move
  };
  using Times = std::vector<Ticks>;

  [[nodiscard]] ClassId class_of(const Traveller& t) const { return instance_.class_of(t.agent); }
  [[nodiscard]] Ticks duration(const Traveller& t, std::size_t move) const {
    return instance_.duration(class_of(t), t.route->edges[move]);
  }
  [[nodiscard]] bool leaves(const Traveller& t) const { return instance_.agent(t.agent).leaves; }
  void add_moves(const Traveller& i, const Traveller& j);
  void add_stays(const Traveller& mover, const Traveller& stander);
  /// The choices that moving obstacles leave.
  void add_bans(const Traveller& t);
  void add_start_ban(std::size_t move, const TickInterval& starts);
  void add_stay_ban(const Traveller& t, std::size_t stay, const TickInterval& stretch);
  bool enforce(const Constraint& added, Times& times);
  /// Whether somebody misses its deadline.
  [[nodiscard]] bool is_late(const Times& times) const;
  void branch(std::size_t depth);
  [[nodiscard]] Cost cost_of(const Times& times) const;

  Scene& scene_;
  Contacts& contacts_;
  const Instance& instance_;
  const Objective objective_;
  std::int64_t& work_;
  std::vector<Traveller> travellers_;
  std::vector<Ticks> chain_{0};  // by variable: how long its move takes; 0: it is an agent's last
  std::vector<Ticks> earliest_{0};  // by variable: not before this
  std::vector<Choice> choices_;
  std::vector<Constraint> chosen_;
  std::vector<Times> stack_;            // by number of chosen constraints
  std::vector<std::size_t> to_follow_;  // variables that were raised
  Cost limit_ = 0;
  std::optional<Times> best_;
};

}  // namespace quadrille::continuous
