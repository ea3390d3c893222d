// SPDX-License-Identifier: MIT
// The trail under every callback sequence that the protocol allows, against a recomputation from
// the stack of literals. Paths are numbers here: path p costs p / 2, and which obstacles it breaks
// is drawn.
#include "quadrille/lazy/trail.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "support/environment.hpp"
#include "support/mock_solver.hpp"
#include "support/random.hpp"

namespace quadrille::lazy {
namespace {

using sat::Extent;
using sat::Lemma;
using sat::Lit;
using sat::Theory;
using sat::TheoryContext;
using sat::Truth;

using quadrille::support::Random;

constexpr int kNumPaths = 24, kNoCap = 1000;

struct Obstacle {
  AgentId agent;
  Lit allowed;
  std::vector<bool> broken_by;  // by path
};

class NumberPaths {
 public:
  using Path = int;
  using Cost = int;
  NumberPaths(std::size_t num_agents, const IdVector<ObstacleId, Obstacle>& obstacles)
      : paths_(num_agents, 0), obstacles_(obstacles) {}
  [[nodiscard]] const int& path(AgentId i) const { return paths_[i]; }
  void set_path(AgentId i, int path) { paths_[i] = path; }
  [[nodiscard]] int cost(int path) const { return path / 2; }
  [[nodiscard]] bool breaks(int path, ObstacleId id) const {
    return obstacles_[id].broken_by[static_cast<std::size_t>(path)];
  }

 private:
  IdVector<AgentId, int> paths_;
  const IdVector<ObstacleId, Obstacle>& obstacles_;
};

/// What a variable says of an agent's cost: true, a cap or a floor; false, the other one.
struct Bound {
  AgentId agent;
  int cost;
};

struct Count {
  std::size_t late = 0, restored = 0, mended = 0, stuck = 0, kept = 0, out_of_order = 0;
};

/// Keeps paths by a trail, always as cheap ones as possible, and compares all that the trail says
/// with what follows from the stack.
class Checked final : public Theory {
 public:
  Checked(Random& random, int num_variables, Count& count)
      : random_(random),
        num_agents_(1 + random.below(3)),
        bounds_(static_cast<std::size_t>(num_variables) + 1),
        paths_(num_agents_, obstacles_),
        trail_(paths_, num_agents_, kNoCap),
        expected_active_(num_agents_),
        count_(count) {
    for (auto& bound : bounds_)
      if (random.percent(40)) bound = Bound{any_agent(), static_cast<int>(random.below(12))};
    for (std::size_t n = random.below(8); n > 0; --n) make_obstacle();
  }

  void on_assign(std::span<const Lit> newly_true) override {
    notice();
    for (const Lit lit : newly_true) {
      stack_.push_back(lit);
      trail_.push(lit);
      for (const ObstacleId id : IdRange<ObstacleId>(obstacles_.size()))
        if (obstacles_[id].allowed == ~lit) expected_active_[obstacles_[id].agent].push_back(id);
      const auto& bound = bounds_[static_cast<std::size_t>(lit.variable())];
      if (bound && lit.positive()) trail_.lower_cap(bound->agent, bound->cost);
      if (bound && !lit.positive()) trail_.raise_floor(bound->agent, bound->cost);
    }
    compare();
  }
  void on_retract(std::size_t kept) override {
    const std::vector<int> before = current_paths();
    stack_.resize(kept);
    trail_.retract(kept);
    for (auto& active : expected_active_)
      std::erase_if(active, [&](ObstacleId id) { return !is_true(~obstacles_[id].allowed); });
    count_.restored += current_paths() == before ? 0 : 1;
    compare();
  }
  void check(Extent, TheoryContext&) override {
    if (obstacles_.size() < 60 && random_.percent(30)) make_obstacle();
    if (random_.percent(70)) notice();
    if (random_.percent(70)) mend();
    if (random_.percent(20)) swap_path(any_agent());
    compare();
  }
  Lemma explain(Lit, std::vector<Lit>&) override {
    ADD_FAILURE() << "nothing was propagated";
    return {};
  }

 private:
  [[nodiscard]] AgentId any_agent() { return AgentId(random_.below(num_agents_)); }
  [[nodiscard]] bool is_true(Lit lit) const {
    return std::find(stack_.begin(), stack_.end(), lit) != stack_.end();
  }
  [[nodiscard]] std::vector<int> current_paths() const {
    std::vector<int> paths;
    for (const AgentId i : IdRange<AgentId>(num_agents_)) paths.push_back(paths_.path(i));
    return paths;
  }
  /// Controlled by a variable that may have a value, and that may control others.
  void make_obstacle() {
    const int v = 1 + static_cast<int>(random_.below(bounds_.size() - 1));
    Obstacle obstacle{any_agent(), Lit::from_dimacs(random_.percent(70) ? -v : v), {}};
    for (int path = 0; path < kNumPaths; ++path) obstacle.broken_by.push_back(random_.percent(30));
    obstacles_.push_back(obstacle);
  }
  void notice() {
    trail_.notice(obstacles_);
    for (; noticed_ < obstacles_.size(); ++noticed_) {
      const ObstacleId id(noticed_);
      if (!is_true(~obstacles_[id].allowed)) continue;
      expected_active_[obstacles_[id].agent].push_back(id);
      ++count_.late;
    }
  }

  [[nodiscard]] int expected_cap(AgentId i) const {
    int cap = kNoCap;
    for (const Lit lit : stack_)
      if (const auto& bound = bounds_[static_cast<std::size_t>(lit.variable())];
          bound && bound->agent == i && lit.positive())
        cap = std::min(cap, bound->cost);
    return cap;
  }
  [[nodiscard]] int expected_floor(AgentId i) const {
    int floor = 0;
    for (const Lit lit : stack_)
      if (const auto& bound = bounds_[static_cast<std::size_t>(lit.variable())];
          bound && bound->agent == i && !lit.positive())
        floor = std::max(floor, bound->cost);
    return floor;
  }
  [[nodiscard]] bool is_allowed(AgentId i, int path) const {
    return paths_.cost(path) <= expected_cap(i) &&
           std::none_of(expected_active_[i].begin(), expected_active_[i].end(),
                        [&](ObstacleId id) { return paths_.breaks(path, id); });
  }
  /// The allowed paths that cost least.
  [[nodiscard]] std::vector<int> cheapest(AgentId i) const {
    std::vector<int> best;
    for (int path = 0; path < kNumPaths; ++path)
      if (is_allowed(i, path) && (best.empty() || paths_.cost(path) == paths_.cost(best[0])))
        best.push_back(path);
    return best;
  }

  void mend() {
    std::vector<AgentId> asked;
    bool complete = true;
    const std::size_t patience = random_.percent(80) ? num_agents_ : random_.below(num_agents_);
    const bool all = trail_.mend_violated([&](AgentId i) {
      EXPECT_TRUE(trail_.is_violated(i));
      EXPECT_TRUE(asked.empty() || asked.back() < i);
      if (asked.size() == patience) return complete = false;
      asked.push_back(i);
      return mend(i) || random_.percent(50) || (complete = false);
    });
    EXPECT_EQ(all, complete);
  }
  /// Any path as cheap as this one is as good, whether or not this one has to go.
  void swap_path(AgentId i) {
    const std::vector<int> best = cheapest(i);
    if (!best.empty()) trail_.replace_path(i, random_.pick(best));
  }
  /// False if the agent has no path.
  bool mend(AgentId i) {
    const std::vector<int> best = cheapest(i);
    if (best.empty()) {
      ++count_.stuck;
      return false;
    }
    if (is_allowed(i, paths_.path(i))) {
      ++count_.kept;
      trail_.keep_path(i);
    } else {
      ++count_.mended;
      trail_.replace_path(i, random_.pick(best));
    }
    return true;
  }

  void compare() {
    for (int v = 1; v < static_cast<int>(bounds_.size()); ++v) {
      const Lit lit = Lit::from_dimacs(v);
      const Truth value = is_true(lit)    ? Truth::is_true
                          : is_true(~lit) ? Truth::is_false
                                          : Truth::unassigned;
      EXPECT_EQ(trail_.value(lit), value);
      EXPECT_EQ(trail_.value(~lit) == Truth::is_true, value == Truth::is_false);
    }
    for (const AgentId i : IdRange<AgentId>(num_agents_)) compare(i);
  }
  void compare(AgentId i) {
    EXPECT_EQ(trail_.cap(i), expected_cap(i));
    EXPECT_EQ(trail_.floor(i), expected_floor(i));
    const std::vector<ObstacleId>& active = trail_.active(i);
    EXPECT_EQ(active, expected_active_[i]);
    count_.out_of_order += std::is_sorted(active.begin(), active.end()) ? 0 : 1;
    for (const ObstacleId id : active) EXPECT_TRUE(trail_.is_active(id));
    for (int path = 0; path < kNumPaths; ++path) {
      const auto broken = std::find_if(active.begin(), active.end(),
                                       [&](ObstacleId id) { return paths_.breaks(path, id); });
      const auto found = trail_.find_broken(i, path);
      ASSERT_EQ(found.has_value(), broken != active.end());
      ASSERT_TRUE(!found || *found == *broken);
    }
    // A path that is not allowed is noticed, and none is costlier than it has to be.
    const int path = paths_.path(i);
    EXPECT_TRUE(trail_.is_violated(i) || is_allowed(i, path));
    EXPECT_EQ(trail_.any_violated([&](AgentId j) { return j == i; }), trail_.is_violated(i));
    const std::vector<int> best = cheapest(i);
    EXPECT_TRUE(best.empty() || paths_.cost(path) <= paths_.cost(best[0]));
  }

  Random& random_;
  const std::size_t num_agents_;
  std::vector<std::optional<Bound>> bounds_;  // by variable
  IdVector<ObstacleId, Obstacle> obstacles_;
  NumberPaths paths_;
  ObstacleTrail<NumberPaths> trail_;
  std::vector<Lit> stack_;
  IdVector<AgentId, std::vector<ObstacleId>> expected_active_;
  std::size_t noticed_ = 0;
  Count& count_;
};

TEST(ObstacleTrail, AgreesWithARecomputation) {
  const std::size_t num_sequences = quadrille::support::scaled(4000);
  constexpr int kVariables = 12;
  Count count;
  for (std::size_t seed = 0; seed < num_sequences && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    Checked theory(random, kVariables, count);
    sat::TheoryHost host(theory, {[] { return Lit(); }, [](const Lemma&) {}});
    for (int v = 1; v <= kVariables; ++v) host.add_variable(v);
    quadrille::support::MockSolver solver(host, kVariables, seed);
    for (int step = 0; step < 60 && !testing::Test::HasFailure(); ++step) {
      switch (random.below(8)) {
        case 0:
          solver.open_level();
          break;
        case 1:
          solver.backtrack(random.below(solver.level() + 1));
          break;
        case 2:
          solver.backtrack_unannounced_levels();
          break;
        default: {
          if (random.percent(40)) solver.open_level();
          const int v = 1 + static_cast<int>(random.below(kVariables));
          solver.assign(Lit::from_dimacs(random.percent(50) ? v : -v));
          if (random.percent(70)) static_cast<void>(solver.propagate());
        }
      }
    }
  }
  if (HasFailure() || num_sequences < 400) return;  // too few to count on chance
  EXPECT_GT(count.late, num_sequences);
  EXPECT_GT(count.out_of_order, num_sequences);
  EXPECT_GT(count.mended, num_sequences);
  EXPECT_GT(count.restored, num_sequences / 4);
  EXPECT_GT(count.kept, num_sequences / 5);
  EXPECT_GT(count.stuck, num_sequences / 10);
}

// ---- by hand ------------------------------------------------------------------------------------

/// Obstacle n forbids agent 0 the paths 2n and 2n + 1, those that cost n, while variable n + 1 is
/// true.
class TrailOfOne : public testing::Test {
 protected:
  TrailOfOne() {
    for (int n = 0; n < 3; ++n) make_obstacle(Lit::from_dimacs(-(n + 1)), n);
    trail_.notice(obstacles_);
  }
  void make_obstacle(Lit allowed, int cost) {
    Obstacle obstacle{kAgent, allowed, std::vector<bool>(kNumPaths, false)};
    for (const int path : {2 * cost, 2 * cost + 1})
      obstacle.broken_by[static_cast<std::size_t>(path)] = true;
    obstacles_.push_back(obstacle);
  }
  [[nodiscard]] std::vector<std::size_t> active() const {
    std::vector<std::size_t> indices;
    for (const ObstacleId id : trail_.active(kAgent)) indices.push_back(id.index());
    return indices;
  }
  static Lit lit(int dimacs) { return Lit::from_dimacs(dimacs); }

  static constexpr AgentId kAgent{0};
  IdVector<ObstacleId, Obstacle> obstacles_;
  NumberPaths paths_{1, obstacles_};
  ObstacleTrail<NumberPaths> trail_{paths_, 1, kNoCap};
};

TEST_F(TrailOfOne, ACostlierPathIsTakenBack) {
  trail_.push(lit(1));
  trail_.replace_path(kAgent, 2);
  EXPECT_FALSE(trail_.is_violated(kAgent));
  trail_.push(lit(2));
  EXPECT_TRUE(trail_.is_violated(kAgent));
  trail_.replace_path(kAgent, 4);
  trail_.retract(1);
  EXPECT_EQ(paths_.path(kAgent), 2);
  EXPECT_TRUE(trail_.is_violated(kAgent));  // as far as anybody knows
  trail_.retract(0);
  EXPECT_EQ(paths_.path(kAgent), 0);
}

TEST_F(TrailOfOne, APathThatIsNotCostlierStays) {
  trail_.push(lit(3));
  trail_.replace_path(kAgent, 1);
  trail_.retract(0);
  EXPECT_EQ(paths_.path(kAgent), 1);
  EXPECT_FALSE(trail_.is_violated(kAgent));
}

TEST_F(TrailOfOne, WhatHappensBeforeAllLiteralsStays) {
  trail_.lower_cap(kAgent, 20);
  trail_.replace_path(kAgent, 8);
  trail_.push(lit(1));
  trail_.retract(0);
  EXPECT_EQ(paths_.path(kAgent), 8);
  EXPECT_EQ(trail_.cap(kAgent), 20);
}

TEST_F(TrailOfOne, ALateObstacleOutlivesWhatIsAboveItsLiteral) {
  trail_.push(lit(3));
  trail_.push(lit(1));
  trail_.replace_path(kAgent, 2);
  make_obstacle(lit(-3), 1);  // true since the first push
  trail_.notice(obstacles_);
  EXPECT_EQ(active(), (std::vector<std::size_t>{2, 0, 3}));
  EXPECT_TRUE(trail_.is_violated(kAgent));
  trail_.push(lit(2));
  EXPECT_EQ(active(), (std::vector<std::size_t>{2, 0, 3, 1}));
  trail_.retract(1);
  EXPECT_EQ(active(), (std::vector<std::size_t>{2, 3}));
  trail_.push(lit(1));
  EXPECT_EQ(active(), (std::vector<std::size_t>{2, 3, 0}));
  trail_.retract(0);
  EXPECT_TRUE(active().empty());
}

TEST_F(TrailOfOne, BoundsComeBackStepByStep) {
  trail_.push(lit(1));
  trail_.lower_cap(kAgent, 9);
  trail_.raise_floor(kAgent, 2);
  trail_.push(lit(2));
  trail_.lower_cap(kAgent, 11);
  trail_.lower_cap(kAgent, 7);
  trail_.raise_floor(kAgent, 1);
  trail_.raise_floor(kAgent, 4);
  EXPECT_EQ(trail_.cap(kAgent), 7);
  EXPECT_EQ(trail_.floor(kAgent), 4);
  trail_.retract(1);
  EXPECT_EQ(trail_.cap(kAgent), 9);
  EXPECT_EQ(trail_.floor(kAgent), 2);
  trail_.retract(0);
  EXPECT_EQ(trail_.cap(kAgent), kNoCap);
  EXPECT_EQ(trail_.floor(kAgent), 0);
}

}  // namespace
}  // namespace quadrille::lazy
