// SPDX-License-Identifier: MIT
#include "quadrille/solve/rounds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "quadrille/core/ids.hpp"
#include "quadrille/core/random.hpp"

namespace quadrille::solve {
namespace {

constexpr std::int64_t kRound = 1000;
constexpr Effort kLength = Effort::nanoseconds(kRound);

/// The largest bound and the cheapest plan, if there is one.
struct News {
  Cost lower = 0;
  std::optional<Cost> cost;
  bool others_ended = false;

  void hear(const News& other) {
    lower = std::max(lower, other.lower);
    if (other.cost && (!cost || *other.cost < *cost)) cost = other.cost;
  }
};

News bound_of(Cost lower) {
  News news;
  news.lower = lower;
  return news;
}

News plan_of(Cost cost) {
  News news;
  news.cost = cost;
  return news;
}

/// The bounds that a worker hears when it arrives with these efforts and tells them as bounds.
struct Worker {
  std::vector<std::int64_t> efforts;
  std::vector<Cost> heard;
};

/// Each in a thread of its own, at random speeds.
void run(Rounds<News>& rounds, std::vector<Worker>& workers, std::uint64_t seed) {
  std::vector<std::jthread> threads;
  for (std::size_t w = 0; w < workers.size(); ++w)
    threads.emplace_back([&rounds, &workers, w, seed] {
      Random random(seed * 100 + w);
      for (const std::int64_t effort : workers[w].efforts) {
        std::this_thread::sleep_for(std::chrono::microseconds(random.below(300)));
        const auto news =
            rounds.arrive(w, Effort::nanoseconds(effort), [&] { return bound_of(effort); });
        workers[w].heard.push_back(news ? news->lower : -1);
      }
      rounds.end(w, false, bound_of(0));
    });
}

/// Random efforts at random speeds: what is heard is the same.
void expect_that_speeds_do_not_matter(std::int64_t lag) {
  Random random(1);
  for (int round = 0; round < 30; ++round) {
    std::vector<Worker> drawn(2 + random.below(2));
    for (Worker& worker : drawn) {
      std::int64_t effort = 0;
      for (std::size_t k = 5 + random.below(20); k > 0; --k)
        worker.efforts.push_back(effort += static_cast<std::int64_t>(
                                     random.below(1 + 3 * static_cast<std::uint64_t>(kRound))));
    }
    std::vector<std::vector<Worker>> runs(3, drawn);
    for (std::size_t k = 0; k < runs.size(); ++k) {
      Rounds<News> rounds(drawn.size(), kLength, false, lag);
      run(rounds, runs[k], k);
      for (std::size_t w = 0; w < drawn.size(); ++w) ASSERT_EQ(runs[k][w].heard, runs[0][w].heard);
    }
  }
}

TEST(Rounds, WhatIsHeardDependsOnEffortsAndNotOnSpeeds) {
  for (const std::int64_t lag : {0, 1, 4}) expect_that_speeds_do_not_matter(lag);
}

TEST(Rounds, TheFirstNewsOfTheSameRoundOrLaterAreHeard) {
  std::vector<Worker> workers{{{kRound, 3 * kRound, 3 * kRound + 1, 4 * kRound}, {}},
                              {{kRound + 7, 2 * kRound, 7 * kRound}, {}}};
  Rounds<News> rounds(2, kLength, false);
  run(rounds, workers, 3);
  const std::vector<Cost> first{kRound + 7, 7 * kRound, -1, 7 * kRound},
      second{kRound, 3 * kRound, 0};
  EXPECT_EQ(workers[0].heard, first);
  EXPECT_EQ(workers[1].heard, second);
}

TEST(Rounds, WithALagNewsAreOlderAndNobodyWaitsAsLong) {
  constexpr std::int64_t kLag = 2;
  const Cost lag = kLag * kRound;
  Rounds<News> rounds(2, kLength, false, kLag);
  const auto arrive = [&](std::size_t worker, std::int64_t effort) {
    const auto news =
        rounds.arrive(worker, Effort::nanoseconds(effort), [&] { return bound_of(effort); });
    return news ? news->lower : -1;
  };
  {
    const std::jthread slow([&] { static_cast<void>(arrive(1, kRound)); });
    static_cast<void>(arrive(0, kRound));
  }
  EXPECT_EQ(arrive(0, 1 + lag + kRound - 1), kRound);
  EXPECT_EQ(arrive(1, 2 * kRound), kRound);
  EXPECT_EQ(arrive(1, 5 * kRound), 3 * kRound);
}

TEST(Rounds, TheFirstOnesAreShort) {
  Rounds<News> rounds(1, Effort::nanoseconds(320), false);
  std::vector<std::int64_t> ends;
  for (std::int64_t effort = 0; effort < 1000; ++effort)
    if (rounds.arrive(0, Effort::nanoseconds(effort), [] { return News(); }))
      ends.push_back(effort);
  EXPECT_EQ(ends, (std::vector<std::int64_t>{0, 10, 20, 40, 80, 160, 320, 640, 960}));
}

TEST(Rounds, NewsAreMerged) {
  Rounds<News> rounds(4, kLength, true);
  const auto tell = [&](std::size_t worker, News news) {
    return rounds.arrive(worker, kLength, [&] { return std::move(news); });
  };
  static_cast<void>(tell(1, bound_of(5)));
  static_cast<void>(tell(2, plan_of(9)));
  News both = plan_of(8);
  both.lower = 3;
  static_cast<void>(tell(3, both));
  const auto heard = tell(0, bound_of(100));
  ASSERT_TRUE(heard);
  EXPECT_EQ(heard->lower, 5);
  EXPECT_EQ(heard->cost, 8);
  EXPECT_FALSE(heard->others_ended);
}

TEST(Rounds, TheProofOfTheEarliestRoundWins) {
  for (const bool race : {false, true}) {
    Rounds<News> rounds(2, kLength, race);
    {
      const std::jthread slow([&] {
        static_cast<void>(rounds.arrive(0, kLength, [] { return News(); }));
        std::this_thread::sleep_for(std::chrono::milliseconds(30));
        rounds.end(0, true, {});  // In round 1.
      });
      static_cast<void>(
          rounds.arrive(1, Effort::nanoseconds(2 * kRound - 1), [] { return News(); }));
      rounds.end(1, true, {});  // In round 1, too: only the order of workers decides.
    }
    EXPECT_TRUE(rounds.over());
    EXPECT_EQ(rounds.winner(), race ? 1U : 0U);
  }
}

TEST(Rounds, WhoIsLeftAloneIsTold) {
  Rounds<News> rounds(2, kLength, false);
  rounds.end(1, false, bound_of(6));
  const auto heard = rounds.arrive(0, kLength, [] { return News(); });
  ASSERT_TRUE(heard);
  EXPECT_TRUE(heard->others_ended);
  EXPECT_EQ(heard->lower, 6);
  EXPECT_FALSE(rounds.over());
}

TEST(Rounds, CancelWakesWhoWaits) {
  Rounds<News> rounds(2, kLength, false);
  const std::jthread other([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    rounds.cancel();
  });
  EXPECT_TRUE(rounds.arrive(0, kLength, [] { return News(); }));
  EXPECT_TRUE(rounds.over());
  EXPECT_EQ(rounds.winner(), std::nullopt);
}

}  // namespace
}  // namespace quadrille::solve
