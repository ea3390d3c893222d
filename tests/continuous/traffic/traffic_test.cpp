// SPDX-License-Identifier: MIT
#include "traffic/traffic.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "continuous/support/random_instance.hpp"
#include "continuous/support/random_walk.hpp"
#include "support/environment.hpp"
#include "traffic/ready_traffic.hpp"
#include "traffic/spatial_traffic.hpp"

namespace quadrille::continuous::test {
namespace {

Instance draw_instance(std::uint32_t seed) {
  RandomOptions options;
  options.num_agents = 3 + seed % 3;
  options.num_vertices = 6 + seed / 3 % 5;
  options.edge_percent = 30 + static_cast<int>(seed / 15 % 3) * 15;
  options.max_radius = 5;
  return random_instance(seed, options);
}

/// What a table says of all places to which agents of the class can come, of starts from a tick on.
std::string contents(const Instance& instance, ClassId c, BanTable& table, Ticks from) {
  std::string text;
  const auto number = [](Ticks tick) { return std::to_string(tick.value()) + " "; };
  for (const EdgeId e : IdRange<EdgeId>(instance.roadmap().num_edges())) {
    if (!instance.may_use(c, e)) continue;
    const std::uint32_t place = table.starts_of(e, from);
    if (place == BanTable::kFree) continue;
    for (const TickInterval& when : table.forbidden_starts(place))
      if (when.end > from)
        text += "e" + std::to_string(e.value()) + ": " + number(std::max(when.begin, from)) +
                number(when.end);
  }
  for (const VertexId v : IdRange<VertexId>(instance.roadmap().num_vertices())) {
    const std::uint32_t place = table.stays_of(v);
    if (place == BanTable::kFree) continue;
    const auto& safe = table.safe_stays(place);
    if (safe.size() == 1 && safe.front().from == 0 && safe.front().until == kForever) continue;
    text += "v" + std::to_string(v.value()) + ": ";
    for (const BanTable::SafeStay& stay : safe) text += number(stay.from) + number(stay.until);
  }
  return text;
}

/// Both kinds, and the bans of all shown paths made anew.
class Traffics {
 public:
  explicit Traffics(std::uint32_t seed)
      : draw_(seed), instance_(draw_instance(seed)), scene_(instance_, limits_) {
    traffics_.push_back(std::make_unique<ReadyTraffic>(scene_));
    traffics_.push_back(std::make_unique<SpatialTraffic>(scene_));
  }

  void change() {
    const auto someone = [&] {
      return static_cast<std::size_t>(draw_.number(0, std::ssize(paths_) - 1));
    };
    const std::int64_t what = draw_.number(0, 9);
    if (what == 0) {
      for (auto& traffic : traffics_) traffic->clear();
      paths_.clear();
    } else if (paths_.empty() || what < 5) {
      const AgentId i(static_cast<std::size_t>(
          draw_.number(0, static_cast<std::int64_t>(instance_.num_agents()) - 1)));
      Path path{instance_.class_of(i), draw_steps(draw_, instance_, i), true, {}};
      for (auto& traffic : traffics_) path.handles.push_back(traffic->put(path.c, path.steps));
      paths_.push_back(std::move(path));
    } else if (what < 8) {
      Path& path = paths_[someone()];
      path.is_shown = draw_.chance(50);
      for (std::size_t k = 0; k < traffics_.size(); ++k)
        traffics_[k]->show(path.handles[k], path.is_shown);
    } else {
      const std::size_t at = someone();
      for (std::size_t k = 0; k < traffics_.size(); ++k)
        traffics_[k]->take_out(paths_[at].handles[k]);
      paths_.erase(paths_.begin() + static_cast<std::ptrdiff_t>(at));
    }
  }

  /// How many places have bans, if all agree.
  std::optional<std::size_t> compare() {
    std::size_t length = 0;
    BansAround around(scene_);
    for (const ClassId c : IdRange<ClassId>(instance_.num_classes())) {
      BanTable expected(instance_.roadmap());
      expected.clear(scene_.standing_bans(c));
      for (const Path& path : paths_) {
        if (!path.is_shown) continue;
        std::vector<Ban> bans;
        around.add(c, path.c, path.steps, bans);
        expected.add(bans);
      }
      // Bans that are over may be missing, until someone asks for them.
      const Ticks late = draw_.ticks(1, 100);
      for (auto& traffic : traffics_) {
        BanTable& table = traffic->bans(c);
        for (const Ticks from : {late, Ticks{0}, late})
          if (contents(instance_, c, table, from) != contents(instance_, c, expected, from))
            return std::nullopt;
      }
      length += contents(instance_, c, expected, 0).size();
    }
    return length;
  }
  [[nodiscard]] const Instance& instance() const { return instance_; }

 private:
  struct Path {
    ClassId c;
    std::vector<Step> steps;
    bool is_shown = true;
    std::vector<Traffic::Handle> handles;
  };
  Draw draw_;
  Instance instance_;
  LimitMonitor limits_{Limits{}};
  Scene scene_;
  std::vector<std::unique_ptr<Traffic>> traffics_;
  std::vector<Path> paths_;
};

TEST(Traffic, BothKindsForbidWhatThePathsDo) {
  std::size_t length = 0;
  for (std::uint32_t seed = 0; seed < support::scaled(150); ++seed) {
    Traffics traffics(seed);
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + describe(traffics.instance()));
    for (int k = 0; k < 60; ++k) {
      traffics.change();
      const auto same = traffics.compare();
      ASSERT_TRUE(same.has_value()) << "after " << k << " changes";
      length += *same;
    }
  }
  EXPECT_GT(length, 100'000u);
}

}  // namespace
}  // namespace quadrille::continuous::test
