// SPDX-License-Identifier: MIT
#include "solve/core_shrinker.hpp"

#include <algorithm>

namespace quadrille::continuous {
namespace {

using sat::Verdict;

/// Conflicts and decisions of a test whether something is a core. Measured: 200 decisions leave
/// `dense` (28 agents) open, 1500 leave `empty16` open and take twice the time on `sparse` and
/// `room64`.
constexpr sat::SolveBudget kTryBudget{200, 700};

bool has(const LevelCore& core, const Level& level) {
  return std::find(core.begin(), core.end(), level) != core.end();
}

}  // namespace

LevelCore CoreShrinker::shrink(LevelCore core, const IdVector<AgentId, Cost>& ceilings) {
  drop(core, ceilings);
  raise(core, ceilings);
  return core;
}

bool CoreShrinker::is_core(const LevelCore& core, const IdVector<AgentId, Cost>& ceilings) {
  return !limits_.exhausted() &&
         problem_.solve({core, ceilings, {}, kTryBudget, Question::Search::quick}, limits_) ==
             Verdict::unsat;
}

void CoreShrinker::drop(LevelCore& core, const IdVector<AgentId, Cost>& ceilings) {
  for (std::size_t at = 0; at < core.size();) {
    LevelCore part = core;
    part.erase(part.begin() + static_cast<std::ptrdiff_t>(at));
    if (!is_core(part, ceilings)) {
      ++at;
      continue;
    }
    const LevelCore& smaller = problem_.core();
    at = static_cast<std::size_t>(
        std::count_if(core.begin(), core.begin() + static_cast<std::ptrdiff_t>(at),
                      [&](const Level& level) { return has(smaller, level); }));
    core = smaller;
  }
}

CoreShrinker::Ladder CoreShrinker::ladder(const Level& level, Cost ceiling) const {
  Ladder ladder{level.cost, {}};
  // Beyond the ceiling all levels say the same.
  for (auto next = problem_.next_threshold(level.agent, level.cost); next && *next <= ceiling + 1;
       next = problem_.next_threshold(level.agent, *next))
    ladder.higher.push_back(*next);
  ladder.bad = ladder.higher.size() + 1;
  return ladder;
}

// A cover hits a core where that is cheapest: so the level that has risen least is raised next, by
// steps that grow and then shrink again. Measured against one level after the other, to its
// highest: a quarter less time for the rows of `bench/suite` that take long.
void CoreShrinker::raise(LevelCore& core, const IdVector<AgentId, Cost>& ceilings) {
  std::vector<Ladder> ladders;
  for (const Level& level : core) ladders.push_back(ladder(level, ceilings[level.agent]));
  while (true) {
    std::size_t at = core.size();
    Cost least = 0;
    for (std::size_t k = 0; k < core.size(); ++k) {
      const Cost risen = core[k].cost - ladders[k].lowest;
      if (ladders[k].is_done() || (at < core.size() && risen >= least)) continue;
      at = k;
      least = risen;
    }
    if (at == core.size()) return;
    Ladder& ladder = ladders[at];
    ladder.step = std::min(ladder.step, ladder.bad - ladder.good - 1);
    LevelCore raised = core;
    raised[at].cost = ladder.higher[ladder.good + ladder.step - 1];
    if (!is_core(raised, ceilings)) {
      ladder.bad = ladder.good + ladder.step;
      ladder.step = std::max<std::size_t>(ladder.step / 2, 1);
      continue;
    }
    ladder.good += ladder.step;
    ladder.step *= 2;
    // Some of the others may not be needed.
    core.clear();
    std::vector<Ladder> left;
    for (std::size_t k = 0; k < raised.size(); ++k) {
      if (!has(problem_.core(), raised[k])) continue;
      core.push_back(raised[k]);
      left.push_back(std::move(ladders[k]));
    }
    ladders = std::move(left);
  }
}

}  // namespace quadrille::continuous
