// SPDX-License-Identifier: MIT
#include "primal/serial_moves.hpp"

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace quadrille::continuous {

// ---- bodies that stand --------------------------------------------------------------------------

StandingBodies::StandingBodies(Scene& scene) : scene_(scene) {
  const Instance& instance = scene.instance();
  const Roadmap& roadmap = instance.roadmap();
  for (const Agent& agent : instance.agents()) begin_ = std::max(begin_, agent.release);
  for (const AgentId i : instance.agent_ids()) {
    const Agent& agent = instance.agent(i);
    if (agent.under_way)
      begin_ = std::max(
          begin_, instance.duration(instance.class_of(i), roadmap.out_edges(agent.start).front()));
  }
  is_closed_.assign(instance.num_classes(), std::vector<bool>(roadmap.num_edges(), false));
  near_at_.resize(instance.num_classes());
  for (const ClassId c : IdRange<ClassId>(instance.num_classes())) {
    for (const Ban& ban : scene.standing_bans(c)) {
      if (ban.when.end < kForever)
        begin_ = std::max(begin_, ban.when.end);
      else if (ban.kind == Ban::Kind::start)
        is_closed_[c.index()][ban.place] = true;
      else
        for (const EdgeId e : roadmap.in_edges(VertexId(ban.place)))
          is_closed_[c.index()][e.index()] = true;
    }
  }
}

const std::vector<VertexId>& StandingBodies::near(ClassId a, EdgeId e) {
  std::vector<std::uint32_t>& near_at = near_at_[a.index()];
  if (near_at.empty()) near_at.assign(scene_.instance().roadmap().num_edges(), kUnknown);
  if (near_at[e.index()] != kUnknown) return near_[near_at[e.index()]];
  std::vector<VertexId> near;
  for (const ClassId b : IdRange<ClassId>(scene_.instance().num_classes())) {
    const auto& vertices = scene_.contacts().near_edge(a, e, b).vertices;
    near.insert(near.end(), vertices.begin(), vertices.end());
  }
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
  near_at[e.index()] = static_cast<std::uint32_t>(near_.size());
  return near_.emplace_back(std::move(near));
}

// ---- agents that stand --------------------------------------------------------------------------

Standing::Standing(StandingBodies& bodies) : bodies_(bodies), instance_(bodies.scene().instance()) {
  const Roadmap& roadmap = instance_.roadmap();
  vertex_of_.resize(instance_.num_agents());
  is_gone_.resize(instance_.num_agents(), false);
  agent_at_.resize(roadmap.num_vertices(), kNobody);
  for (const AgentId i : instance_.agent_ids()) {
    const Agent& agent = instance_.agent(i);
    const VertexId at =
        agent.under_way ? roadmap.edge(roadmap.out_edges(agent.start).front()).to : agent.start;
    put(i, at, agent.leaves && at == agent.goal());
  }
}

bool Standing::is_home(AgentId i) const {
  return is_gone_[i] || (!instance_.agent(i).leaves && vertex_of_[i] == instance_.agent(i).goal());
}

bool Standing::are_all_home() const {
  for (const AgentId i : instance_.agent_ids())
    if (!is_home(i)) return false;
  return true;
}

bool Standing::are_apart() const {
  for (const AgentId i : instance_.agent_ids())
    if (!is_gone_[i] && agent_at_[vertex_of_[i]] != i.index()) return false;
  return true;
}

bool Standing::can_move(const SerialMove& move, std::int64_t& effort) {
  // Bodies that do not cover their places might stand at the same one.
  if (agent_at_[instance_.roadmap().edge(move.edge).to] != kNobody) return false;
  const ClassId c = instance_.class_of(move.agent);
  const auto& near = bodies_.near(c, move.edge);
  effort += static_cast<std::int64_t>(near.size()) + 1;
  return std::all_of(near.begin(), near.end(), [&](VertexId v) {
    const std::uint32_t other = agent_at_[v];
    return other == kNobody || other == move.agent.index() ||
           !bodies_.block(c, move.edge, instance_.class_of(AgentId(other)), v);
  });
}

void Standing::put(AgentId i, VertexId v, bool gone) {
  const auto self = static_cast<std::uint32_t>(i.index());
  if (agent_at_[vertex_of_[i]] == self) agent_at_[vertex_of_[i]] = kNobody;
  vertex_of_[i] = v;
  is_gone_[i] = gone;
  if (!gone) agent_at_[v] = self;
}

void Standing::move(const SerialMove& move) {
  const Agent& agent = instance_.agent(move.agent);
  const VertexId to = instance_.roadmap().edge(move.edge).to;
  put(move.agent, to, agent.leaves && to == agent.goal());
}

bool is_serial_plan(StandingBodies& bodies, std::span<const SerialMove> moves) {
  const Instance& instance = bodies.scene().instance();
  Standing standing(bodies);
  std::int64_t effort = 0;
  for (const SerialMove& move : moves) {
    if (standing.is_gone(move.agent) ||
        instance.roadmap().edge(move.edge).from != standing.vertex_of(move.agent) ||
        !bodies.may_use(instance.class_of(move.agent), move.edge) ||
        !standing.can_move(move, effort))
      return false;
    standing.move(move);
  }
  return standing.are_all_home();
}

// ---- loops --------------------------------------------------------------------------------------

namespace {

class LoopCutter {
 public:
  LoopCutter(StandingBodies& bodies, std::vector<SerialMove> moves, std::int64_t effort)
      : bodies_(bodies),
        instance_(bodies.scene().instance()),
        moves_(std::move(moves)),
        enough_(effort) {}

  std::vector<SerialMove> run() {
    bool is_shorter = true;
    while (is_shorter && effort_ < enough_) {
      is_shorter = false;
      for (const AgentId i : instance_.agent_ids()) is_shorter |= cut(i);
    }
    return std::move(moves_);
  }

 private:
  /// From each visit on, the agent stays for as long as nobody minds, up to its last return.
  bool cut(AgentId i) {
    bodies_.scene().limits().check();
    std::vector<std::size_t> own;  // its moves
    for (std::size_t k = 0; k < moves_.size(); ++k)
      if (moves_[k].agent == i) own.push_back(k);
    std::vector<bool> is_cut(moves_.size(), false);
    bool has_cut = false;
    for (std::size_t from = 0; from < own.size() && effort_ < enough_;) {
      const VertexId at = instance_.roadmap().edge(moves_[own[from]].edge).from;
      // It would stand there until it leaves for the last time before somebody comes.
      std::size_t until = from;
      std::size_t next = own[from] + 1;
      for (std::size_t to = from; to < own.size(); ++to) {
        for (; next < own[to] && leaves_alone(moves_[next], i, at); ++next) {
        }
        if (next < own[to]) break;
        if (instance_.roadmap().edge(moves_[own[to]].edge).to == at) until = to + 1;
        next = own[to] + 1;
      }
      for (std::size_t k = from; k < until; ++k) is_cut[own[k]] = true;
      has_cut = has_cut || until > from;
      from = std::max(until, from + 1);
    }
    if (!has_cut) return false;
    std::size_t kept = 0;
    for (std::size_t k = 0; k < moves_.size(); ++k)
      if (!is_cut[k]) moves_[kept++] = moves_[k];
    moves_.resize(kept);
    return true;
  }

  [[nodiscard]] bool leaves_alone(const SerialMove& move, AgentId i, VertexId at) {
    effort_ += 3;
    return instance_.roadmap().edge(move.edge).to != at &&
           !bodies_.block(instance_.class_of(move.agent), move.edge, instance_.class_of(i), at);
  }

  StandingBodies& bodies_;
  const Instance& instance_;
  std::vector<SerialMove> moves_;
  const std::int64_t enough_;
  std::int64_t effort_ = 0;
};

}  // namespace

std::vector<SerialMove> without_loops(StandingBodies& bodies, std::vector<SerialMove> moves,
                                      std::int64_t effort) {
  return LoopCutter(bodies, std::move(moves), effort).run();
}

// ---- times --------------------------------------------------------------------------------------

namespace {

class Timetable {
 public:
  explicit Timetable(StandingBodies& bodies)
      : instance_(bodies.scene().instance()),
        contacts_(bodies.scene().contacts()),
        begin_(bodies.begin()) {
    paths_.resize(instance_.num_agents());
    for (const AgentId i : instance_.agent_ids()) {
      const Agent& agent = instance_.agent(i);
      paths_[i].push_back({agent.start, 0, 0});
      if (agent.under_way) depart(i, instance_.roadmap().out_edges(agent.start).front(), 0);
    }
  }

  void add(const SerialMove& move) {
    const ClassId c = instance_.class_of(move.agent);
    Ticks start = std::max(begin_, paths_[move.agent].back().arrive);
    for (const ClassId b : IdRange<ClassId>(instance_.num_classes()))
      for (const EdgeId f : contacts_.near_edge(c, move.edge, b).edges) {
        const auto known = latest_.find(key(b, f));
        if (known == latest_.end()) continue;
        const auto before = known->second.without(move.agent);
        if (!before ||
            *before + instance_.duration(b, f) + instance_.duration(c, move.edge) < start)
          continue;
        if (const auto offsets = contacts_.offsets(b, f, c, move.edge))
          start = std::max(start, *before + offsets->end);
      }
    depart(move.agent, move.edge, start);
  }

  [[nodiscard]] Plan plan() && {
    for (Path& path : paths_) path.back().depart = path.back().arrive;
    return Plan{std::move(paths_)};
  }

 private:
  /// The latest start along an edge, and that of others than who made it.
  struct Latest {
    Ticks start = -1, of_others = -1;
    AgentId agent;
    void add(AgentId i, Ticks tick) {
      if (start < 0 || i == agent) {
        start = std::max(start, tick);
      } else if (tick >= start) {
        of_others = start;
        start = tick;
      } else {
        of_others = std::max(of_others, tick);
        return;
      }
      agent = i;
    }
    [[nodiscard]] std::optional<Ticks> without(AgentId i) const {
      const Ticks tick = start >= 0 && i == agent ? of_others : start;
      return tick < 0 ? std::nullopt : std::optional(tick);
    }
  };
  [[nodiscard]] std::uint64_t key(ClassId c, EdgeId e) const {
    return c.index() * instance_.roadmap().num_edges() + e.index();
  }

  void depart(AgentId i, EdgeId e, Ticks start) {
    const ClassId c = instance_.class_of(i);
    paths_[i].back().depart = start;
    const Ticks end = start + instance_.duration(c, e);
    paths_[i].push_back({instance_.roadmap().to(e), end, end});
    latest_[key(c, e)].add(i, start);
  }

  const Instance& instance_;
  Contacts& contacts_;
  const Ticks begin_;
  std::unordered_map<std::uint64_t, Latest> latest_;  // by class and edge, once it is used
  IdVector<AgentId, Path> paths_;
};

}  // namespace

Plan earliest_plan(StandingBodies& bodies, std::span<const SerialMove> moves) {
  Timetable timetable(bodies);
  for (const SerialMove& move : moves) {
    bodies.scene().limits().check();
    timetable.add(move);
  }
  return std::move(timetable).plan();
}

}  // namespace quadrille::continuous
