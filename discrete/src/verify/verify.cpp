// SPDX-License-Identifier: MIT
//
// The judge of plans. On purpose it uses nothing but the data types: adjacency on grids is decided
// by coordinates, costs are counted here, and no helper of the searches is called.
#include "quadrille/discrete/verify.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "verify/rules.hpp"

namespace quadrille::discrete {
namespace {

constexpr std::uint32_t kNobody = UINT32_MAX;

class Replay {
 public:
  Replay(const Instance& instance, const Plan& plan)
      : instance_(instance),
        graph_(instance.graph()),
        plan_(plan),
        robust_(instance.rules().robust),
        parked_(graph_.num_vertices(), kNobody),
        left_(robust_ > 0 ? graph_.num_vertices() : 0),
        first_(graph_.num_vertices(), kNobody) {}

  VerifyReport run() {
    check_shape();
    count_costs();
    for (Timestep t = 0; !listed_.empty(); ++t) {
      check_vertices(t);
      if (robust_ > 0) check_distance_in_time(t);
      check_moves(t);
      advance(t + 1);
    }
    std::sort(report_.violations.begin(), report_.violations.end(),
              [](const Violation& a, const Violation& b) {
                return std::tie(a.timestep, a.agent, a.kind, a.other) <
                       std::tie(b.timestep, b.agent, b.kind, b.other);
              });
    return std::move(report_);
  }

 private:
  const Path& path(std::uint32_t agent) const { return plan_.paths[AgentId(agent)]; }
  VertexId at(std::uint32_t agent, Timestep t) const {
    return path(agent)[static_cast<std::size_t>(t)];
  }
  bool exists(VertexId v) const { return v.index() < graph_.num_vertices(); }
  std::string place(VertexId v) const {
    return exists(v) ? vertex_name(graph_, v) : "vertex " + std::to_string(v.value());
  }
  static std::string name(std::uint32_t agent) { return "agent " + std::to_string(agent); }
  /// Of the timestep `t` after the plan's beginning, as the plan counts; no plan is too broken.
  Timestep absolute(Timestep t) const {
    constexpr std::int64_t most = std::numeric_limits<Timestep>::max();
    return static_cast<Timestep>(std::min(std::int64_t{plan_.now} + t, most));
  }
  std::string when(Timestep t) const { return " at timestep " + std::to_string(absolute(t)); }

  void add(Violation::Kind kind, std::uint32_t agent, VertexId vertex, Timestep t,
           std::string message) {
    report_.violations.push_back(
        {kind, AgentId(agent), std::nullopt, vertex, absolute(t), std::move(message)});
  }

  /// Everything about single agents that needs no clock, and who takes part in the replay.
  void check_shape() {
    const std::size_t agents = instance_.num_agents(), paths = plan_.paths.size();
    if (agents != paths)
      add(Violation::Kind::path_count, 0, VertexId(), 0,
          "the plan has " + std::to_string(paths) + " paths for " + std::to_string(agents) +
              " agents");
    if (plan_.now != instance_.now())
      add(Violation::Kind::bad_time, 0, VertexId(), 0,
          "the plan begins" + when(0) + ", and the instance at timestep " +
              std::to_string(instance_.now()));
    lengths_.assign(std::min(agents, paths), 0);
    for (std::uint32_t i = 0; i < std::min(agents, paths); ++i) {
      if (path(i).empty()) {
        add(Violation::Kind::empty_path, i, VertexId(), 0, name(i) + " has an empty path");
        continue;
      }
      listed_.push_back(i);
      const Agent& task = instance_.agents()[AgentId(i)];
      lengths_[i] = length_while_there(task, path(i));
      check_own_rules(
          instance_, task, path(i), [&](Violation::Kind kind, Timestep t, const std::string& what) {
            const auto at = std::min<std::size_t>(static_cast<std::size_t>(t), path(i).size() - 1);
            add(kind, i, path(i)[at], t, name(i) + " " + what + when(t));
          });
      const auto last = static_cast<Timestep>(path(i).size() - 1);
      if (path(i).front() != task.start)
        add(Violation::Kind::wrong_start, i, path(i).front(), 0,
            name(i) + " begins at " + place(path(i).front()) + " instead of its start " +
                place(task.start));
      const auto goals = task.goals.vertices();
      if (std::find(goals.begin(), goals.end(), path(i).back()) == goals.end())
        add(Violation::Kind::wrong_goal, i, path(i).back(), last,
            name(i) + " ends at " + place(path(i).back()) + when(last) + " instead of " +
                (goals.size() == 1 ? "its goal " + place(goals.front())
                                   : "one of its " + std::to_string(goals.size()) + " goals"));
    }
  }

  void count_costs() {
    for (const std::uint32_t i : listed_) {
      Cost arrived = 0;
      for (std::size_t t = 1; t < path(i).size(); ++t)
        if (path(i)[t] != path(i)[t - 1]) arrived = static_cast<Cost>(t);
      report_.sum_of_costs += arrived;
      report_.makespan = std::max(report_.makespan, arrived);
    }
  }

  /// Reports each listed agent with the smallest other agent in its vertex. Agents beyond the end
  /// of their path are found through the listed ones: what two of them do together was said when
  /// the later one was listed for the last time.
  void check_vertices(Timestep t) {
    for (const std::uint32_t i : listed_) {
      const VertexId v = at(i, t);
      if (!exists(v))
        add(Violation::Kind::bad_vertex, i, v, t,
            name(i) + " is at " + place(v) + when(t) + ", which the graph does not have");
      else if (first_[v] == kNobody)
        first_[v] = i;
    }
    for (const std::uint32_t i : listed_) {
      const VertexId v = at(i, t);
      if (!exists(v)) continue;
      const std::uint32_t other = first_[v] == i ? parked_[v] : std::min(first_[v], parked_[v]);
      if (other != kNobody)
        add_pair(Violation::Kind::vertex, std::min(i, other), std::max(i, other), v, t,
                 " are both at " + place(v) + when(t));
    }
    for (const std::uint32_t i : listed_)
      if (exists(at(i, t))) first_[at(i, t)] = kNobody;
  }

  void add_pair(Violation::Kind kind, std::uint32_t a, std::uint32_t b, VertexId vertex, Timestep t,
                const std::string& what) {
    report_.violations.push_back(
        {kind, AgentId(a), AgentId(b), vertex, absolute(t),
         "agents " + std::to_string(a) + " and " + std::to_string(b) + what});
  }

  /// Each listed agent with the one that was last in its vertex. Who was there before that was told
  /// when that one came.
  void check_distance_in_time(Timestep t) {
    for (const std::uint32_t i : listed_) {
      if (!exists(at(i, t))) continue;
      const Left& last = left_[at(i, t)];
      if (last.agent == kNobody || last.agent == i || t - last.timestep > robust_) continue;
      if (t == last.timestep) continue;  // a collision
      add_pair(Violation::Kind::too_close, std::min(i, last.agent), std::max(i, last.agent),
               at(i, t), t,
               " are at " + place(at(i, t)) + " within " + std::to_string(t - last.timestep) +
                   " timesteps, and there have to be more than " + std::to_string(robust_) + ";" +
                   " the second one comes" + when(t));
    }
    for (const std::uint32_t i : listed_)
      if (exists(at(i, t))) left_[at(i, t)] = {i, t};
  }

  bool is_edge(VertexId a, VertexId b) const {
    if (const auto& grid = graph_.layout(); grid && !graph_.is_directed()) {
      const Cell p = grid->cell_of(a), q = grid->cell_of(b);
      return std::abs(p.x - q.x) + std::abs(p.y - q.y) == 1;
    }
    const auto near = graph_.neighbours(a);
    return std::find(near.begin(), near.end(), b) != near.end();
  }

  static std::uint64_t key(VertexId from, VertexId to) {
    return std::uint64_t{from.value()} << 32 | to.value();
  }

  void check_moves(Timestep t) {
    movers_.clear();  // Looked up by key only, never iterated.
    for (const std::uint32_t i : listed_) {
      if (static_cast<std::size_t>(t) + 1 >= length(i)) continue;
      const VertexId from = at(i, t), to = at(i, t + 1);
      if (from == to || !exists(from) || !exists(to)) continue;
      movers_.emplace(key(from, to), i);
      if (!is_edge(from, to))
        add(Violation::Kind::not_adjacent, i, from, t,
            name(i) + " moves from " + place(from) + when(t) + " to " + place(to) +
                ", which is no neighbour");
    }
    for (const std::uint32_t i : listed_) {
      if (static_cast<std::size_t>(t) + 1 >= length(i)) continue;
      const VertexId from = at(i, t), to = at(i, t + 1);
      const auto found = from == to ? movers_.end() : movers_.find(key(to, from));
      if (found == movers_.end()) continue;
      // The pair of the two smallest is found from both sides; the larger agent reports it.
      const std::uint32_t other = found->second;
      if (other < i)
        add_swap(other, i, to, from, t);
      else if (movers_.at(key(from, to)) != i)
        add_swap(i, other, from, to, t);
    }
  }

  void add_swap(std::uint32_t a, std::uint32_t b, VertexId from, VertexId to, Timestep t) {
    add_pair(Violation::Kind::swap, a, b, from, t,
             " swap " + place(from) + " and " + place(to) + " between timesteps " +
                 std::to_string(absolute(t)) + " and " + std::to_string(absolute(t + 1)));
  }

  /// Until when the path of a listed agent says where it is.
  std::size_t length(std::uint32_t i) const { return lengths_[i]; }

  /// Parks the agents whose path ends before timestep t, or lets them leave.
  void advance(Timestep t) {
    const auto done = [this, t](std::uint32_t i) {
      if (length(i) > static_cast<std::size_t>(t)) return false;
      if (!instance_.agents()[AgentId(i)].leaves && exists(path(i).back())) {
        std::uint32_t& owner = parked_[path(i).back()];
        owner = std::min(owner, i);
      }
      return true;
    };
    listed_.erase(std::remove_if(listed_.begin(), listed_.end(), done), listed_.end());
  }

  const Instance& instance_;
  const Graph& graph_;
  const Plan& plan_;
  VerifyReport report_;
  const Timestep robust_;
  std::vector<std::size_t> lengths_;   // By agent.
  std::vector<std::uint32_t> listed_;  // Agents whose path still says where they are; increasing.
  IdVector<VertexId, std::uint32_t> parked_;  // The smallest agent that stays here for ever.
  struct Left {
    std::uint32_t agent = kNobody;
    Timestep timestep = 0;
  };
  IdVector<VertexId, Left> left_;  // Who was here last; only if agents keep apart in time.
  IdVector<VertexId, std::uint32_t> first_;  // The smallest listed agent here at this timestep.
  std::unordered_map<std::uint64_t, std::uint32_t> movers_;  // The smallest agent on each arc.
};

}  // namespace

std::string_view to_string(Violation::Kind kind) noexcept {
  switch (kind) {
    case Violation::Kind::path_count:
      return "path-count";
    case Violation::Kind::bad_time:
      return "bad-time";
    case Violation::Kind::empty_path:
      return "empty-path";
    case Violation::Kind::bad_vertex:
      return "bad-vertex";
    case Violation::Kind::wrong_start:
      return "wrong-start";
    case Violation::Kind::wrong_goal:
      return "wrong-goal";
    case Violation::Kind::not_adjacent:
      return "not-adjacent";
    case Violation::Kind::turn:
      return "no-time-to-turn";
    case Violation::Kind::too_early:
      return "too-early";
    case Violation::Kind::too_late:
      return "too-late";
    case Violation::Kind::waypoint:
      return "waypoint";
    case Violation::Kind::obstacle:
      return "obstacle";
    case Violation::Kind::too_close:
      return "too-close";
    case Violation::Kind::vertex:
      return "vertex-conflict";
    case Violation::Kind::swap:
      return "swap-conflict";
  }
  return "";
}

VerifyReport verify(const Instance& instance, const Plan& plan) {
  return Replay(instance, plan).run();
}

}  // namespace quadrille::discrete
