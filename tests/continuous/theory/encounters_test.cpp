// SPDX-License-Identifier: MIT
// Clauses of encounters: the encounter breaks them, and what they exclude does collide, as found by
// trying moments.
#include "theory/encounters.hpp"

#include <gtest/gtest.h>

#include "continuous/support/meeting.hpp"
#include "continuous/support/random_instance.hpp"
#include "support/environment.hpp"

namespace quadrille::continuous::test {
namespace {

/// Keeps the usages of collision lemmas.
class Keeper final : public FormulaWriter {
 public:
  [[nodiscard]] sat::Lit new_lit() override { return sat::Lit::from_dimacs(++last_); }
  void add(const sat::Lemma& lemma) override {
    if (sat::is_collision(lemma.why))
      collisions.emplace_back(lemma.usages.begin(), lemma.usages.end());
  }
  std::vector<std::vector<sat::Usage>> collisions;

 private:
  int last_ = 0;
};

struct Side {
  AgentId agent;
  std::vector<Step> steps;
  PathUses uses;
  Ticks arrival = 0;
};

class Judge {
 public:
  explicit Judge(const Instance& instance) : instance_(instance), meetings_(instance) {}

  /// Whether everything that one ban forbids collides with everything that the other one does.
  [[nodiscard]] bool collide(const Obstacle& a, const Ban& x, const Obstacle& b, const Ban& y) {
    const ClassId c = instance_.class_of(a.agent), d = instance_.class_of(b.agent);
    if (x.kind == Ban::Kind::stay) return y.kind == Ban::Kind::start && collide(b, y, a, x);
    if (y.kind == Ban::Kind::start) {
      const auto& run = meetings_.moves(c, EdgeId(x.place), d, EdgeId(y.place));
      return run && y.when.first() - x.when.last() >= run->first &&
             y.when.last() - x.when.first() <= run->last;
    }
    // The stays that end as early, and those that begin as late as the ban says.
    const auto& clear = meetings_.stay(c, EdgeId(x.place), d, VertexId(y.place));
    return clear && x.when.last() < y.when.begin + 1 + clear->after_leaving &&
           y.when.end - 1 < x.when.first() + clear->before_arrival;
  }
  /// Whether what the ban forbids collides with a rest at `goal` that begins by `tick`.
  [[nodiscard]] bool meets_rest(AgentId mover, const Ban& ban, AgentId resident, Ticks tick) {
    const ClassId c = instance_.class_of(mover), d = instance_.class_of(resident);
    const VertexId goal = instance_.agent(resident).goal();
    if (ban.kind == Ban::Kind::start) {
      const auto& clear = meetings_.stay(c, EdgeId(ban.place), d, goal);
      return clear && tick < ban.when.first() + clear->before_arrival;
    }
    const Roadmap& roadmap = instance_.roadmap();
    const Point p = roadmap.position(VertexId(ban.place)), q = roadmap.position(goal);
    return meet({p, p, 0, 1}, instance_.body(c, roadmap.shape(VertexId(ban.place))), {q, q, 0, 1},
                instance_.body(d, roadmap.shape(goal))) &&
           ban.when.begin + 1 > tick;
  }

 private:
  const Instance& instance_;
  Meetings meetings_;
};

struct Count {
  int pairs = 0, rests = 0, lifted = 0;
};

class Excluded {
 public:
  explicit Excluded(const Instance& instance) : instance_(instance), judge_(instance) {
    for (const AgentId i : instance.agent_ids()) {
      TimedPath path;
      bans_.clear(scene_.standing_bans(i));
      if (!finder_.find(scene_.task(i), bans_, kForever, &path)) {
        sides_.clear();  // obstacles leave no way
        return;
      }
      Side side{i, {}, {}, path.arrival};
      list_steps(instance, i, path, side.steps);
      side.uses.assign(instance, i, path);
      sides_.push_back(std::move(side));
    }
  }
  void run(Count& count) {
    for (const Side& i : sides_)
      for (const Side& j : sides_)
        if (i.agent < j.agent)
          if (const auto found = first_encounter(scene_, i.agent, i.steps, j.agent, j.steps))
            exclude(*found, i, j, count);
  }

 private:
  void exclude(const Encounter& encounter, const Side& i, const Side& j, Count& count) {
    const std::size_t num_obstacles = model_.obstacles().size();
    writer_.collisions.clear();
    clauses_.exclude(encounter, i.arrival, j.arrival, writer_);
    bool is_excluded = false;
    for (const auto& usages : writer_.collisions) {
      ASSERT_EQ(usages.size(), 2u);
      const Obstacle& a = obstacle(usages[0]);
      const Obstacle& b = obstacle(usages[1]);
      is_excluded |= side(a).uses.breaks(a.bans) && side(b).uses.breaks(b.bans);
      for (const Ban& x : a.bans)
        for (const Ban& y : b.bans) EXPECT_TRUE(judge_.collide(a, x, b, y));
      ++count.pairs;
      count.lifted += a.bans.size() + b.bans.size() > 2 ? 1 : 0;
    }
    for (std::size_t n = num_obstacles; n < model_.obstacles().size(); ++n) {
      const Obstacle& o = model_.obstacles()[ObstacleId(n)];
      const auto meaning = model_.variable(o.allowed);
      if (meaning.kind != Model::VariableKind::cost) continue;
      // Active while the resident costs less than meaning.cost.
      EXPECT_EQ(o.agent, i.agent == meaning.agent ? j.agent : i.agent);
      is_excluded |= side(o).uses.breaks(o.bans) &&
                     as_cost(sides_[meaning.agent.index()].arrival) < meaning.cost;
      for (const Ban& ban : o.bans)
        EXPECT_TRUE(judge_.meets_rest(o.agent, ban, meaning.agent, as_ticks(meaning.cost - 1)));
      ++count.rests;
    }
    EXPECT_TRUE(is_excluded) << "agents " << i.agent.value() << " and " << j.agent.value();
  }
  [[nodiscard]] const Obstacle& obstacle(const sat::Usage& usage) const {
    return model_.obstacles()[ObstacleId(static_cast<std::size_t>(usage.resource))];
  }
  [[nodiscard]] const Side& side(const Obstacle& o) const { return sides_[o.agent.index()]; }

  const Instance& instance_;
  LimitMonitor limits_{Limits{}};
  Scene scene_{instance_, limits_};
  Model model_{scene_};
  PathFinder finder_{instance_};
  BanTable bans_{instance_.roadmap()};
  EncounterClauses clauses_{model_, finder_, bans_};
  Keeper writer_;
  Judge judge_;
  std::vector<Side> sides_;
};

TEST(EncounterClauses, ExcludeTheEncounterAndCollisionsOnly) {
  Count count;
  for (std::uint32_t seed = 0; seed < support::scaled(600) && !testing::Test::HasFailure();
       ++seed) {
    RandomOptions options;
    options.max_radius = 4 + static_cast<Length>(seed % 6);
    const Instance instance = random_instance(4'000'000 + seed, options);
    SCOPED_TRACE("seed " + std::to_string(4'000'000 + seed) + ": " + describe(instance));
    Excluded(instance).run(count);
  }
  if (support::scaled(600) < 600) return;  // too few to count on chance
  EXPECT_GT(count.pairs, 100);
  EXPECT_GT(count.rests, 30);
  EXPECT_GT(count.lifted, 30);
}

}  // namespace
}  // namespace quadrille::continuous::test
