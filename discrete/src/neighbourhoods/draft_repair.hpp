// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <utility>

#include "neighbourhoods/plan_repair.hpp"

namespace quadrille::discrete {

/// Which drafts are repaired, and for how long: one at a time, over many slices, and less and less
/// often when the plans that come of it are no good.
class DraftRepair {
 public:
  /// `instance` outlives the object.
  DraftRepair(const Instance& instance, std::shared_ptr<const GoalDistances> distances,
              std::uint32_t seed)
      : repair_(instance, std::move(distances), seed) {}

  /// Whether the next draft will be taken.
  [[nodiscard]] bool wants_draft() const noexcept { return !is_at_work_ && num_to_skip_ == 0; }
  /// There was one that was not wanted.
  void let_pass() noexcept {
    if (!is_at_work_ && num_to_skip_ > 0) --num_to_skip_;
  }
  /// Begins with a draft: a path from start to goal for each agent. Requires that it is wanted.
  void begin(const Plan& draft);

  [[nodiscard]] bool is_at_work() const noexcept { return is_at_work_; }
  /// Goes on with the draft. True when it has become a plan; what was good about it is to be
  /// `report`ed then. A draft whose meetings have not halved for too long is dropped. Requires one
  /// at work.
  bool advance(std::int64_t effort, LimitMonitor& limits);
  /// Requires that `advance` returned true at last.
  [[nodiscard]] const Plan& plan() const noexcept { return repair_.plan(); }
  /// How long a halving may take: 1 at first, doubled whenever a draft is dropped, halved when one
  /// becomes a plan.
  [[nodiscard]] std::int64_t patience() const noexcept { return patience_; }
  /// Elementary steps so far.
  [[nodiscard]] std::int64_t effort() const noexcept { return repair_.effort(); }
  /// Was the plan of any use?
  void report(bool was_useful);

 private:
  static constexpr std::int64_t kLongestPause = 7;

  void begin_halving();

  PlanRepair repair_;
  bool is_at_work_ = false;
  std::int64_t pause_ = 0, num_to_skip_ = 0;  // Drafts to let pass.
  std::int64_t patience_ = 1;                 // Grows when drafts are dropped.
  std::int64_t effort_per_halving_ = 0;
  std::int64_t half_ = 0;        // The draft is dropped unless it comes to this number of meetings
  std::int64_t dropped_at_ = 0;  // before it has taken this effort.
};

}  // namespace quadrille::discrete
