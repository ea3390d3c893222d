// SPDX-License-Identifier: MIT
#include "primal/restarted_search.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include "quadrille/core/contract.hpp"

namespace quadrille::discrete {
namespace {

/// A search that never has to take back a step visits about as many configurations as the longest
/// way has steps, each for a step per agent.
constexpr std::int64_t kEasy = 4, kLeastUnit = 20'000;

std::int64_t unit_of(const Instance& instance, const GoalDistances& distances) {
  std::int64_t farthest = 0;
  for (const AgentId i : instance.agents())
    if (const Timestep way = distances(i, instance.tasks()[i].start); way != kUnreachable)
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

RestartedSearch::RestartedSearch(const Instance& instance,
                                 std::shared_ptr<const GoalDistances> distances, std::uint32_t seed)
    : instance_(instance),
      distances_(std::move(distances)),
      seed_(seed),
      unit_(unit_of(instance, *distances_)),
      main_(instance, distances_, seed) {}

RestartedSearch::State RestartedSearch::advance(std::int64_t effort, LimitMonitor& limits) {
  while (effort > 0 && main_.state() == State::searching && !limits.exhausted()) {
    std::int64_t before = main_.effort();
    const std::int64_t begin = std::clamp<std::int64_t>(unit_ - before, 0, effort);
    if (begin > 0) {
      static_cast<void>(main_.advance(begin, limits));
      effort -= main_.effort() - before;
      continue;
    }
    const std::int64_t turn = std::min(effort, unit_);
    if (const State state = advance_other(turn, limits); state != State::searching) return state;
    effort -= turn;
    before = main_.effort();
    static_cast<void>(main_.advance(std::min(effort, turn), limits));
    effort -= main_.effort() - before;
  }
  return main_.state();
}

RestartedSearch::State RestartedSearch::advance_other(std::int64_t effort, LimitMonitor& limits) {
  if (!other_) {
    ++num_others_;
    other_.emplace(instance_, distances_, seed_ + num_others_);
  }
  const State state = other_->advance(effort, limits);
  if (state == State::searching && other_->effort() >= unit_ * luby(num_others_)) other_.reset();
  return state;
}

Plan RestartedSearch::plan() const {
  return main_.state() == State::found ? main_.plan() : other_.value().plan();
}

}  // namespace quadrille::discrete
