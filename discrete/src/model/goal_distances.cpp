// SPDX-License-Identifier: MIT
#include "quadrille/discrete/goal_distances.hpp"

#include <algorithm>
#include <exception>
#include <utility>

#include "model/breadth_first.hpp"
#include "quadrille/core/contract.hpp"

namespace quadrille::discrete {
namespace {

/// No distance is larger. O(V + E).
std::int64_t most_moves(const Graph& graph) {
  BreadthFirst search(graph);
  std::vector<bool> is_seen(graph.num_vertices(), false);
  std::int64_t most = 0;
  for (const VertexId v : IdRange<VertexId>(graph.num_vertices())) {
    if (is_seen[v.index()]) continue;
    search.run(v);
    for (const std::uint32_t w : search.order()) is_seen[w] = true;
    // From any vertex to any other by way of v.
    most = std::max(most, 2 * std::int64_t{search.distances()[search.order().back()]});
  }
  return most;
}

/// The least sum of a distance and a price, by vertex.
void find_priced(const Graph& graph, const Goals& goals, const GoalPrices& prices,
                 std::vector<Timestep>& distances) {
  distances.assign(graph.num_vertices(), kUnreachable);
  std::vector<std::pair<Timestep, VertexId>> sources;
  for (const VertexId goal : goals.vertices()) sources.emplace_back(prices[goal], goal);
  std::sort(sources.begin(), sources.end());
  // Level by level: goals join the search at the level of their price.
  std::vector<VertexId> level, next;
  std::size_t num_joined = 0;
  for (Timestep d = sources.front().first; !level.empty() || num_joined < sources.size(); ++d) {
    if (level.empty()) d = sources[num_joined].first;
    const auto reach = [&](VertexId v) {
      if (distances[v.index()] != kUnreachable) return;
      distances[v.index()] = d;
      next.push_back(v);
    };
    for (const VertexId v : level)
      for (const VertexId w : graph.predecessors(v)) reach(w);
    for (; num_joined < sources.size() && sources[num_joined].first == d; ++num_joined)
      reach(sources[num_joined].second);
    level.swap(next);
    next.clear();
  }
}

}  // namespace

std::shared_ptr<const GoalDistances> GoalDistances::make(const Instance& instance,
                                                         LimitMonitor& limits,
                                                         std::size_t most_plain) {
  std::shared_ptr<GoalDistances> table(new GoalDistances());
  if (!table->prepare(instance.graph(), instance.num_agents(), limits, most_plain)) return nullptr;
  BreadthFirst search(instance.graph());
  for (const AgentId agent : instance.agent_ids())
    if (!table->fill(agent, instance.agents()[agent].goals, search, limits)) return nullptr;
  return table;
}

std::shared_ptr<const GoalDistances> GoalDistances::make(const Instance& instance,
                                                         const GoalPrices& prices,
                                                         LimitMonitor& limits) {
  std::shared_ptr<GoalDistances> table(new GoalDistances());
  // Packed, as a price may be larger than what fits otherwise.
  if (!table->prepare(instance.graph(), instance.num_agents(), limits, 0)) return nullptr;
  std::vector<Timestep> distances;
  for (const AgentId agent : instance.agent_ids()) {
    if (limits.exhausted_now()) return nullptr;
    find_priced(instance.graph(), instance.agents()[agent].goals, prices, distances);
    table->keep(agent, distances);
  }
  table->prices_ = prices;
  return table;
}

bool GoalDistances::prepare(const Graph& graph, std::size_t num_agents, LimitMonitor& limits,
                            std::size_t most_plain) {
  is_wide_ = graph.is_directed();
  if (is_wide_) {
    const std::size_t entries = num_agents * graph.num_vertices();
    if (!limits.has_room_for(entries * sizeof(Timestep))) return false;
    groups_.assign(graph.num_vertices(), 0);
    wide_.resize(entries);
    return true;
  }
  group(graph);
  const std::size_t agents = num_agents, size = graph.num_vertices();
  const std::size_t bytes = num_bytes(), groups = group_centre_.size();
  const bool is_plain = agents * size * sizeof(std::uint16_t) <= most_plain &&
                        (size <= kNoWay || most_moves(graph) < kNoWay);
  if (!limits.has_room_for(
          agents * (is_plain ? size * sizeof(std::uint16_t) : bytes + groups * sizeof(Timestep))))
    return false;
  plain_.resize(is_plain ? agents * size : 0);
  bits_.resize(is_plain ? 0 : agents * bytes);
  centres_.resize(is_plain ? 0 : agents * groups);
  return true;
}

bool GoalDistances::fill(AgentId agent, const Goals& goals, BreadthFirst& search,
                         LimitMonitor& limits) {
  if (limits.exhausted_now() || !search.run(goals.vertices(), &limits)) return false;
  keep(agent, search.distances());
  return true;
}

void GoalDistances::keep(AgentId agent, const std::vector<Timestep>& distances) {
  if (is_wide_) {
    std::copy(distances.begin(), distances.begin() + static_cast<std::ptrdiff_t>(groups_.size()),
              wide_.begin() + static_cast<std::ptrdiff_t>(agent.index() * groups_.size()));
    return;
  }
  if (plain_.empty()) {
    pack(distances, bits_.data() + agent.index() * num_bytes(),
         centres_.data() + agent.index() * group_centre_.size());
    return;
  }
  std::transform(distances.begin(), distances.begin() + static_cast<std::ptrdiff_t>(groups_.size()),
                 plain_.data() + agent.index() * groups_.size(), [](Timestep distance) {
                   return static_cast<std::uint16_t>(std::min<Timestep>(distance, kNoWay));
                 });
}

std::shared_ptr<const GoalDistances> GoalDistancesInTheMaking::join(LimitMonitor& limits) {
  const std::size_t agents = instance_.num_agents();
  std::unique_lock lock(mutex_);
  if (table_ == nullptr) {
    std::shared_ptr<GoalDistances> table(new GoalDistances());
    if (!table->prepare(instance_.graph(), agents, limits, GoalDistances::kMostPlain))
      return nullptr;
    std::vector<AgentId> left;
    for (std::size_t k = agents; k > 0; --k) left.emplace_back(k - 1);
    // Memory may run out before, not between these.
    left_ = std::move(left);
    table_ = std::move(table);
  }
  BreadthFirst search(instance_.graph());
  while (num_done_ < agents) {
    if (left_.empty()) {  // Others are at the last ones, which they may not finish.
      changed_.wait(lock);
      continue;
    }
    const AgentId agent = left_.back();
    left_.pop_back();
    lock.unlock();
    bool is_done = false;
    std::exception_ptr failure;
    try {
      is_done = table_->fill(agent, instance_.agents()[agent].goals, search, limits);
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    if (is_done)
      ++num_done_;
    else
      left_.push_back(agent);
    if (left_.empty() || !is_done || num_done_ == agents) changed_.notify_all();
    if (failure) std::rethrow_exception(failure);
    if (!is_done) return nullptr;
  }
  return table_;
}

ChangingGoalDistances::ChangingGoalDistances(const Graph& graph, std::size_t num_agents)
    : table_(new GoalDistances()),
      search_(std::make_unique<BreadthFirst>(graph)),
      nothing_(graph.num_vertices(), 0) {
  LimitMonitor no_limits{Limits{}};
  const bool has_room = table_->prepare(graph, num_agents, no_limits, GoalDistances::kMostPlain);
  QUADRILLE_REQUIRE(has_room, "without limits there is room");
  for (std::size_t i = 0; i < num_agents; ++i) set_everywhere(AgentId(i));
}

ChangingGoalDistances::~ChangingGoalDistances() = default;

void ChangingGoalDistances::set(AgentId agent, const Goals& goals) {
  search_->run(goals.vertices());
  table_->keep(agent, search_->distances());
}

void ChangingGoalDistances::set_everywhere(AgentId agent) { table_->keep(agent, nothing_); }

/// Puts every vertex into a group with one at most kRadius away.
void GoalDistances::group(const Graph& graph) {
  constexpr std::uint32_t kNone = UINT32_MAX;
  groups_.assign(graph.num_vertices(), kNone);
  BreadthFirst search(graph);
  for (const VertexId v : IdRange<VertexId>(graph.num_vertices())) {
    if (groups_[v.index()] != kNone) continue;
    // With a centre that is far from the first vertex, which often lies at a border of what is
    // left, groups are larger.
    search.run_within(v, kRadius);
    const std::uint32_t centre = search.order().back();
    search.run_within(VertexId(centre), kRadius);
    for (const std::uint32_t w : search.order())
      if (groups_[w] == kNone) groups_[w] = static_cast<std::uint32_t>(group_centre_.size());
    group_centre_.push_back(centre);
  }
}

void GoalDistances::pack(const std::vector<Timestep>& distances, std::uint8_t* bits,
                         Timestep* centres) const {
  const std::size_t size = groups_.size();
  const auto last_bits = [&](std::size_t v) { return distances[v] & 15; };
  for (std::size_t v = 0; v + 1 < size; v += 2)
    bits[v / 2] = static_cast<std::uint8_t>(last_bits(v) | (last_bits(v + 1) << 4));
  if (size % 2 == 1) bits[size / 2] = static_cast<std::uint8_t>(last_bits(size - 1));
  for (std::size_t k = 0; k < group_centre_.size(); ++k) centres[k] = distances[group_centre_[k]];
}

std::unique_ptr<const GoalDistances::OwnRow> GoalDistances::pack(
    const IdVector<VertexId, Timestep>& distances) const {
  auto own = std::make_unique<OwnRow>();
  if (is_wide_) {
    own->wide_ = distances.items();
    own->row_.wide_ = own->wide_.data();
    return own;
  }
  own->bits_.resize(num_bytes());
  own->centres_.resize(group_centre_.size());
  pack(distances.items(), own->bits_.data(), own->centres_.data());
  own->row_.bits_ = own->bits_.data();
  own->row_.centres_ = own->centres_.data();
  own->row_.groups_ = groups_.data();
  return own;
}

}  // namespace quadrille::discrete
