// SPDX-License-Identifier: MIT
// Looks at a search from another thread and ends it. What is proved by then is kept.
#include <atomic>
#include <iostream>
#include <quadrille/discrete/solver.hpp>
#include <thread>
#include <vector>

using namespace quadrille;
using namespace quadrille::discrete;

int main() {
  // A board of 6 x 6 cells with one of them free; the agents stand in the opposite order at the
  // end. There are plans, but a cheapest one is out of reach.
  constexpr std::size_t kCells = 36;
  std::vector<Agent> tasks;
  for (std::size_t i = 0; i + 1 < kCells; ++i)
    tasks.push_back({VertexId(i), VertexId(kCells - 2 - i)});
  const auto instance = Instance::make(Graph::grid(6, 6, std::vector<bool>(kCells, true)), tasks);
  if (!instance) {
    std::cerr << instance.error().to_string() << "\n";
    return 1;
  }

  std::atomic<bool> stop = false;
  std::atomic<int> looks = 0;
  std::atomic<Cost> seen = 0;
  SolveOptions options;
  options.limits.memory_mib = 4096;  // limits can be combined; the first one that is met ends it
  options.limits.interrupt = &stop;  // set by anybody: a thread, a signal handler
  options.on_progress = [&](const Progress& progress) {  // on the solving thread
    if (progress.phase != Phase::search) return;
    seen = progress.lower_bound;
    ++looks;
    looks.notify_one();
  };
  std::thread watcher([&] {
    looks.wait(0);  // until the search has shown itself once
    stop = true;
  });
  const SolveOutcome outcome = solve(*instance, options).value();
  ++looks;  // should the search have ended by itself
  looks.notify_one();
  watcher.join();

  std::cout << "stopped by: " << to_string(outcome.stop) << "\n"
            << "proved optimal: " << (outcome.status == Status::optimal ? "yes" : "no") << "\n"
            << "lower bound at least what was seen: "
            << (outcome.lower_bound >= seen && seen > 0 ? "yes" : "no") << "\n"
            << "cost of the plan, if any, at least the lower bound: "
            << (outcome.cost.value_or(outcome.lower_bound) >= outcome.lower_bound ? "yes" : "no")
            << "\n";
}
