// SPDX-License-Identifier: MIT
#include "solve/core_shrinker.hpp"

#include <algorithm>

namespace quadrille::continuous {
namespace {

using sat::Verdict;

/// One core in so many is tested anyway.
constexpr std::int64_t kTry = 8;

bool has(const LevelCore& core, const Level& level) {
  return std::find(core.begin(), core.end(), level) != core.end();
}

}  // namespace

sat::SolveBudget CoreShrinker::raise_budget() const {
  return {static_cast<int>(settings_.shrink_raise_conflicts),
          static_cast<int>(settings_.shrink_raise_decisions)};
}

sat::SolveBudget CoreShrinker::drop_budget() const {
  return {static_cast<int>(settings_.shrink_drop_conflicts),
          static_cast<int>(settings_.shrink_drop_decisions)};
}

LevelCore CoreShrinker::shrink(LevelCore core, const IdVector<AgentId, Cost>& ceilings) {
  ceilings_of_core_ = problem_.ceilings_of_core();
  raise(core, ceilings);
  if (drops_pay()) drop(core, ceilings);
  ++num_shrunk_;
  return core;
}

bool CoreShrinker::is_core(const LevelCore& core, const IdVector<AgentId, Cost>& ceilings,
                           const sat::SolveBudget& budget) {
  const bool is_refuted =
      !limits_.exhausted() &&
      problem_.solve({core, ceilings, budget, Question::Search::quick}, limits_) == Verdict::unsat;
  // Whatever is a core takes the place of the one before.
  if (is_refuted) ceilings_of_core_ = problem_.ceilings_of_core();
  return is_refuted;
}

bool CoreShrinker::is_core(const LevelCore& candidate, const IdVector<AgentId, Cost>& ceilings) {
  return is_core(candidate, ceilings, drop_budget());
}

CoreShrinker::Ladder CoreShrinker::ladder(const Level& level, Cost ceiling) const {
  Ladder ladder{level.cost, {}};
  // Beyond the ceiling all levels say the same: that is the last one, even if no lemma speaks of
  // it. Without it, costs that only what is beyond the ceiling refutes would rise tick by tick.
  for (auto next = problem_.next_threshold(level.agent, level.cost); next && *next <= ceiling + 1;
       next = problem_.next_threshold(level.agent, *next))
    ladder.higher.push_back(*next);
  if (!problem_.is_fee(level.agent) && ceiling < kAnyCost &&
      ladder.cost(ladder.higher.size()) <= ceiling)
    ladder.higher.push_back(ceiling + 1);
  ladder.bad = ladder.higher.size() + 1;
  return ladder;
}

std::vector<std::size_t> CoreShrinker::Climb::goods() const {
  std::vector<std::size_t> goods;
  for (const Ladder& ladder : ladders) goods.push_back(ladder.good);
  return goods;
}

void CoreShrinker::raise(LevelCore& core, const IdVector<AgentId, Cost>& ceilings) {
  Climb climb{std::move(core), {}};
  for (const Level& level : climb.core)
    climb.ladders.push_back(ladder(level, ceilings[level.agent]));
  raise_together(climb, ceilings);
  raise_singly(climb, ceilings);
  core = std::move(climb.core);
}

// One test for all levels instead of one for each: the next thresholds, which nearly always
// succeed.
void CoreShrinker::raise_together(Climb& climb, const IdVector<AgentId, Cost>& ceilings) {
  std::vector<std::size_t> next;
  for (const Ladder& ladder : climb.ladders)
    next.push_back(std::min<std::size_t>(1, ladder.higher.size()));
  has_raised(climb, next, ceilings);
}

// A cover hits a core where that is cheapest: so the level that has risen least is raised next, by
// steps that grow and then shrink again. Much of what is not needed goes on the way.
void CoreShrinker::raise_singly(Climb& climb, const IdVector<AgentId, Cost>& ceilings) {
  while (true) {
    std::size_t at = climb.core.size();
    Cost least = 0;
    for (std::size_t k = 0; k < climb.core.size(); ++k) {
      const Ladder& ladder = climb.ladders[k];
      if (ladder.is_done() || (at < climb.core.size() && ladder.risen() >= least)) continue;
      at = k;
      least = ladder.risen();
    }
    if (at == climb.core.size()) return;
    Ladder& ladder = climb.ladders[at];
    const std::size_t step = std::min(ladder.step, ladder.bad - ladder.good - 1);
    const std::size_t tried = ladder.good + step;
    std::vector<std::size_t> goods = climb.goods();
    goods[at] = tried;
    ladder.step = 2 * step;
    if (has_raised(climb, goods, ceilings)) continue;
    ladder.bad = tried;
    ladder.step = std::max<std::size_t>(step / 2, 1);
  }
}

bool CoreShrinker::has_raised(Climb& climb, const std::vector<std::size_t>& goods,
                              const IdVector<AgentId, Cost>& ceilings) {
  if (goods == climb.goods()) return true;
  LevelCore raised = climb.core;
  for (std::size_t k = 0; k < raised.size(); ++k) raised[k].cost = climb.ladders[k].cost(goods[k]);
  if (!is_core(raised, ceilings, raise_budget())) return false;
  // Some of the others may not be needed.
  Climb left;
  for (std::size_t k = 0; k < raised.size(); ++k) {
    if (!has(problem_.core(), raised[k])) continue;
    left.core.push_back(raised[k]);
    left.ladders.push_back(std::move(climb.ladders[k]));
    left.ladders.back().good = goods[k];
  }
  climb = std::move(left);
  return true;
}

bool CoreShrinker::drops_pay() const {
  return num_kept_ <= settings_.shrink_kept + settings_.shrink_kept_per_drop * num_dropped_ ||
         num_shrunk_ % kTry == 0;
}

// What is still there after the raises has the levels that it will have: raised later, a level may
// need again what was dropped before. Measured: dropping first takes a third more time.
void CoreShrinker::drop(LevelCore& core, const IdVector<AgentId, Cost>& ceilings) {
  for (std::size_t at = 0; at < core.size();) {
    LevelCore part = core;
    part.erase(part.begin() + static_cast<std::ptrdiff_t>(at));
    if (!is_core(part, ceilings, drop_budget())) {
      ++num_kept_;
      ++at;
      continue;
    }
    const LevelCore& smaller = problem_.core();
    num_dropped_ += static_cast<std::int64_t>(core.size() - smaller.size());
    at = static_cast<std::size_t>(
        std::count_if(core.begin(), core.begin() + static_cast<std::ptrdiff_t>(at),
                      [&](const Level& level) { return has(smaller, level); }));
    core = smaller;
  }
}

}  // namespace quadrille::continuous
