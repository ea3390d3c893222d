// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "quadrille/lazy/theory.hpp"

// A domain as small as can be: each agent takes a seat of a row, which costs it the seat's number,
// and no two can have the same.
namespace quadrille::lazy::test {

/// "The agent takes this seat."
struct Seat {
  AgentId agent;
  sat::Lit allowed;
  int number = 0;
};

class SeatVocabulary final : public Vocabulary {
 public:
  SeatVocabulary(std::size_t num_agents, bool cheap_by_default)
      : Vocabulary(num_agents, cheap_by_default ? Costs::positive : Costs::negative) {}
  [[nodiscard]] Cost free_cost(AgentId) const override { return 0; }
  [[nodiscard]] const IdVector<ObstacleId, Seat>& seats() const { return seats_; }
  [[nodiscard]] ObstacleId seat(AgentId agent, int number, FormulaWriter& writer) {
    const auto [at, is_new] = known_.try_emplace({agent, number}, seats_.next_id());
    if (is_new) seats_.push_back({agent, new_usage(agent, at->second, writer), number});
    return at->second;
  }

 private:
  IdVector<ObstacleId, Seat> seats_;
  std::map<std::pair<AgentId, int>, ObstacleId> known_;
};

class SeatPaths {
 public:
  using Path = int;
  using Cost = quadrille::Cost;
  SeatPaths(std::size_t num_agents, const SeatVocabulary& vocabulary)
      : vocabulary_(vocabulary), seats_(num_agents, 0) {}
  [[nodiscard]] const int& path(AgentId i) const { return seats_[i]; }
  void set_path(AgentId i, int seat) { seats_[i] = seat; }
  [[nodiscard]] Cost cost(int seat) const { return seat; }
  [[nodiscard]] bool breaks(int seat, ObstacleId id) const {
    return vocabulary_.seats()[id].number == seat;
  }

 private:
  const SeatVocabulary& vocabulary_;
  IdVector<AgentId, int> seats_;
};

/// What goes wrong in a domain that does not keep its word.
enum class Fault { none, wrong_seat, silent };

/// Searches to the cap, and agents without one are absent, as in discrete time; or neither.
template <bool kDiscrete>
class SeatDomain {
 public:
  using Paths = SeatPaths;
  using Plan = std::vector<int>;
  struct Conflict {
    AgentId first, second;
    int seat;
  };
  struct Cheapest {
    std::optional<int> seat;
    AgentId agent;
    std::vector<ObstacleId> around;
    [[nodiscard]] const int* path() const { return seat ? &*seat : nullptr; }
  };
  static constexpr bool kAbsentWithoutCap = kDiscrete;
  static constexpr bool kSearchesToCap = kDiscrete;

  SeatDomain(SeatVocabulary& vocabulary, std::size_t num_agents, int num_seats, Fault fault)
      : vocabulary_(vocabulary),
        num_agents_(num_agents),
        num_seats_(num_seats),
        fault_(fault),
        paths_(num_agents, vocabulary) {}

  [[nodiscard]] std::size_t num_agents() const { return num_agents_; }
  [[nodiscard]] SeatVocabulary& vocabulary() { return vocabulary_; }
  [[nodiscard]] const SeatVocabulary& vocabulary() const { return vocabulary_; }
  [[nodiscard]] const IdVector<ObstacleId, Seat>& obstacles() const { return vocabulary_.seats(); }
  [[nodiscard]] SeatPaths& paths() { return paths_; }
  [[nodiscard]] const SeatPaths& paths() const { return paths_; }
  [[nodiscard]] static Cost cost(int seat) { return seat; }
  [[nodiscard]] static bool is_same(int known, int found) { return known == found; }
  [[nodiscard]] static int make_path(AgentId, int found) { return found; }
  static std::optional<ObstacleId>* hint(int) { return nullptr; }
  [[nodiscard]] Plan plan() const {
    Plan plan;
    for (const AgentId i : IdRange<AgentId>(num_agents_)) plan.push_back(paths_.path(i));
    return plan;
  }
  [[nodiscard]] Cheapest find_cheapest(AgentId i, const std::vector<ObstacleId>& around, Cost cap) {
    for (int seat = 0; seat < num_seats_ && seat <= cap; ++seat)
      if (std::none_of(around.begin(), around.end(),
                       [&](ObstacleId id) { return paths_.breaks(seat, id); }))
        return {seat, i, around};
    return {std::nullopt, i, around};
  }
  [[nodiscard]] std::vector<ObstacleId> blame(const Cheapest& found, Cost bound) const {
    std::vector<ObstacleId> blamed;
    for (const ObstacleId id : found.around)
      if (vocabulary_.seats()[id].number < bound) blamed.push_back(id);
    return blamed;
  }
  void on_explained(const Explanation& lemma, const ObstacleTrail<SeatPaths>&, FormulaWriter&) {
    ++num_explained;
    // One seat each is in the way of all cheaper ones.
    if (lemma.bound < kNoCap) {
      EXPECT_EQ(static_cast<Cost>(lemma.blamed.size()), std::min<Cost>(lemma.bound, num_seats_));
    }
  }
  void on_obstacles(FormulaWriter&) {}
  void before_conflicts(ObstacleTrail<SeatPaths>&) { ++num_partings; }
  [[nodiscard]] std::vector<Conflict> conflicts(const ObstacleTrail<SeatPaths>& trail) const {
    const auto counts = [&](AgentId i) { return !kAbsentWithoutCap || trail.cap(i) < kNoCap; };
    std::vector<Conflict> conflicts;
    for (const AgentId i : IdRange<AgentId>(num_agents_))
      for (const AgentId j : IdRange<AgentId>(num_agents_))
        if (i < j && counts(i) && counts(j) && paths_.path(i) == paths_.path(j))
          conflicts.push_back({i, j, paths_.path(i)});
    return conflicts;
  }
  std::vector<ObstacleId> exclude(const Conflict& conflict, const ObstacleTrail<SeatPaths>&,
                                  FormulaWriter& writer) {
    if (fault_ == Fault::silent) return {};
    const int seat = conflict.seat + (fault_ == Fault::wrong_seat ? 1 : 0);
    const ObstacleId a = vocabulary_.seat(conflict.first, seat, writer);
    const ObstacleId b = vocabulary_.seat(conflict.second, seat, writer);
    if (!written_.insert({a, b}).second) return {a, b};
    const sat::Lit clause[] = {~obstacles()[a].allowed, ~obstacles()[b].allowed};
    writer.add({sat::why::Vertex{}, clause, {}, false});
    return {a, b};
  }
  [[nodiscard]] Effort effort(std::int64_t num_assigned) const {
    return Effort::nanoseconds(num_assigned);
  }

  int num_explained = 0, num_partings = 0;

 private:
  SeatVocabulary& vocabulary_;
  const std::size_t num_agents_;
  const int num_seats_;
  const Fault fault_;
  SeatPaths paths_;
  std::set<std::pair<ObstacleId, ObstacleId>> written_;
};

template <bool kDiscrete>
class SeatTheory final : public PathTheory<SeatDomain<kDiscrete>> {
 public:
  SeatTheory(LimitMonitor& limits, SeatVocabulary& vocabulary, std::size_t num_agents,
             int num_seats, Fault fault = Fault::none)
      : PathTheory<SeatDomain<kDiscrete>>(limits, vocabulary, num_agents, num_seats, fault) {}
  [[nodiscard]] const SeatDomain<kDiscrete>& domain() const { return this->domain_; }
};

}  // namespace quadrille::lazy::test
