// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "discrete/lazy/situation.hpp"
#include "lazy/lazy_theory.hpp"
#include "support/joint_search.hpp"
#include "support/recording_context.hpp"

// The lazy path theory between its host and a judge.
namespace quadrille::discrete::support {

using sat::Lit;
using sat::Truth;
using VariableKind = LazyModel::VariableKind;

using quadrille::support::RecordingContext;

struct Count {
  std::size_t silent = 0, conflicts = 0, accepted = 0, rejected = 0, decisions = 0, stops = 0,
              dead = 0, told = 0;
};

/// The theory between the host and a judge.
class WatchedTheory final : public sat::Theory {
 public:
  WatchedTheory(LazyModel& model, Count& count)
      : model_(model), theory_(model, limits_, {}), count_(count) {}

  void on_solve(bool all_present) {
    is_part_ = !all_present;
    theory_.on_solve(all_present);
  }
  void on_assign(std::span<const Lit> newly_true) override {
    ASSERT_FALSE(newly_true.empty());
    stack_.insert(stack_.end(), newly_true.begin(), newly_true.end());
    theory_.on_assign(newly_true);
  }
  void on_retract(std::size_t kept) override {
    stack_.resize(kept);
    theory_.on_retract(kept);
    has_retracted_ = true;
  }
  /// The end of a solver.
  void forget() {
    if (!stack_.empty()) on_retract(0);
  }
  sat::Lemma explain(Lit implied, std::vector<Lit>& clause) override {
    ADD_FAILURE() << "asked for the reason of something that was never propagated";
    return theory_.explain(implied, clause);
  }
  void check(sat::Extent extent, sat::TheoryContext& context) override {
    RecordingContext said(context);
    std::vector<Path> before;
    for (const AgentId i : model_.instance().agent_ids()) before.push_back(theory_.path(i));
    theory_.check(extent, said);
    const Situation now(model_, stack_);
    if (extent == sat::Extent::partial) {
      judge_partial(said, now);
      for (const AgentId i : model_.instance().agent_ids())
        if (theory_.path(i) != before[i.index()]) expect_bound_told(i, said, now);
      if (has_retracted_ && stack_.size() % 4 == 0) compare_with_fresh(context, now);
      has_retracted_ = false;
    } else {
      judge_full(said, now);
    }
  }
  [[nodiscard]] Lit decide(sat::TheoryContext& context) override {
    RecordingContext said(context);
    const Lit choice = theory_.decide(said);
    const Situation now(model_, stack_);
    EXPECT_TRUE(!choice.valid() || !now.is_assigned(choice));
    EXPECT_TRUE(!choice.valid() || model_.variable(choice).kind != VariableKind::auxiliary);
    if (!is_part_) {
      EXPECT_TRUE(!choice.valid() && !said.stopped && said.lemmas.empty());
    }
    if (said.stopped) {
      EXPECT_FALSE(choice.valid());
      expect_good_paths(theory_, now);
      expect_no_collision(now);
      ++count_.stops;
    }
    count_.decisions += choice.valid() ? 1 : 0;
    return choice;
  }

 private:
  [[nodiscard]] static bool has_conflict(const RecordingContext& said, const Situation& now) {
    return std::any_of(said.lemmas.begin(), said.lemmas.end(),
                       [&](const auto& clause) { return now.is_false(clause); });
  }
  void judge_partial(const RecordingContext& said, const Situation& now) {
    const bool is_feasible = has_all_paths(now);
    if (!is_feasible) {
      EXPECT_TRUE(has_conflict(said, now)) << "an agent without a path went unnoticed";
    } else if (!has_conflict(said, now)) {
      expect_good_paths(theory_, now);
    }
    ++(is_feasible ? count_.silent : count_.conflicts);
  }
  /// A new path that is costlier than a bound which nobody has spoken of comes with a lemma that
  /// refutes the bound: the search that found the path has proved it.
  void expect_bound_told(AgentId i, const RecordingContext& said, const Situation& now) {
    const auto cost = static_cast<Timestep>(theory_.path(i).size()) - 1;
    Lit open;  // the largest one; ordered literals imply the others
    for (const auto& rung : model_.rungs(i))
      if (rung.cost <= cost && !now.is_assigned(rung.at_least)) open = rung.at_least;
    if (!open.valid()) return;
    ++count_.told;
    EXPECT_TRUE(std::any_of(said.lemmas.begin(), said.lemmas.end(),
                            [&](const auto& clause) {
                              return std::find(clause.begin(), clause.end(), open) !=
                                         clause.end() &&
                                     std::all_of(clause.begin(), clause.end(), [&](Lit lit) {
                                       return lit == open || now.is_false(lit);
                                     });
                            }))
        << "agent " << i.value();
  }
  void judge_full(const RecordingContext& said, const Situation& now) {
    if (said.made_literal || has_conflict(said, now)) {
      ++count_.rejected;
      return;
    }
    // A lemma that is true does not complain about the assignment.
    ++count_.accepted;
    EXPECT_TRUE(has_all_paths(now));
    expect_good_paths(theory_, now);
    expect_no_collision(now);
    ASSERT_EQ(theory_.accepted().has_value(), now.all_present());
    if (!now.all_present()) return;
    EXPECT_EQ(support::replay(model_.instance(), *theory_.accepted()), "");
    for (const AgentId i : model_.instance().agent_ids())
      EXPECT_EQ(theory_.accepted()->paths[i], theory_.path(i));
  }
  /// A theory that has never seen anything else than this stack finds the same.
  void compare_with_fresh(sat::TheoryContext& context, const Situation& now) {
    LimitMonitor limits{Limits{}};
    LazyTheory fresh(model_, limits, {});
    if (!stack_.empty()) fresh.on_assign(stack_);
    RecordingContext said(context);
    said.is_trial = true;
    fresh.check(sat::Extent::partial, said);
    EXPECT_EQ(has_conflict(said, now), !has_all_paths(now));
    if (has_conflict(said, now)) return;
    expect_good_paths(fresh, now);
  }

  [[nodiscard]] bool has_all_paths(const Situation& now) const {
    for (const AgentId i : model_.instance().agent_ids())
      if (now.is_present(i) && !now.has_path(i)) return false;
    return true;
  }
  static void expect_good_paths(const LazyTheory& theory, const Situation& now) {
    for (const AgentId i : now.model.instance().agent_ids()) {
      const std::string fault = now.is_present(i) ? now.find_fault(i, theory.path(i)) : "";
      EXPECT_EQ(fault, "") << "the path of agent " << i.value();
    }
  }
  void expect_no_collision(const Situation& now) const {
    for (const AgentId i : model_.instance().agent_ids())
      for (const AgentId j : model_.instance().agent_ids()) {
        const bool matters = i < j && now.is_present(i) && now.is_present(j);
        EXPECT_FALSE(matters && support::collide(theory_.path(i), theory_.path(j)));
      }
  }

  LazyModel& model_;
  LimitMonitor limits_{Limits{}};
  LazyTheory theory_;
  Count& count_;
  std::vector<Lit> stack_;
  bool is_part_ = false, has_retracted_ = false;
};

}  // namespace quadrille::discrete::support
