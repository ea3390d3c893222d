// SPDX-License-Identifier: MIT
#include "solve/core_shrinker.hpp"

#include <algorithm>

namespace quadrille::continuous {
namespace {

using sat::Verdict;

/// Conflicts and decisions of a test. Raises take some twenty of them for each core, and one that
/// is given up too early costs little. Measured on 18 hard rows of four families, PAR-2 at 10 s and
/// mean gap: 11.8 s and 0.10 %; with 100 and 350 for both 12.1 s and 0.11 %, with 20 and 60 for
/// both 11.7 s and 0.12 % (`dense` and `sparse` lose).
constexpr sat::SolveBudget kRaiseBudget{20, 60}, kDropBudget{100, 350};

/// Tests that fail take most of the time of the drops, and on sparse maps nearly all do: there are
/// so many to begin with and for each level that could be dropped. One core in eight is tested
/// anyway.
constexpr std::int64_t kKeptToBegin = 200, kKeptPerDrop = 24, kTry = 8;

bool has(const LevelCore& core, const Level& level) {
  return std::find(core.begin(), core.end(), level) != core.end();
}

}  // namespace

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
      !limits_.exhausted() && problem_.solve({core, ceilings, {}, budget, Question::Search::quick},
                                             limits_) == Verdict::unsat;
  // Whatever is a core takes the place of the one before.
  if (is_refuted) ceilings_of_core_ = problem_.ceilings_of_core();
  return is_refuted;
}

bool CoreShrinker::is_core(const LevelCore& candidate, const IdVector<AgentId, Cost>& ceilings) {
  return is_core(candidate, ceilings, kDropBudget);
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
// steps that grow and then shrink again. Much of what is not needed goes on the way.
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
    if (!is_core(raised, ceilings, kRaiseBudget)) {
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

bool CoreShrinker::drops_pay() const {
  return num_kept_ <= kKeptToBegin + kKeptPerDrop * num_dropped_ || num_shrunk_ % kTry == 0;
}

// What is still there after the raises has the levels that it will have: raised later, a level may
// need again what was dropped before. Measured: dropping first takes a third more time.
void CoreShrinker::drop(LevelCore& core, const IdVector<AgentId, Cost>& ceilings) {
  for (std::size_t at = 0; at < core.size();) {
    LevelCore part = core;
    part.erase(part.begin() + static_cast<std::ptrdiff_t>(at));
    if (!is_core(part, ceilings, kDropBudget)) {
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
