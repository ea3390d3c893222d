// SPDX-License-Identifier: MIT
//
// The clauses about two agents against plans of the oracle. In whole searches few are made.
#include "theory/pair_lemmas.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "continuous/routes/order_search.hpp"
#include "continuous/support/random_instance.hpp"
#include "continuous/support/roads.hpp"
#include "support/environment.hpp"
#include "theory/lemma_auditor.hpp"

namespace quadrille::continuous::test {
namespace {

/// As many as it takes until the pair is searched.
constexpr int kCollisions = 4;

/// Keeps the clauses about pairs.
class Collector final : public FormulaWriter {
 public:
  [[nodiscard]] sat::Lit new_lit() override { return sat::Lit::from_dimacs(++last_); }
  void add(const sat::Lemma& lemma) override {
    if (lemma.is<sat::why::Pair>()) clauses_.emplace_back(lemma.clause.begin(), lemma.clause.end());
  }
  [[nodiscard]] const std::vector<std::vector<sat::Lit>>& clauses() const { return clauses_; }

 private:
  int last_ = 0;
  std::vector<std::vector<sat::Lit>> clauses_;
};

struct Count {
  int searches = 0, clauses = 0;
  int with_obstacles = 0;  ///< Of the clauses.
};

class PairLemmaAudit {
 public:
  PairLemmaAudit(const Instance& instance, Draw& draw, Count& count)
      : instance_(instance), draw_(draw), count_(count) {}

  /// Looks for clauses that tell of caps and bans near `plan`; none may exclude any of `plans`.
  void check(const Plan& plan, const std::vector<Plan>& plans) {
    LimitMonitor limits({});
    Scene scene(instance_, limits);
    Model model(scene);
    Collector writer;
    PairLemmas lemmas(model);
    const int raised = static_cast<int>(draw_.number(0, 2));  // 2: neither
    std::vector<ObstacleId> active[2];
    PairLemmas::Party parties[2];
    for (const AgentId i : instance_.agent_ids()) {
      const Cost own = cost(plan.paths[i]);
      // One agent has to cost more than its cap, or a ban keeps one from what it does.
      const bool is_raised = static_cast<int>(i.index()) == raised && own > model.free_cost(i);
      const Cost cap = is_raised ? draw_.number(model.free_cost(i), own - 1) : own;
      if (draw_.chance(60)) add_obstacles(model, i, plan.paths[i], writer, active[i.index()]);
      parties[i.index()] = {i, cap, active[i.index()]};
    }
    bool is_added = false;
    for (int k = 0; k < kCollisions && !is_added; ++k)
      is_added = lemmas.note_collision(parties[0], parties[1], writer);
    ASSERT_EQ(is_added, !writer.clauses().empty());
    ++count_.searches;
    for (const auto& clause : writer.clauses()) {
      ++count_.clauses;
      count_.with_obstacles += clause.size() > 2 ? 1 : 0;
      for (const Plan& known : plans) {
        LemmaAuditor auditor(model, false, known);
        auditor.on_lemma({sat::why::Pair{}, clause, {}, false});
        ASSERT_FALSE(auditor.complaint()) << *auditor.complaint();
      }
    }
  }

 private:
  /// Some that the path breaks, some at random, each due to nobody in particular.
  void add_obstacles(Model& model, AgentId i, const Path& path, FormulaWriter& writer,
                     std::vector<ObstacleId>& active) {
    const Roadmap& roadmap = instance_.roadmap();
    for (int k = 0; k < 3; ++k) {
      const auto& stop = path[static_cast<std::size_t>(
          draw_.number(0, static_cast<std::int64_t>(path.size()) - 1))];
      VertexId vertex = stop.vertex;
      Ticks begin = stop.arrive - draw_.ticks(1, 20), end = stop.depart + draw_.ticks(1, 20);
      if (draw_.chance(50)) {
        vertex = VertexId(static_cast<std::size_t>(
            draw_.number(0, static_cast<std::int64_t>(roadmap.num_vertices()) - 1)));
        begin = draw_.ticks(0, cost(path) + 30);
        end = begin + draw_.ticks(1, 40);
      }
      if (vertex == instance_.agent(i).start && begin < 0) continue;
      bool is_new = false;
      const ObstacleId id = model.usage(i, {Ban::stay(vertex, {begin, end})}, i, writer, is_new);
      if (is_new) active.push_back(id);
    }
  }

  const Instance& instance_;
  Draw& draw_;
  Count& count_;
};

/// Collisions of the two agents of an instance, each at so much more than its free cost.
class Collisions {
 public:
  explicit Collisions(Instance instance, Cost slack = 0)
      : instance_(std::move(instance)),
        scene_(instance_, limits_),
        model_(scene_),
        slack_(slack),
        lemmas_(model_) {}

  /// Whether the next one becomes a clause about the pair.
  [[nodiscard]] bool next() {
    const AgentId i(0), j(1);
    return lemmas_.note_collision({i, model_.free_cost(i) + slack_},
                                  {j, model_.free_cost(j) + slack_}, writer_);
  }
  [[nodiscard]] PairLemmas& lemmas() { return lemmas_; }

 private:
  Instance instance_;
  LimitMonitor limits_{{}};
  Scene scene_;
  Model model_;
  Cost slack_;
  Collector writer_;
  PairLemmas lemmas_;
};

/// Which of so many collisions at the free costs become a clause about the pair.
std::vector<int> refuted_collisions(const Instance& instance, int num_collisions) {
  Collisions collisions(instance);
  std::vector<int> refuted;
  for (int k = 1; k <= num_collisions; ++k)
    if (collisions.next()) refuted.push_back(k);
  return refuted;
}

/// Two agents that have to change sides in a corridor, and cannot.
Instance corridor() {
  return Instance::make(roadmap({{0, 0}, {20, 0}, {40, 0}, {60, 0}}, {{0, 1}, {1, 2}, {2, 3}}),
                        {agent(0, 3, 2), agent(3, 0, 2)})
      .value();
}

// With much room, intervals of starts are too long at first to tell that the two meet.
TEST(PairLemmas, ShortenIntervalsUntilTheyTellWhoPasses) {
  constexpr Cost kSlack = 50;
  const Instance instance = corridor();
  LimitMonitor limits({});
  Scene scene(instance, limits);
  PairSearch search(scene);
  const auto party = [&](AgentId i) {
    return PairSearch::Party{i, as_ticks(scene.free_cost(i) + kSlack)};
  };
  EXPECT_EQ(search.refuted_raise(party(AgentId(0)), party(AgentId(1)), Ticks{0}, 1'000'000),
            Ticks{0});
  Collisions collisions(instance, kSlack);
  // The first search has too few steps.
  for (int k = 1; k < 2 * kCollisions; ++k) EXPECT_FALSE(collisions.next());
  EXPECT_TRUE(collisions.next());
}

TEST(PairLemmas, SearchOnlyProvenPairsWhereTheyAreAskedTo) {
  Collisions collisions(corridor());
  collisions.lemmas().set_scope(PairLemmas::Scope::proven);
  for (int k = 0; k < 3 * kCollisions; ++k) EXPECT_FALSE(collisions.next());
  collisions.lemmas().set_scope(PairLemmas::Scope::all);
  for (int k = 1; k < kCollisions; ++k) EXPECT_FALSE(collisions.next());
  EXPECT_TRUE(collisions.next());
  collisions.lemmas().set_scope(PairLemmas::Scope::proven);
  EXPECT_FALSE(collisions.next());
  EXPECT_TRUE(collisions.next());
}

// Clauses about single collisions are made, too, the more the longer the same caps come again:
// where two agents have no plan, only those may prove it.
TEST(PairLemmas, LeaveCollisionsToClauses) {
  int num_refuted = 0;
  for (std::uint32_t seed = 7'000'000; seed < 7'000'060; ++seed) {
    const std::vector<int> refuted = refuted_collisions(random_pair(seed), 300);
    if (refuted.empty()) continue;
    EXPECT_EQ(refuted, (std::vector<int>{kCollisions, kCollisions + 2, 4 * (kCollisions + 2),
                                         16 * (kCollisions + 2)}))
        << "seed " << seed;
    ++num_refuted;
  }
  EXPECT_GT(num_refuted, 0);
}

TEST(PairLemmas, ExcludeNoPlan) {
  const auto instances = static_cast<std::uint32_t>(support::scaled(300));
  Count count;
  for (std::uint32_t seed = 7'000'000; seed < 7'000'000 + instances; ++seed) {
    const Instance instance = random_pair(seed);
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + describe(instance));
    const std::vector<Plan> plans = known_plans(instance, 4);
    Draw draw(seed);
    PairLemmaAudit audit(instance, draw, count);
    for (const Plan& plan : plans) {
      audit.check(plan, plans);
      if (testing::Test::HasFatalFailure()) return;
    }
  }
  testing::Test::RecordProperty("searches", count.searches);
  testing::Test::RecordProperty("clauses", count.clauses);
  testing::Test::RecordProperty("with_obstacles", count.with_obstacles);
  // The test is of no use if there are none.
  EXPECT_GT(20 * count.clauses, count.searches);
  EXPECT_GT(5 * count.with_obstacles, count.clauses);
}

}  // namespace
}  // namespace quadrille::continuous::test
