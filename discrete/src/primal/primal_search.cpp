// SPDX-License-Identifier: MIT
#include "primal/primal_search.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "feasibility/goal_choice.hpp"
#include "quadrille/core/contract.hpp"

namespace quadrille::discrete {
namespace {

/// A search that never has to take back a step visits about as many configurations as the longest
/// way has steps, each for a step per agent.
constexpr std::int64_t kEasy = 4, kLeastUnit = 20'000;
/// Per cent above the cost of shortest paths: no other guide is tried for less.
constexpr Cost kGoodPlan = 1;
/// Where a guide may not take that much, the search begins without. Measured: 10,000 agents in a
/// warehouse, a plan with a guide is 4 % cheaper and takes three times as long.
constexpr std::int64_t kGuideEffortPerTimestep = 5;
/// From so many times the cost of shortest paths on, in halves, a plan is dear. Measured with
/// agents in crowds, the cost of the plan by lanes and by a local guide, in hundredths of that of
/// shortest paths: random-32-32-20, 300, 211 and 180; 400 agents 284 and 251; room-64-64-8 217 and
/// 184; maze-32-32-2, 150, 186 and 168; den312d, 500, 227 and 189; but warehouse-10-20-10-2-1, 600,
/// 145 and 161; random-64-64-20, 500, 124 and 131; empty-48-48, 600, 120 and 129.
constexpr Cost kDearInHalves = 3;
/// The same, in quarters, for whoever makes all plans but the first and does not know what that
/// costs: less, so that it does not leave out a search that one alone would make.
constexpr Cost kDearBesideInQuarters = 5;
/// Steps of a local guide for each one of PIBT. Measured: 6 to 22.
constexpr std::int64_t kLocalEffort = 16;
/// Longer plans stay as they are: a pass over their windows would take more than half a minute.
constexpr Cost kMostCostOfWindows = 20'000'000;
constexpr std::string_view kBeamSearch = "beam search", kLacam = "lacam", kSettling = "settling";

/// At least three in four vertices are taken.
bool is_crowded(const Instance& instance) {
  const std::size_t agents = instance.num_agents();
  return agents > 0 && 4 * agents >= 3 * instance.graph().num_vertices();
}

std::int64_t unit_of(const Instance& instance, const GoalDistances& distances) {
  std::int64_t farthest = 0;
  for (const AgentId i : instance.agent_ids())
    if (const Timestep way = distances(i, instance.agents()[i].start); way != kUnreachable)
      farthest = std::max<std::int64_t>(farthest, way);
  return std::max(kLeastUnit,
                  kEasy * farthest * (static_cast<std::int64_t>(instance.num_agents()) + 1));
}

}  // namespace

std::int64_t luby(std::uint32_t k) {
  QUADRILLE_REQUIRE(k >= 1, "the first is number 1");
  // 2^n - 1 numbers end with 2^(n-1); what comes before it is the same sequence twice.
  while (!std::has_single_bit(k + 1)) k -= std::bit_floor(k + 1) - 1;
  return (std::int64_t{k} + 1) / 2;
}

PrimalSearch::Impl::Impl(const Instance& instance, std::shared_ptr<const GoalDistances> distances,
                         std::uint32_t seed, Part part)
    : instance_(instance),
      distances_(std::move(distances)),
      seed_(seed),
      part_(part),
      unit_(unit_of(instance, *distances_)),
      is_crowded_(is_crowded(instance)) {
  for (const AgentId i : instance_.agent_ids()) {
    const Timestep way = (*distances_)(i, instance_.agents()[i].start);
    if (way == kUnreachable) state_ = State::exhausted;
    ideal_ += way;
  }
  if (kGuideEffortPerTimestep * ideal_ > Guide::kMostEffort) turn_ = kNumGuides;
  // Whoever has only a part of the work and a second one beside it leaves this to that one.
  is_settling_due_ = state_ == State::searching && is_crowded_ && part_ != Part::first_guide;
  if (is_settling_due_ && BeamSearch::is_worth_trying(instance_, *distances_))
    beam_.emplace(instance_, distances_, seed_);
}

PrimalSearch::State PrimalSearch::Impl::advance(std::int64_t effort, LimitMonitor& limits) {
  const std::int64_t enough = effort_ > INT64_MAX - effort ? INT64_MAX : effort_ + effort;
  while (!is_over() && effort_ < enough && !limits.exhausted()) {
    if (windows_) {
      advance_windows(enough - effort_, limits);
      continue;
    }
    if (beam_) {
      advance_beam(enough - effort_, limits);
      continue;
    }
    if (is_settling_due_) {
      advance_settling(enough - effort_, limits);
      continue;
    }
    if (!turn_end_ && !begin_turn(limits)) continue;
    Lacam& search = is_turn_of_main() ? *main_ : *other_;
    const std::int64_t before = search.effort();
    const std::int64_t rest = std::min(*turn_end_ - before, enough - effort_);
    static_cast<void>(search.advance(std::max<std::int64_t>(1, rest), limits));
    effort_ += search.effort() - before;
    if (search.state() != State::searching || search.effort() >= *turn_end_) end_turn_of(search);
  }
  return state_;
}

void PrimalSearch::Impl::advance_settling(std::int64_t effort, LimitMonitor& limits) {
  if (!settling_) settling_.emplace(instance_);
  const std::int64_t before = settling_->effort();
  const Settling::State state = settling_->advance(effort, limits);
  effort_ += settling_->effort() - before;
  if (state == Settling::State::working) return;
  std::optional<Plan> plan;
  if (state == Settling::State::found) plan = settling_->plan(limits);
  settling_.reset();
  if (plan) offer(*std::move(plan), kSettling);
  end_settling();
}

void PrimalSearch::Impl::advance_beam(std::int64_t effort, LimitMonitor& limits) {
  const std::int64_t before = beam_->effort();
  beam_->advance(effort, limits);
  effort_ += beam_->effort() - before;
  if (beam_->plan()) offer(*beam_->plan(), kBeamSearch);
  if (!beam_->is_over()) return;
  beam_.reset();
  if (plan_) end_settling();
}

void PrimalSearch::Impl::end_settling() {
  is_settling_due_ = false;
  finish_if_over();
}

/// The first plan of a crowded map is a dear one, and one of settled agents is.
void PrimalSearch::Impl::begin_windows() {
  if (!are_windows_due_ || !plan_ || cost_ > kMostCostOfWindows || cost_ <= 2 * ideal_) return;
  if (!is_crowded_ && origin_ != kSettling) return;
  are_windows_due_ = false;
  windows_.emplace(instance_, *plan_, seed_);
  if (windows_->is_over()) windows_.reset();
}

void PrimalSearch::Impl::advance_windows(std::int64_t effort, LimitMonitor& limits) {
  const std::int64_t before = windows_->effort();
  windows_->advance(effort, limits);
  effort_ += windows_->effort() - before;
  if (windows_->cost() < cost_) offer(windows_->plan(), "");
  // Then it is for others to make it cheaper.
  if (windows_->is_over() || cost_ <= 2 * ideal_) windows_.reset();
}

void PrimalSearch::Impl::offer(Plan plan, std::string_view origin) {
  const Cost cost = plan.cost(Objective::sum_of_costs);
  if (plan_ && cost >= cost_) return;
  if (!plan_) origin_ = origin;
  is_settled_ = origin == kSettling;
  plan.now = instance_.now();
  plan_ = std::make_shared<const Plan>(std::move(plan));
  cost_ = cost;
  state_ = State::found;
}

/// False if a limit was met.
bool PrimalSearch::Impl::begin_turn(LimitMonitor& limits) {
  if (is_turn_of_main()) {
    if (!main_) main_.emplace(instance_, distances_, seed_, nullptr);
    turn_end_ = main_->effort() + unit_ * luby(std::max<std::uint32_t>(1, num_restarts_));
    return true;
  }
  if (turn_ == 1 && is_dear() && kLocalEffort * unit_ <= Guide::kMostEffort)
    return begin_local_turn(limits);
  // Who leaves the first guide to another one begins with the second. In the end one search in
  // three goes without a guide.
  const std::uint32_t kind = turn_ >= kNumGuides   ? num_restarts_ % (kNumGuides + 1)
                             : part_ == Part::rest ? 1
                                                   : turn_;
  if (kind < kNumGuides && guides_[kind] == nullptr && !make_guide(kind, limits)) return false;
  if (turn_ >= kNumGuides) ++num_restarts_;
  other_ = std::make_unique<Lacam>(instance_, distances_, seed_ + num_restarts_,
                                   kind < kNumGuides ? guides_[kind] : nullptr);
  turn_end_ = unit_ * luby(std::max<std::uint32_t>(1, num_restarts_));
  return true;
}

bool PrimalSearch::Impl::begin_local_turn(LimitMonitor& limits) {
  if (!limits.has_room_for(LocalGuide::num_bytes(instance_))) return false;
  other_ = Lacam::guided_locally(instance_, distances_, seed_);
  turn_end_ = kLocalEffort * unit_;
  return true;
}

/// Or there is none.
bool PrimalSearch::Impl::is_dear() const noexcept {
  if (!plan_) return true;
  return part_ == Part::rest ? 4 * cost_ > kDearBesideInQuarters * ideal_
                             : 2 * cost_ > kDearInHalves * ideal_;
}

bool PrimalSearch::Impl::make_guide(std::uint32_t kind, LimitMonitor& limits) {
  // Measured with 0, 3, 10 and 30: one of these two was cheapest on nine of eleven maps.
  constexpr std::array<Timestep, kNumGuides> kMargins{10, 30};
  auto guide = std::make_shared<const Guide>(instance_, *distances_, kMargins[kind], seed_, limits);
  effort_ += guide->effort();
  if (limits.exhausted()) return false;  // It may have no paths for some agents.
  guides_[kind] = std::move(guide);
  return true;
}

void PrimalSearch::Impl::end_turn_of(const Lacam& search) {
  if (search.state() == State::found) {
    offer(search.plan(), kLacam);
  } else if (search.state() == State::exhausted) {
    state_ = State::exhausted;
    num_configurations_ = search.num_configurations();
  }
  end_turn();
}

void PrimalSearch::Impl::end_turn() {
  turn_end_.reset();
  other_.reset();
  ++turn_;
  if (turn_ == 1 && state_ == State::searching && part_ != Part::first_guide)
    is_settling_due_ = !is_crowded_;  // Otherwise it was the first of all.
  finish_if_over();
}

void PrimalSearch::Impl::finish_if_over() {
  if (!is_over()) return;
  main_.reset();
  for (auto& guide : guides_) guide.reset();
  begin_windows();
}

bool PrimalSearch::Impl::is_over() const noexcept {
  if (windows_) return false;
  if (part_ == Part::first_guide && turn_ >= 1) return true;
  if (state_ == State::searching || is_settling_due_) return false;
  if (part_ == Part::rest && turn_ >= 1 && !is_dear()) return true;
  const bool is_long = is_settled_ && cost_ > 2 * ideal_;
  return !plan_ || turn_ >= (is_long ? kTurnsBesideSettling : kNumGuides) ||
         100 * (cost_ - ideal_) <= kGoodPlan * ideal_;
}

const std::shared_ptr<const Plan>& PrimalSearch::Impl::plan() const {
  QUADRILLE_REQUIRE(state_ == State::found, "the search has found a plan");
  return plan_;
}

Cost PrimalSearch::Impl::cost() const {
  QUADRILLE_REQUIRE(state_ == State::found, "the search has found a plan");
  return cost_;
}

PrimalSearch::PrimalSearch(const Instance& instance, std::shared_ptr<const GoalDistances> distances,
                           std::uint32_t seed, Part part)
    : impl_(std::make_unique<Impl>(instance, std::move(distances), seed, part)) {}
PrimalSearch::~PrimalSearch() = default;
PrimalSearch::PrimalSearch(PrimalSearch&&) noexcept = default;
PrimalSearch& PrimalSearch::operator=(PrimalSearch&&) noexcept = default;

PrimalSearch::State PrimalSearch::advance(std::int64_t effort, LimitMonitor& limits) {
  return impl_->advance(effort, limits);
}
PrimalSearch::State PrimalSearch::state() const noexcept { return impl_->state(); }
bool PrimalSearch::is_over() const noexcept { return impl_->is_over(); }
bool PrimalSearch::is_at_guides() const noexcept { return impl_->is_at_guides(); }
std::int64_t PrimalSearch::effort() const noexcept { return impl_->effort(); }
std::size_t PrimalSearch::num_configurations() const noexcept {
  return impl_->num_configurations();
}
bool PrimalSearch::is_worth_waiting_for() const noexcept { return impl_->is_worth_waiting_for(); }
Plan PrimalSearch::plan() const { return *impl_->plan(); }
std::shared_ptr<const Plan> PrimalSearch::shared_plan() const { return impl_->plan(); }
Cost PrimalSearch::cost() const { return impl_->cost(); }
std::string_view PrimalSearch::origin() const noexcept { return impl_->origin(); }

std::optional<Plan> find_plan(const Instance& instance, LimitMonitor& limits, std::uint32_t seed) {
  if (!instance.is_plain()) return std::nullopt;
  if (instance.has_goal_sets()) {
    const GoalChoice choice = choose_goals(instance, &limits);
    return choice.chosen ? find_plan(*choice.chosen, limits, seed) : std::nullopt;
  }
  const auto distances = GoalDistances::make(instance, limits);
  if (distances == nullptr) return std::nullopt;
  PrimalSearch search(instance, distances, seed);
  if (search.advance(INT64_MAX, limits) != PrimalSearch::State::found) return std::nullopt;
  return search.plan();
}

}  // namespace quadrille::discrete
