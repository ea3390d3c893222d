// SPDX-License-Identifier: MIT
// Tables of bans and uses of paths against the definition of a ban, tick by tick.
#include "paths/bans.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "continuous/support/random_bans.hpp"
#include "support/environment.hpp"

namespace quadrille::continuous::test {
namespace {

constexpr Ticks kEnd = 50;

bool forbids_start(const Ban& ban, EdgeId e, Ticks tick) {
  return ban.kind == Ban::Kind::start && ban.place == e.value() && ban.when.begin <= tick &&
         tick < ban.when.end;
}
/// Some moment strictly between the begin and the end of the ban is in [arrive, depart].
bool forbids_stay(const Ban& ban, VertexId v, Ticks arrive, Ticks depart) {
  return ban.kind == Ban::Kind::stay && ban.place == v.value() && arrive < ban.when.end &&
         depart > ban.when.begin;
}

/// A table and what it has been told.
class BanTables : public testing::TestWithParam<int> {
 protected:
  void expect_starts(EdgeId e) {
    const std::uint32_t place = table_.starts_of(e);
    if (place != BanTable::kFree) {
      const auto& forbidden = table_.forbidden_starts(place);
      for (std::size_t n = 1; n < forbidden.size(); ++n)
        EXPECT_LT(forbidden[n - 1].end, forbidden[n].begin);
    }
    for (Ticks tick = -10; tick <= kEnd + 80; ++tick) {
      bool is_forbidden = false;
      if (place != BanTable::kFree)
        for (const TickInterval& when : table_.forbidden_starts(place))
          is_forbidden |= when.contains(tick);
      EXPECT_EQ(is_forbidden, is_any([&](const Ban& ban) { return forbids_start(ban, e, tick); }))
          << "edge " << e.value() << " at " << tick;
    }
  }
  void expect_stays(VertexId v) {
    const std::uint32_t place = table_.stays_of(v);
    std::vector<BanTable::SafeStay> safe{{0, kForever}};
    if (place != BanTable::kFree) safe = table_.safe_stays(place);
    for (std::size_t n = 1; n < safe.size(); ++n) {
      EXPECT_LT(safe[n - 1].from, safe[n].from);
      EXPECT_LT(safe[n - 1].until, safe[n].until);
    }
    const auto expect = [&](Ticks arrive, Ticks depart) {
      EXPECT_EQ(std::any_of(safe.begin(), safe.end(),
                            [&](const auto& s) { return s.from <= arrive && depart <= s.until; }),
                !is_any([&](const Ban& ban) { return forbids_stay(ban, v, arrive, depart); }))
          << "vertex " << v.value() << " from " << arrive << " to " << depart;
    };
    for (Ticks arrive = 0; arrive <= kEnd; ++arrive) {
      for (Ticks depart = arrive; depart <= kEnd; ++depart) expect(arrive, depart);
      expect(arrive, kForever);
    }
  }
  [[nodiscard]] bool is_any(const std::function<bool(const Ban&)>& holds) const {
    const auto bans = bans_of(slots_, [&](std::size_t slot) { return is_on_[slot]; });
    return std::any_of(bans.begin(), bans.end(), holds);
  }

  const Instance instance_ = small_instance(static_cast<std::uint32_t>(GetParam()));
  BanTable table_{instance_.roadmap()};
  Slots slots_;
  std::vector<bool> is_on_;
};

TEST_P(BanTables, SayWhatTheirBansForbid) {
  Draw draw(static_cast<std::uint32_t>(GetParam()));
  for (int fill = 0; fill < 3 && !HasFailure(); ++fill) {
    table_.clear();
    slots_ = random_slots(draw, instance_.roadmap(), 12, kEnd);
    is_on_.assign(slots_.size(), true);
    for (const auto& bans : slots_) table_.add(bans);
    ASSERT_EQ(table_.num_slots(), slots_.size());
    for (int change = 0; change < 4 && !HasFailure(); ++change) {
      for (const EdgeId e : IdRange<EdgeId>(instance_.roadmap().num_edges())) expect_starts(e);
      for (const VertexId v : IdRange<VertexId>(instance_.roadmap().num_vertices()))
        expect_stays(v);
      for (std::size_t slot = 0; slot < slots_.size(); ++slot)
        if (draw.chance(40)) {
          is_on_[slot] = !is_on_[slot];
          table_.enable(slot, is_on_[slot]);
        }
      for (std::size_t slot = 0; slot < slots_.size(); ++slot)
        EXPECT_EQ(table_.is_enabled(slot), is_on_[slot]);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seed, BanTables, testing::Range(0, 20));

TEST(PathUses, BreakABanIfTheyDoWhatItForbids) {
  int broken = 0, kept = 0;
  for (std::uint32_t seed = 0; seed < support::scaled(300); ++seed) {
    SCOPED_TRACE(seed);
    const Instance instance = small_instance(seed);
    const Roadmap& roadmap = instance.roadmap();
    Draw draw(seed);
    // A walk from the start, with waits.
    TimedPath path;
    VertexId at = instance.agent(AgentId(0)).start;
    Ticks since = 0;
    struct Stay {
      VertexId vertex;
      Ticks arrive, depart;
    };
    std::vector<Stay> stays;
    for (std::int64_t n = draw.number(0, 5); n > 0; --n) {
      std::vector<EdgeId> out;
      for (const EdgeId e : IdRange<EdgeId>(roadmap.num_edges()))
        if (roadmap.edge(e).from == at) out.push_back(e);
      if (out.empty()) break;
      const EdgeId e =
          out[static_cast<std::size_t>(draw.number(0, static_cast<int>(out.size()) - 1))];
      const Ticks start = since + (draw.chance(50) ? Ticks{0} : draw.ticks(1, 9));
      stays.push_back({at, since, start});
      path.moves.push_back({e, start});
      at = roadmap.edge(e).to;
      since = start + instance.duration(instance.class_of(AgentId(0)), e);
    }
    stays.push_back({at, since, instance.agent(AgentId(0)).leaves ? since : kForever});
    path.arrival = since;
    PathUses uses;
    uses.assign(instance, AgentId(0), path);
    for (const auto& bans : random_slots(draw, roadmap, 30, kEnd)) {
      bool any = false;
      for (const Ban& ban : bans) {
        const bool is_broken =
            std::any_of(path.moves.begin(), path.moves.end(),
                        [&](const Move& m) { return forbids_start(ban, m.edge, m.start); }) ||
            std::any_of(stays.begin(), stays.end(), [&](const Stay& s) {
              return forbids_stay(ban, s.vertex, s.arrive, s.depart);
            });
        EXPECT_EQ(uses.breaks(ban), is_broken);
        any |= is_broken;
        ++(is_broken ? broken : kept);
      }
      EXPECT_EQ(uses.breaks(bans), any);
    }
  }
  EXPECT_GT(broken, 50);
  EXPECT_GT(kept, 50);
}

}  // namespace
}  // namespace quadrille::continuous::test
