// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include "primal/beam_search.hpp"
#include "primal/guide.hpp"
#include "primal/lacam.hpp"
#include "primal/time_windows.hpp"
#include "quadrille/discrete/primal.hpp"
#include "settle/settle.hpp"

namespace quadrille::discrete {

/// Lacam with restarts, with and without guides.
///
/// Two guided searches have a turn each, and the cheaper plan is kept. The first follows a Guide,
/// paths from start to goal. Where its plan is dear agents are in each other's way too much for
/// plans that are made in advance, and the second one follows a LocalGuide; elsewhere a Guide that
/// allows longer detours. Without a plan then, a search without a guide takes turns with others of
/// other seeds, guided by a Guide and not, whose
/// efforts follow the sequence of Luby et al. ("Optimal speedup of Las Vegas algorithms", IPL
/// 1993). Why: how long a search takes on a crowded map has a heavy tail over the seeds; most find
/// a plan at once, some not in a thousand times as long (Gomes et al., "Heavy-tailed phenomena in
/// satisfiability and constraint satisfaction problems", JAR 2000). Of the others one at a time is
/// in memory.
///
/// If the first of all finds nothing, agents are settled one after the other: this finds a plan, if
/// a dear one, wherever there is one. The others go on for some turns then, as theirs are cheaper
/// by far. The search that goes on for ever keeps all complete where settling has exceptions.
///
/// On crowded maps, where guided searches seldom find plans, all begins with a beam search if the
/// board is small enough, then with settling if that has found nothing. The guided searches have
/// their turns after that. A dear plan of a crowded map, or of settled agents, is made cheaper in
/// windows of time at last.
class PrimalSearch::Impl {
 public:
  Impl(const Instance& instance, std::shared_ptr<const GoalDistances> distances, std::uint32_t seed,
       Part part);
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  State advance(std::int64_t effort, LimitMonitor& limits);
  [[nodiscard]] State state() const noexcept { return state_; }
  [[nodiscard]] bool is_over() const noexcept;
  [[nodiscard]] bool is_at_guides() const noexcept { return !is_over() && turn_ < kNumGuides; }
  [[nodiscard]] std::int64_t effort() const noexcept { return effort_; }
  [[nodiscard]] std::size_t num_configurations() const noexcept { return num_configurations_; }
  [[nodiscard]] bool is_worth_waiting_for() const noexcept {
    return windows_.has_value() || is_settling_due_;
  }
  [[nodiscard]] const std::shared_ptr<const Plan>& plan() const;
  [[nodiscard]] Cost cost() const;
  [[nodiscard]] std::string_view origin() const noexcept { return origin_; }

 private:
  static constexpr std::uint32_t kNumGuides = 2;
  /// Turns, where settling has found the cheapest plan and it is long: others seldom find any
  /// there, but one that costs a fourth. Measured after 3 s with 2, 6 and 10 on 22 instances of
  /// mazes and rooms that are half to three quarters full: plans of a third or less on 0, 4 and 6
  /// of them; on all others within 4 %.
  static constexpr std::uint32_t kTurnsBesideSettling = 10;

  bool begin_turn(LimitMonitor& limits);
  bool begin_local_turn(LimitMonitor& limits);
  [[nodiscard]] bool is_dear() const noexcept;
  void advance_settling(std::int64_t effort, LimitMonitor& limits);
  void advance_beam(std::int64_t effort, LimitMonitor& limits);
  void advance_windows(std::int64_t effort, LimitMonitor& limits);
  void end_settling();
  void finish_if_over();
  void begin_windows();
  void offer(Plan plan, std::string_view origin);
  void end_turn_of(const Lacam& search);
  void end_turn();
  bool make_guide(std::uint32_t kind, LimitMonitor& limits);
  [[nodiscard]] bool is_turn_of_main() const noexcept {
    return turn_ >= kNumGuides && (turn_ - kNumGuides) % 2 == 0;
  }

  const Instance instance_;
  const std::shared_ptr<const GoalDistances> distances_;
  const std::uint32_t seed_;
  const Part part_;
  const std::int64_t unit_;  // The effort of most turns.
  Cost ideal_ = 0;           // Of a plan in which nobody is in the way of others.
  State state_ = State::searching;
  std::array<std::shared_ptr<const Guide>, kNumGuides> guides_;
  std::optional<Lacam> main_;  // Goes on for ever.
  std::unique_ptr<Lacam> other_;
  std::optional<Settling> settling_;
  std::optional<BeamSearch> beam_;
  std::optional<TimeWindows> windows_;
  const bool is_crowded_;
  bool is_settling_due_ = false;  // Before the next turn.
  bool is_settled_ = false;       // The cheapest plan is one of settling.
  bool are_windows_due_ = true;   // Unless there were any.
  std::uint32_t turn_ = 0, num_restarts_ = 0;
  std::optional<std::int64_t> turn_end_;  // In efforts of the search whose turn it is.
  std::shared_ptr<const Plan> plan_;      // The cheapest; null: none.
  Cost cost_ = 0;
  std::string_view origin_;  // Of the first plan.
  std::size_t num_configurations_ = 0;
  std::int64_t effort_ = 0;
};

/// The k-th number of 1, 1, 2, 1, 1, 2, 4, 1, 1, 2, 1, 1, 2, 4, 8, ... Requires k >= 1.
[[nodiscard]] std::int64_t luby(std::uint32_t k);

}  // namespace quadrille::discrete
