// SPDX-License-Identifier: MIT
//
// Lemmas of encounters as they are made, and the same with one ban that is a tick too long.
#include "theory/lemma_auditor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "continuous/support/random_instance.hpp"
#include "continuous/support/roads.hpp"
#include "support/environment.hpp"
#include "theory/encounters.hpp"
#include "theory/pair_lemmas.hpp"

namespace quadrille::continuous::test {
namespace {

using sat::Lit;
using testing::HasSubstr;

/// Keeps what it is given.
class Keeper final : public FormulaWriter {
 public:
  struct Kept {
    sat::Why why;
    [[nodiscard]] bool is_path() const { return std::holds_alternative<sat::why::Path>(why); }
    std::vector<Lit> clause;
    std::vector<sat::Usage> usages;
  };
  [[nodiscard]] Lit new_lit() override { return Lit::from_dimacs(++last_); }
  void add(const sat::Lemma& lemma) override {
    kept_.push_back({lemma.why,
                     {lemma.clause.begin(), lemma.clause.end()},
                     {lemma.usages.begin(), lemma.usages.end()}});
  }
  [[nodiscard]] const std::vector<Kept>& kept() const { return kept_; }

 private:
  int last_ = 0;
  std::vector<Kept> kept_;
};

std::optional<std::string> complaint(const Model& model, const Keeper::Kept& kept) {
  LemmaAuditor auditor(model, true, std::nullopt);
  auditor.on_lemma({kept.why, kept.clause, kept.usages, false});
  return auditor.complaint();
}

/// The lemmas of the first encounters of the agents' cheapest paths.
class Encounters {
 public:
  explicit Encounters(const Instance& instance)
      : instance_(instance),
        finder_(instance_),
        bans_(instance_.roadmap()),
        clauses_(model_, finder_, bans_) {
    std::vector<std::vector<Step>> steps(instance.num_agents());
    std::vector<Ticks> arrivals;
    for (const AgentId i : instance.agent_ids()) {
      TimedPath path;
      bans_.clear(scene_.standing_bans(i));
      if (!finder_.find(scene_.task(i), bans_, kForever, &path)) return;  // obstacles leave no way
      list_steps(instance, i, path, steps[i.index()]);
      arrivals.push_back(path.arrival);
    }
    for (std::size_t i = 0; i < steps.size(); ++i)
      for (std::size_t j = i + 1; j < steps.size(); ++j)
        if (const auto found = first_encounter(scene_, AgentId(i), steps[i], AgentId(j), steps[j]))
          clauses_.exclude(*found, arrivals[i], arrivals[j], writer_);
  }

  [[nodiscard]] Model& model() { return model_; }
  [[nodiscard]] Keeper& writer() { return writer_; }

  /// The lemma with the bans of one side changed.
  template <class Change>
  [[nodiscard]] Keeper::Kept changed(Keeper::Kept kept, std::size_t side, const Change& change) {
    const ObstacleId id(static_cast<std::size_t>(kept.usages[side].resource));
    const Obstacle old = model_.obstacles()[id];
    std::vector<Ban> bans = old.bans;
    for (Ban& ban : bans) change(ban);
    bool is_new = false;
    const ObstacleId made = model_.usage(old.agent, bans, old.partners[0], writer_, is_new);
    for (Lit& lit : kept.clause)
      if (lit == ~old.allowed) lit = ~model_.obstacles()[made].allowed;
    kept.usages[side].resource = made.value();
    return kept;
  }

 private:
  const Instance instance_;
  LimitMonitor limits_{Limits{}};
  Scene scene_{instance_, limits_};
  Model model_{scene_};
  PathFinder finder_;
  BanTable bans_;
  EncounterClauses clauses_;
  Keeper writer_;
};

TEST(LemmaAuditor, DerivesLemmasOfEncounters) {
  int collisions = 0, paths = 0, refused = 0;
  for (std::uint32_t seed = 0; seed < support::scaled(400); ++seed) {
    const Instance instance = random_instance(9'000'000 + seed, {});
    SCOPED_TRACE("seed " + std::to_string(9'000'000 + seed) + ": " + describe(instance));
    Encounters encounters(instance);
    const auto kept = encounters.writer().kept();
    for (const auto& lemma : kept) {
      ASSERT_EQ(complaint(encounters.model(), lemma), std::nullopt);
      paths += lemma.is_path() ? 1 : 0;
      if (!sat::is_collision(lemma.why)) continue;
      ++collisions;
      // The bans of both sides are as long as can be at their ends, which a tick more shows.
      for (const std::size_t side : {0U, 1U}) {
        const auto longer = encounters.changed(lemma, side, [](Ban& ban) { ban.when.end += 1; });
        refused += complaint(encounters.model(), longer) ? 1 : 0;
      }
    }
  }
  EXPECT_GT(collisions, 0);
  EXPECT_GT(paths, 0);
  EXPECT_EQ(refused, 2 * collisions);
}

/// Two roads that cross, at the same time.
class LemmaAuditorOnACrossing : public testing::Test {
 protected:
  LemmaAuditorOnACrossing()
      : encounters_(
            Instance::make(roadmap({{0, 50}, {100, 50}, {50, 0}, {50, 100}}, {}, {{0, 1}, {2, 3}}),
                           {agent(0, 1, 10), agent(2, 3, 10)})
                .value()) {}
  [[nodiscard]] Keeper::Kept first_path() {
    for (const auto& lemma : encounters_.writer().kept())
      if (lemma.is_path()) return lemma;
    ADD_FAILURE() << "no such lemma";
    return {};
  }
  [[nodiscard]] std::optional<std::string> said_of(const Keeper::Kept& lemma) {
    return complaint(encounters_.model(), lemma);
  }
  Encounters encounters_;
};

TEST_F(LemmaAuditorOnACrossing, SeesACostThatIsATickTooHigh) {
  Keeper::Kept lemma = first_path();
  ASSERT_EQ(said_of(lemma), std::nullopt);
  for (Lit& lit : lemma.clause) {
    const auto meaning = encounters_.model().variable(lit);
    if (meaning.kind == Model::VariableKind::cost)
      lit = encounters_.model().at_least(meaning.agent, meaning.cost + 1, encounters_.writer());
  }
  EXPECT_THAT(said_of(lemma).value_or(""), HasSubstr("some path breaks a path lemma"));
}

TEST_F(LemmaAuditorOnACrossing, SeesAMissingLiteral) {
  Keeper::Kept lemma = first_path();
  const Lit allowed =
      encounters_.model().obstacles()[ObstacleId(std::size_t{lemma.usages[0].resource})].allowed;
  std::erase(lemma.clause, allowed);
  EXPECT_THAT(said_of(lemma).value_or(""), HasSubstr("lacks the literal"));
}

TEST_F(LemmaAuditorOnACrossing, SeesAnOrderTheWrongWayRound) {
  Model& model = encounters_.model();
  const Lit weaker = model.at_least(AgentId(0), 110, encounters_.writer());
  const Lit stronger = model.at_least(AgentId(0), 111, encounters_.writer());
  EXPECT_EQ(said_of({sat::why::Order{AgentId(0)}, {~stronger, weaker}, {}}), std::nullopt);
  EXPECT_TRUE(said_of({sat::why::Order{AgentId(0)}, {~weaker, stronger}, {}}));
}

TEST(LemmaAuditor, SeesALemmaOfAPairThatIsATickTooStrong) {
  // The two pass each other if one of them waits for 6 ticks: offsets from -5 to 5 are unsafe.
  Encounters encounters(
      Instance::make(roadmap({{0, 10}, {20, 10}, {10, 0}, {10, 20}}, {}, {{0, 1}, {2, 3}}),
                     {agent(0, 1, 2), agent(2, 3, 2)})
          .value());
  Model& model = encounters.model();
  const auto said_of = [&](Cost first, Cost second) {
    return complaint(model, {sat::why::Pair{AgentId(0), AgentId(1)},
                             {model.at_least(AgentId(0), first, encounters.writer()),
                              model.at_least(AgentId(1), second, encounters.writer())},
                             {}});
  };
  EXPECT_EQ(said_of(26, 26), std::nullopt);
  EXPECT_THAT(said_of(27, 26).value_or(""), HasSubstr("lemma of a pair"));
  EXPECT_THAT(said_of(26, 27).value_or(""), HasSubstr("lemma of a pair"));
}

TEST(LemmaAuditor, DerivesBansAroundAGoal) {
  // Agent 0 stays at vertex 1 from tick 100 on at the earliest. Agent 1 drives over it and is in
  // contact with it during (80, 120).
  Encounters encounters(
      Instance::make(roadmap({{0, 0}, {100, 0}, {100, 100}, {100, -100}}, {{0, 1}, {2, 3}}),
                     {agent(0, 1, 10), agent(2, 3, 10)})
          .value());
  Model& model = encounters.model();
  const auto said_of_goal_from = [&](Ticks tick) {
    bool is_new = false;
    const ObstacleId id =
        model.keep_off_goal(AgentId(1), AgentId(0), model.instance().agent(AgentId(0)).goal(), tick,
                            encounters.writer(), is_new);
    return complaint(
        model,
        {sat::why::Path{AgentId(1)}, {model.obstacles()[id].allowed}, {{AgentId(1), id.value()}}});
  };
  EXPECT_EQ(said_of_goal_from(120), std::nullopt);
  EXPECT_THAT(said_of_goal_from(121).value_or(""), HasSubstr("some path breaks"));
}

TEST(LemmaAuditor, DerivesWhereAgentsWithAChoiceRest) {
  // Both may end at vertex 1, or each where the other one cannot.
  const auto with_choice = [](std::size_t start, std::size_t own) {
    Agent made = agent(start, own, 10);
    made.goals = Goals({VertexId(1), VertexId(own)});
    return made;
  };
  Encounters encounters(
      Instance::make(roadmap({{0, 0}, {100, 0}, {100, 100}, {100, -100}}, {{0, 1}, {2, 1}, {1, 3}}),
                     {with_choice(0, 3), with_choice(2, 0)})
          .value());
  Model& model = encounters.model();
  bool is_new = false;
  const auto end = [&](std::size_t i, std::size_t goal) {
    return model.end(AgentId(i), VertexId(goal), AgentId(1 - i), encounters.writer(), is_new);
  };
  const auto said_of_ends = [&](ObstacleId one, ObstacleId other) {
    const Obstacle &a = model.obstacles()[one], &b = model.obstacles()[other];
    return complaint(model, {sat::why::Goal{AgentId(1)},
                             {~a.allowed, ~b.allowed},
                             {{AgentId(0), one.value()}, {AgentId(1), other.value()}}});
  };
  EXPECT_EQ(said_of_ends(end(0, 1), end(1, 1)), std::nullopt);
  EXPECT_THAT(said_of_ends(end(0, 1), end(1, 0)).value_or(""), HasSubstr("two agents can do"));
  // Who ends there and costs less than that rests there and costs less.
  static_cast<void>(
      model.keep_off_goal(AgentId(1), AgentId(0), VertexId(1), 150, encounters.writer(), is_new));
  const auto& kept = encounters.writer().kept();
  const auto rest = std::find_if(kept.begin(), kept.end(), [](const Keeper::Kept& lemma) {
    return std::holds_alternative<sat::why::Rest>(lemma.why);
  });
  ASSERT_NE(rest, kept.end());
  EXPECT_EQ(complaint(model, *rest), std::nullopt);
  Keeper::Kept wrong = *rest;
  wrong.clause[1] = model.at_least(AgentId(0), 151, encounters.writer());
  EXPECT_THAT(complaint(model, wrong).value_or(""), HasSubstr("rest"));
  wrong = *rest;
  wrong.clause[0] = model.obstacles()[end(0, 3)].allowed;
  EXPECT_THAT(complaint(model, wrong).value_or(""), HasSubstr("rest"));
}

}  // namespace
}  // namespace quadrille::continuous::test
