// SPDX-License-Identifier: MIT
// Plans of both domains under random delays: nobody collides, everybody arrives, and one tick more
// of slack is one too many.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "execution/plans.hpp"
#include "execution/replay.hpp"
#include "quadrille/execution/executor.hpp"
#include "support/environment.hpp"
#include "support/random.hpp"

namespace quadrille::execution::test {
namespace {

using quadrille::support::Random;
using quadrille::support::scaled;
using Clocks = std::vector<Ticks>;

/// Separations above this are taken for contacts of bodies that touch.
constexpr Replay::Real kTouch = -1e-9L;

std::vector<Replay::Real> real(const Clocks& clocks) {
  std::vector<Replay::Real> result;
  for (const Ticks clock : clocks) result.push_back(static_cast<Replay::Real>(clock.value()));
  return result;
}

Precedences loosened(Precedences order) {
  for (Precedence& p : order.list) p.slack += 1;
  return order;
}

struct Outcome {
  Replay::Real separation = 1;
  bool all_arrived = false;
};

class DelayRun {
 public:
  DelayRun(const ContinuousCase& c, const Precedences& order, Random& random)
      : replay_(c.instance, c.plan), executor_(order), random_(random) {
    for (std::size_t i = 0; i < order.num_agents(); ++i) ends_.push_back(order.end(AgentId(i)));
    clocks_.assign(ends_.size(), 0);
  }

  /// Steps that all take together, each at its own speed, with pauses.
  Outcome coupled() {
    std::vector<std::size_t> pause(ends_.size(), 0);
    const std::size_t longest = random_.between(1, 12), period = random_.between(2, 10);
    std::vector<std::size_t> speed;
    for (std::size_t i = 0; i < ends_.size(); ++i) speed.push_back(random_.between(1, period));
    for (std::size_t step = 0; step < 20'000 && clocks_ != ends_; ++step) {
      Clocks targets = clocks_;
      for (std::size_t i = 0; i < ends_.size(); ++i) {
        // Who is held by others is not delayed anew, or a circle of many would never be ready
        // at the same time.
        if (pause[i] > 0)
          --pause[i];
        else
          targets[i] = std::min(ends_[i], clocks_[i] + Ticks(std::int64_t(speed[i])));
      }
      executor_.couple(clocks_, targets);
      for (std::size_t i = 0; i < ends_.size(); ++i)
        if (targets[i] > clocks_[i] && random_.percent(8)) pause[i] = random_.below(longest);
      go(targets);
    }
    return outcome();
  }

  /// One after the other, each as far as it may, or less; the clocks that the others know of are
  /// those of some time ago. A stop for good is possible only where slacks are 0.
  Outcome on_their_own() {
    Clocks reported = clocks_, limits(ends_.size());
    for (std::size_t idle = 0; idle < 50 && clocks_ != ends_;) {
      if (!random_.percent(25)) reported = clocks_;
      executor_.limits(reported, limits);
      const std::size_t i = random_.below(ends_.size());
      Clocks targets = clocks_;
      const Ticks most = std::min(ends_[i], limits[i]);
      targets[i] = random_.percent(60)
                       ? std::max(clocks_[i], most)
                       : clocks_[i] + Ticks(std::int64_t(random_.below(
                                          std::size_t((most - clocks_[i]).value()) + 1)));
      idle = targets == clocks_ ? idle + 1 : 0;
      go(targets);
    }
    return outcome();
  }

 private:
  void go(const Clocks& targets) {
    separation_ = std::min(separation_, replay_.least_separation(real(clocks_), real(targets)));
    clocks_ = targets;
  }
  [[nodiscard]] Outcome outcome() const { return {separation_, clocks_ == ends_}; }

  Replay replay_;
  Executor executor_;
  Random& random_;
  Clocks ends_, clocks_;
  Replay::Real separation_ = 1;
};

TEST(Delays, ContinuousPlansNeitherCollideNorGetStuck) {
  std::size_t num_runs = 0, num_loose = 0, num_contacts = 0, num_arrived_alone = 0, num_alone = 0;
  Random random(1);
  for (std::uint32_t seed = 0; num_runs < scaled(5000); ++seed) {
    const auto c = continuous_case(seed, 2 + seed % 7);
    if (!c) continue;
    const auto order = precedences(c->instance, c->plan);
    ASSERT_TRUE(order.has_value()) << order.error().to_string();
    for (int k = 0; k < 20; ++k, ++num_runs) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", run " + std::to_string(k));
      const bool alone = k % 2 == 1;
      DelayRun run(*c, *order, random);
      const Outcome outcome = alone ? run.on_their_own() : run.coupled();
      ASSERT_GE(outcome.separation, kTouch);
      num_alone += alone ? 1 : 0;
      if (alone)
        num_arrived_alone += outcome.all_arrived ? 1 : 0;
      else
        ASSERT_TRUE(outcome.all_arrived);
    }
    if (order->list.empty()) continue;
    const Precedences loose = loosened(*order);
    ++num_loose;
    for (int k = 0; k < 6; ++k)
      if (DelayRun(*c, loose, random).on_their_own().separation < kTouch) {
        ++num_contacts;
        break;
      }
  }
  // Without steps together only ties without slack can stop all of them.
  EXPECT_GE(num_arrived_alone * 10, num_alone * 9) << num_arrived_alone << " of " << num_alone;
  EXPECT_GE(num_contacts * 2, num_loose) << num_contacts << " of " << num_loose;
}

TEST(Delays, PlansWithTimestepsNeitherCollideNorGetStuck) {
  std::size_t num_runs = 0, num_loose = 0, num_contacts = 0;
  Random random(2);
  for (std::uint64_t seed = 0; num_runs < scaled(5000); ++seed) {
    const auto c = seed % 3 == 0 ? leaving_case(seed) : discrete_case(seed);
    if (!c) continue;
    const auto order = precedences(c->instance, c->plan);
    ASSERT_TRUE(order.has_value()) << order.error().to_string();
    const auto collides = [&](const Precedences& rules) {
      Executor executor(rules);
      Clocks clocks(order->num_agents(), 0), ends;
      for (std::size_t i = 0; i < clocks.size(); ++i) ends.push_back(order->end(AgentId(i)));
      const std::size_t held_up = random.between(5, 60);
      std::vector<bool> is_ready(clocks.size(), false);  // and has not gone on since
      bool collided = false;
      for (int step = 0; step < 10'000 && clocks != ends; ++step) {
        Clocks targets = clocks;
        for (std::size_t i = 0; i < clocks.size(); ++i)
          if (is_ready[i] || !random.percent(held_up)) {
            targets[i] = std::min(ends[i], clocks[i] + 1);
            is_ready[i] = true;
          }
        executor.couple(clocks, targets);
        for (std::size_t i = 0; i < clocks.size(); ++i)
          if (targets[i] > clocks[i]) is_ready[i] = false;
        const auto numbers = [](const Clocks& from) {
          std::vector<std::size_t> to;
          for (const Ticks clock : from) to.push_back(std::size_t(clock.value()));
          return to;
        };
        collided = collided || collide(c->instance, c->plan, numbers(clocks), numbers(targets));
        clocks = targets;
      }
      if (&rules == &*order) {
        EXPECT_EQ(clocks, ends);
      }
      return collided;
    };
    for (int k = 0; k < 10; ++k, ++num_runs) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      ASSERT_FALSE(collides(*order));
    }
    if (order->list.empty()) continue;
    ++num_loose;
    const Precedences loose = loosened(*order);
    for (int k = 0; k < 20; ++k)
      if (collides(loose)) {
        ++num_contacts;
        break;
      }
  }
  EXPECT_GE(num_contacts * 10, num_loose * 9) << num_contacts << " of " << num_loose;
}

}  // namespace
}  // namespace quadrille::execution::test
