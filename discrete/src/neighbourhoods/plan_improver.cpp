// SPDX-License-Identifier: MIT
#include "neighbourhoods/plan_improver.hpp"

#include <algorithm>
#include <utility>

#include "quadrille/core/contract.hpp"

namespace quadrille::discrete {
namespace {

// A neighbourhood is given up when its new paths take more effort than this per timestep of the old
// ones (measured; free paths take about one), plus something for short paths.
constexpr std::int64_t kEffortPerTimestep = 20;
constexpr std::int64_t kLeastEffort = 1000;
/// One part in kExplored of the effort is for trying all choices alike. Measured with 400 agents on
/// room-64-64-8: in 2 s 40,798; with all choices in one of four draws, whatever they take, 46,492.
constexpr std::int64_t kExplored = 8;

}  // namespace

PlanImprover::Impl::Impl(const Instance& instance, std::shared_ptr<const GoalDistances> distances,
                         Objective objective, const Plan& plan, std::uint32_t seed)
    : instance_(instance),
      distances_(std::move(distances)),
      objective_(objective),
      random_(seed),
      reservations_(instance_.graph().num_vertices()),
      planner_(instance_, *distances_, random_),
      neighbourhoods_(instance_, *distances_, plan_.paths, reservations_, random_),
      was_seed_(instance_.num_agents(), 0) {
  for (const AgentId agent : instance_.agent_ids()) {
    ideal_sum_ += distance(agent);
    for (const VertexId goal : instance_.agents()[agent].goals.vertices())
      has_prices_ = has_prices_ || distances_->price(goal) > 0;
  }
  for (const Rule rule : {Rule::delayed, Rule::place, Rule::any})
    for (const std::size_t size : kSizes)
      if (size == kSizes.front() || size <= instance_.num_agents())
        choices_.push_back({rule, size});
  restart_from(plan);
}

void PlanImprover::Impl::restart_from(const Plan& plan) {
  QUADRILLE_REQUIRE(plan.paths.size() == instance_.num_agents(), "one path per agent");
  Plan next = plan;
  trim(next);
  // As a rule most paths are the same.
  std::vector<AgentId> differing;
  for (const AgentId agent : instance_.agent_ids()) {
    if (!plan_.paths.empty() && plan_.paths[agent] == next.paths[agent]) continue;
    differing.push_back(agent);
    if (!plan_.paths.empty()) reservations_.remove(plan_.paths[agent]);
  }
  plan_ = std::move(next);
  for (const AgentId agent : differing) reservations_.add(agent, plan_.paths[agent]);
  count_costs();
}

void PlanImprover::Impl::count_costs() {
  sum_ = makespan_ = 0;
  for (const AgentId agent : instance_.agent_ids()) {
    sum_ += cost_of(agent);
    makespan_ = std::max(makespan_, cost_of(agent));
  }
}

bool PlanImprover::Impl::improve(std::int64_t effort, LimitMonitor& limits, Cost target) {
  const std::int64_t enough = effort_ > INT64_MAX - effort ? INT64_MAX : effort_ + effort;
  bool improved = false;
  while (effort_ < enough && cost() > target && !is_ideal() && !limits.exhausted())
    improved = step(limits) || improved;
  return improved;
}

bool PlanImprover::Impl::step(LimitMonitor& limits) {
  if (is_ideal() || limits.exhausted()) return false;
  if (!was_rebuilt_) {
    // Where there is room this gains at once what would take many small neighbourhoods.
    was_rebuilt_ = true;
    return replace_paths(neighbourhoods_.choose(Rule::any, instance_.num_agents(), AgentId()),
                         limits) > 0;
  }
  const std::int64_t effort_before = effort_;
  const bool explores = explored_ * kExplored <= effort_;
  Choice& choice = explores ? least_explored() : draw_choice();
  const AgentId seed = draw_seed();
  const Cost gain = replace_paths(neighbourhoods_.choose(choice.rule, choice.size, seed), limits);
  const std::int64_t effort = effort_ - effort_before;
  choice.score += ((gain << 32) / effort - choice.score) / 16;
  if (explores) {
    choice.explored += effort;
    explored_ += effort;
  }
  return gain > 0;
}

/// Replans and counts: positive if the plan got better, the more the cheaper it is.
Cost PlanImprover::Impl::replace_paths(const std::vector<AgentId>& agents, LimitMonitor& limits) {
  const Cost cost_before = cost(), sum_before = sum_;
  if (!replan(agents, limits)) return 0;
  count_costs();
  return cost() < cost_before ? std::max<Cost>(1, sum_before - sum_) : sum_before - sum_;
}

/// By effort, not by number: large neighbourhoods take a hundred times as long as small ones.
PlanImprover::Impl::Choice& PlanImprover::Impl::least_explored() {
  return *std::min_element(choices_.begin(), choices_.end(), [](const Choice& a, const Choice& b) {
    return a.explored < b.explored;
  });
}

/// The effort that a choice gets is in proportion to the square of its score: a draw takes the more
/// of it the larger the neighbourhood is. Measured with draws in proportion to the scores: 0.3 to
/// 0.9 % dearer on seven crowded boards, after four seconds. Integers, so that all platforms draw
/// the same.
PlanImprover::Impl::Choice& PlanImprover::Impl::draw_choice() {
  constexpr std::int64_t kLargest = 1 << 20;  // The scores are scaled to this.
  std::int64_t largest = 0;
  for (const Choice& choice : choices_) largest = std::max(largest, choice.score);
  if (largest <= 0) return least_explored();
  const std::int64_t unit = largest / kLargest + 1;
  const auto weight = [&](const Choice& choice) {
    const std::int64_t score = choice.score / unit;
    return score * score / static_cast<std::int64_t>(choice.size);
  };
  std::int64_t total = 0;
  for (const Choice& choice : choices_) total += weight(choice);
  if (total == 0) return least_explored();
  auto drawn = static_cast<std::int64_t>(random_.below(static_cast<std::uint64_t>(total)));
  std::size_t k = 0;
  for (; drawn >= weight(choices_[k]); ++k) drawn -= weight(choices_[k]);
  return choices_[k];
}

/// The most delayed agent that was not drawn lately; for the makespan, one of those who arrive
/// last, in one of two cases. Where goals have prices, any agent if none is delayed: dear goals may
/// be left over.
AgentId PlanImprover::Impl::draw_seed() {
  if (objective_ == Objective::makespan && random_.below(2) == 0) {
    std::vector<AgentId> last;
    for (const AgentId agent : instance_.agent_ids())
      if (cost_of(agent) == makespan_) last.push_back(agent);
    return last[static_cast<std::size_t>(random_.below(last.size()))];
  }
  for (;;) {
    std::optional<AgentId> seed;
    Cost largest = 0;
    for (const AgentId agent : instance_.agent_ids()) {
      const Cost delay = priced_cost_of(agent) - distance(agent);
      if (was_seed_[agent.index()] != 0 || delay <= largest) continue;
      seed = agent;
      largest = delay;
    }
    if (seed) {
      was_seed_[seed->index()] = 1;
      return *seed;
    }
    // Some agent is delayed, since the plan is not ideal, or goals have prices.
    const bool was_any = std::any_of(was_seed_.begin(), was_seed_.end(), [](char c) { return c; });
    if (!was_any) return AgentId(static_cast<std::size_t>(random_.below(was_seed_.size())));
    std::fill(was_seed_.begin(), was_seed_.end(), char{0});
  }
}

/// What the neighbourhood may cost at most, such that the plan is not costlier than before.
PlanImprover::Impl::Budget PlanImprover::Impl::budget_of(const std::vector<AgentId>& agents) const {
  Budget budget;
  Cost free_makespan = 0;
  for (const AgentId agent : agents) {
    budget.sum += priced_cost_of(agent);
    free_makespan = std::max(free_makespan, distance(agent));
  }
  budget.latest = kForever - 1;
  if (objective_ == Objective::sum_of_costs) return budget;
  budget.latest = static_cast<Timestep>(makespan_);
  // Are these all the agents that arrive last, and could they be faster?
  std::size_t num_last = 0;
  for (const AgentId agent : instance_.agent_ids()) num_last += cost_of(agent) == makespan_ ? 1 : 0;
  for (const AgentId agent : agents) num_last -= cost_of(agent) == makespan_ ? 1 : 0;
  if (num_last == 0 && free_makespan < makespan_)
    budget = {budget.latest - 1, static_cast<Cost>(agents.size()) * makespan_};
  return budget;
}

/// Gives the agents new paths in this order. False if that does not work within the budget; then
/// all is as it was.
bool PlanImprover::Impl::replan(const std::vector<AgentId>& agents, LimitMonitor& limits) {
  Budget budget = budget_of(agents);
  old_paths_.clear();
  const std::int64_t planner_before = planner_.effort();
  std::int64_t handled = 0;
  Cost before = 0, after = 0;  // Without prices.
  for (const AgentId agent : agents) {
    before += cost_of(agent);
    handled += static_cast<std::int64_t>(plan_.paths[agent].size());
    reservations_.remove(plan_.paths[agent]);
    old_paths_.push_back(plan_.paths[agent]);
    budget.sum -= distance(agent);  // From here on: what the delays may add up to.
  }
  const std::int64_t allowed = kEffortPerTimestep * handled + kLeastEffort;
  std::size_t num_new = 0;
  for (const AgentId agent : agents) {
    const Cost latest = std::min<Cost>(budget.latest, distance(agent) + budget.sum);
    const std::int64_t rest = allowed - (planner_.effort() - planner_before);
    auto path = planner_.find(agent, reservations_, static_cast<Timestep>(latest), rest, limits);
    if (!path) break;
    reservations_.add(agent, *path);
    plan_.paths[agent] = std::move(*path);
    budget.sum -= priced_cost_of(agent) - distance(agent);
    after += cost_of(agent);
    ++num_new;
  }
  effort_ += planner_.effort() - planner_before + handled / 4 + 1;
  // Whoever leaves a dear goal to nobody saves its price, and nothing else.
  const bool is_dearer = has_prices_ && after > before;
  if (num_new == agents.size() && !is_dearer) return true;
  put_back(agents, num_new);
  return false;
}

void PlanImprover::Impl::put_back(const std::vector<AgentId>& agents, std::size_t num_new) {
  for (std::size_t k = 0; k < num_new; ++k) reservations_.remove(plan_.paths[agents[k]]);
  for (std::size_t k = 0; k < agents.size(); ++k) {
    plan_.paths[agents[k]] = std::move(old_paths_[k]);
    reservations_.add(agents[k], plan_.paths[agents[k]]);
  }
}

PlanImprover::PlanImprover(const Instance& instance, std::shared_ptr<const GoalDistances> distances,
                           Objective objective, const Plan& plan, std::uint32_t seed)
    : impl_(std::make_unique<Impl>(instance, std::move(distances), objective, plan, seed)) {}
PlanImprover::~PlanImprover() = default;
PlanImprover::PlanImprover(PlanImprover&&) noexcept = default;
PlanImprover& PlanImprover::operator=(PlanImprover&&) noexcept = default;

bool PlanImprover::step(LimitMonitor& limits) { return impl_->step(limits); }
bool PlanImprover::improve(std::int64_t effort, LimitMonitor& limits, Cost target) {
  return impl_->improve(effort, limits, target);
}
void PlanImprover::restart_from(const Plan& plan) { impl_->restart_from(plan); }
const Plan& PlanImprover::plan() const noexcept { return impl_->plan(); }
Cost PlanImprover::cost() const noexcept { return impl_->cost(); }
std::int64_t PlanImprover::effort() const noexcept { return impl_->effort(); }
bool PlanImprover::is_ideal() const noexcept { return impl_->is_ideal(); }

}  // namespace quadrille::discrete
