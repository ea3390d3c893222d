// SPDX-License-Identifier: MIT
#include "quadrille/core/limits.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <memory>
#include <thread>
#include <vector>

#include "support/sanitizer.hpp"

namespace quadrille {
namespace {

constexpr std::size_t kMib = 1 << 20;
using Block = std::vector<char>;

/// Resident at once.
Block hold(std::size_t mib) { return Block(mib * kMib, 'x'); }

void burn(double cpu_s) {
  const double end = thread_cpu_seconds() + cpu_s;
  while (thread_cpu_seconds() < end) {
  }
}

Limits cpu_limit(double seconds) {
  Limits limits;
  limits.cpu_s = seconds;
  return limits;
}

Limits memory_limit(double mib) {
  Limits limits;
  limits.memory_mib = mib;
  return limits;
}

/// Memory is looked at once a millisecond.
bool is_exhausted_soon(LimitMonitor& monitor) {
  std::this_thread::sleep_for(std::chrono::milliseconds(2));
  return monitor.exhausted_now();
}

TEST(Limits, CpuTimeIsThatOfTheOwnThread) {
  LimitMonitor monitor(cpu_limit(0.1));
  std::thread(burn, 0.3).join();
  EXPECT_LT(monitor.elapsed_cpu(), 0.05);
  EXPECT_FALSE(monitor.exhausted_now());
  burn(0.12);
  EXPECT_TRUE(monitor.exhausted_now());
  EXPECT_EQ(monitor.reason(), StopReason::cpu_time);
}

TEST(Limits, ThreadsOfOneAccountAreCountedTogether) {
  const auto account = std::make_shared<ResourceAccount>();
  LimitMonitor monitor(cpu_limit(0.2), account);
  const auto work = [&] {
    LimitMonitor other(cpu_limit(0.2), account);
    burn(0.08);
  };
  std::thread(work).join();
  EXPECT_FALSE(monitor.exhausted_now());
  std::thread(work).join();
  EXPECT_FALSE(monitor.exhausted_now());
  burn(0.08);
  EXPECT_TRUE(monitor.exhausted_now());
  EXPECT_GE(account->cpu_s(), 0.24);
}

TEST(Limits, MemoryIsWhatWasAddedSince) {
  const Block of_the_host = hold(300);
  LimitMonitor monitor(memory_limit(100));
  EXPECT_FALSE(is_exhausted_soon(monitor));
  const Block some = hold(60);
  EXPECT_FALSE(is_exhausted_soon(monitor));
  const Block more = hold(60);
  EXPECT_TRUE(is_exhausted_soon(monitor));
  EXPECT_EQ(monitor.reason(), StopReason::memory);
}

TEST(Limits, MemoryThatIsGivenBackDoesNotCount) {
  if (support::kAddressSanitizer) GTEST_SKIP() << "the sanitizer keeps what is given back";
  LimitMonitor monitor(memory_limit(100));
  for (int round = 0; round < 5; ++round) {
    const Block block = hold(60);
    EXPECT_FALSE(is_exhausted_soon(monitor));
  }
}

TEST(Limits, MemoryOfOtherThreadsDoesNotCount) {
  LimitMonitor monitor(memory_limit(100));
  Block of_the_host;
  std::thread([&] { of_the_host = hold(300); }).join();
  EXPECT_FALSE(is_exhausted_soon(monitor));
  const Block own = hold(120);
  EXPECT_TRUE(is_exhausted_soon(monitor));
}

// Both look all the time while both grow; the host takes and gives back.
TEST(Limits, TwoSearchesAreChargedWithTheirOwnMemory) {
  if (support::kAddressSanitizer)
    GTEST_SKIP() << "the sanitizer has memory of its own for each block";
  double charged[2] = {0, 0};
  std::atomic<int> running{2};
  const auto grow = [&](int which, std::size_t mib) {
    const auto account = std::make_shared<ResourceAccount>();
    LimitMonitor monitor(memory_limit(10'000), account);
    std::vector<Block> blocks;
    for (int step = 0; step < 40; ++step) {
      blocks.push_back(hold(mib));
      EXPECT_FALSE(is_exhausted_soon(monitor));
    }
    charged[which] = account->memory_mib();
    --running;
    while (running > 0) std::this_thread::yield();  // nobody gives back what the other looks at
  };
  std::thread small(grow, 0, 1), large(grow, 1, 5);
  while (running > 0) {
    const Block of_the_host = hold(20);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  small.join();
  large.join();
  EXPECT_GT(charged[0], 20);
  EXPECT_LT(charged[0], 80);
  EXPECT_GT(charged[1], 150);
  EXPECT_LT(charged[1], 260);
}

TEST(Limits, RoomIsAskedForBeforeItIsTaken) {
  LimitMonitor monitor(memory_limit(100));
  EXPECT_TRUE(monitor.has_room_for(50 * kMib));
  EXPECT_FALSE(monitor.exhausted_now());
  EXPECT_FALSE(monitor.has_room_for(150 * kMib));
  EXPECT_EQ(monitor.reason(), StopReason::memory);
  EXPECT_FALSE(monitor.has_room_for(0));
  LimitMonitor unlimited{Limits{}};
  EXPECT_TRUE(unlimited.has_room_for(SIZE_MAX));
}

// A solve in several parts has a monitor for each, beside its own.
TEST(LimitMonitor, OneInsideOfAnotherIsChargedOnce) {
  const auto account = std::make_shared<ResourceAccount>();
  const double begin = thread_cpu_seconds();
  LimitMonitor outer({}, account);
  const auto work = [&](LimitMonitor& monitor) {
    const double until = thread_cpu_seconds() + 0.02;
    while (thread_cpu_seconds() < until) static_cast<void>(monitor.elapsed_cpu());
  };
  work(outer);
  {
    LimitMonitor inner({}, account);
    work(inner);
    work(outer);
    work(inner);
  }
  work(outer);
  const double charged = outer.elapsed_cpu(), used = thread_cpu_seconds() - begin;
  EXPECT_LE(charged, used);
  EXPECT_GE(charged, 0.09);
  EXPECT_GE(charged, 0.9 * used);
}

}  // namespace
}  // namespace quadrille
