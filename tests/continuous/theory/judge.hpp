// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "continuous/support/least_arrival.hpp"
#include "quadrille/continuous/verify.hpp"
#include "support/recording_context.hpp"
#include "theory/theory.hpp"

// The theory of continuous time between its host and a judge.
namespace quadrille::continuous::test {

/// What an assignment means, from nothing but the model's tables of literals and obstacles.
class Situation {
 public:
  Situation(const Model& model, const std::vector<sat::Lit>& stack) : model_(model) {
    for (const sat::Lit lit : stack) {
      const auto index = static_cast<std::size_t>(lit.variable());
      if (values_.size() <= index) values_.resize(index + 1, sat::Truth::unassigned);
      values_[index] = lit.positive() ? sat::Truth::is_true : sat::Truth::is_false;
    }
  }
  [[nodiscard]] bool is_assigned(sat::Lit lit) const {
    const auto index = static_cast<std::size_t>(lit.variable());
    return index < values_.size() && values_[index] != sat::Truth::unassigned;
  }
  [[nodiscard]] bool is_false(sat::Lit lit) const {
    const auto index = static_cast<std::size_t>(lit.variable());
    return is_assigned(lit) && (values_[index] == sat::Truth::is_true) != lit.positive();
  }
  /// What the agent may cost at most, and what it is said to cost at least.
  [[nodiscard]] Cost cap(AgentId i) const {
    for (const auto& rung : model_.rungs(i))
      if (is_false(rung.at_least)) return rung.cost - 1;
    return kAnyCost;
  }
  [[nodiscard]] Cost floor(AgentId i) const {
    Cost floor = 0;
    for (const auto& rung : model_.rungs(i))
      if (is_false(~rung.at_least)) floor = rung.cost;
    return floor;
  }
  /// Whether the literal is false, or the order of the cost literals makes it so.
  [[nodiscard]] bool is_refuted(sat::Lit lit) const {
    const auto meaning = model_.variable(lit);
    if (meaning.kind == Model::VariableKind::cost &&
        (lit.positive() ? meaning.cost > cap(meaning.agent) : meaning.cost <= floor(meaning.agent)))
      return true;
    return is_false(lit);
  }
  [[nodiscard]] bool is_refuted(const std::vector<sat::Lit>& clause) const {
    return std::all_of(clause.begin(), clause.end(), [&](sat::Lit lit) { return is_refuted(lit); });
  }
  /// Of all obstacles that are active, and those that hold always.
  [[nodiscard]] std::vector<Ban> bans(AgentId i) const {
    std::vector<Ban> bans = model_.standing_bans(i);
    for (const Obstacle& o : model_.obstacles())
      if (o.agent == i && is_false(o.allowed))
        bans.insert(bans.end(), o.bans.begin(), o.bans.end());
    return bans;
  }
  [[nodiscard]] bool has_path(AgentId i) const {
    const auto arrival = least_arrival(model_.instance(), i, bans(i));
    return arrival && as_cost(*arrival) <= cap(i);
  }
  [[nodiscard]] bool all_have_paths() const {
    for (const AgentId i : model_.instance().agent_ids())
      if (!has_path(i)) return false;
    return true;
  }
  /// Why the path is none that the assignment allows; empty if it is.
  [[nodiscard]] std::string find_fault(AgentId i, const TimedPath& path) const {
    const Instance& instance = model_.instance();
    VertexId at = instance.agent(i).start;
    Ticks since = 0;
    const std::vector<Ban> all = bans(i);
    const auto may_stay = [&](Ticks until) {
      return std::none_of(all.begin(), all.end(), [&](const Ban& ban) {
        return ban.kind == Ban::Kind::stay && ban.place == at.value() && since < ban.when.end &&
               until > ban.when.begin;
      });
    };
    for (const Move& move : path.moves) {
      if (instance.roadmap().edge(move.edge).from != at || move.start < since) return "jumps";
      if (move.start < instance.agent(i).release) return "sets out before its release";
      if (!may_stay(move.start)) return "stays where it must not";
      if (std::any_of(all.begin(), all.end(), [&](const Ban& ban) {
            return ban.kind == Ban::Kind::start && ban.place == move.edge.value() &&
                   ban.when.begin <= move.start && move.start < ban.when.end;
          }))
        return "sets out when it must not";
      at = instance.roadmap().edge(move.edge).to;
      since = move.start + instance.duration(instance.class_of(i), move.edge);
    }
    if (at != instance.agent(i).goal() || since != path.arrival) return "does not end at the goal";
    if (!may_stay(instance.agent(i).leaves ? since : kForever)) return "rests where it must not";
    if (path.arrival > instance.agent(i).deadline.value_or(kForever)) return "is late";
    return as_cost(path.arrival) > cap(i) ? "costs more than the cap" : "";
  }

 private:
  const Model& model_;
  std::vector<sat::Truth> values_;  // by variable
};

struct Count {
  std::size_t silent = 0, conflicts = 0, accepted = 0, rejected = 0, told = 0, dead = 0,
              audited = 0;
};

/// The theory between the host and a judge.
class JudgedTheory final : public sat::Theory {
 public:
  JudgedTheory(Model& model, Count& count) : model_(model), theory_(model), count_(count) {}

  void ask(const ContinuousTheory::Question& question) {
    question_ = question;
    theory_.ask(question);
  }
  void on_assign(std::span<const sat::Lit> newly_true) override {
    ASSERT_FALSE(newly_true.empty());
    stack_.insert(stack_.end(), newly_true.begin(), newly_true.end());
    theory_.on_assign(newly_true);
  }
  void on_retract(std::size_t kept) override {
    stack_.resize(kept);
    theory_.on_retract(kept);
  }
  /// The end of a solver.
  void forget() {
    if (!stack_.empty()) on_retract(0);
  }
  sat::Lemma explain(sat::Lit implied, std::vector<sat::Lit>& clause) override {
    ADD_FAILURE() << "asked for the reason of something that was never propagated";
    return theory_.explain(implied, clause);
  }
  void check(sat::Extent extent, sat::TheoryContext& context) override {
    support::RecordingContext said(context);
    const std::vector<TimedPath> before = paths();
    const std::vector<sat::Lit> open = open_bounds();
    theory_.ask(question_);  // forgets what was accepted
    theory_.check(extent, said);
    const Situation now(model_, stack_);
    if (extent == sat::Extent::full) {
      judge_full(said, now);
    } else if (question_.mode == ContinuousTheory::Question::Mode::complete) {
      EXPECT_TRUE(said.lemmas.empty() && !said.made_literal);
    } else {
      judge_partial(said, now);
      for (const AgentId i : model_.instance().agent_ids())
        if (theory_.path(i) != before[i.index()]) expect_bounds_told(i, open, said, now);
    }
  }

 private:
  [[nodiscard]] std::vector<TimedPath> paths() const {
    std::vector<TimedPath> paths;
    for (const AgentId i : model_.instance().agent_ids()) paths.push_back(theory_.path(i));
    return paths;
  }
  /// That lemmas speak of, and that have no value yet.
  [[nodiscard]] std::vector<sat::Lit> open_bounds() const {
    const Situation now(model_, stack_);
    std::vector<sat::Lit> open;
    for (const AgentId i : model_.instance().agent_ids())
      for (const auto& rung : model_.rungs(i))
        if (rung.is_natural && !now.is_assigned(rung.at_least)) open.push_back(rung.at_least);
    return open;
  }
  [[nodiscard]] static bool has_conflict(const support::RecordingContext& said,
                                         const Situation& now) {
    return std::any_of(said.lemmas.begin(), said.lemmas.end(),
                       [&](const auto& clause) { return now.is_refuted(clause); });
  }

  void judge_partial(const support::RecordingContext& said, const Situation& now) {
    const bool is_feasible = now.all_have_paths();
    const bool is_conflict = has_conflict(said, now);
    ++(is_feasible ? count_.silent : count_.conflicts);
    if (!is_feasible) {
      EXPECT_TRUE(is_conflict) << "an agent without a path went unnoticed";
    } else if (!is_conflict) {
      expect_good_paths(now);
    }
  }
  /// A new path that costs more than a bound that lemmas speak of comes with a lemma that refutes
  /// the bound: the search that found the path has proved it.
  void expect_bounds_told(AgentId i, const std::vector<sat::Lit>& open,
                          const support::RecordingContext& said, const Situation& now) {
    sat::Lit largest;  // the others follow from it
    for (const sat::Lit lit : open)
      if (const auto meaning = model_.variable(lit);
          meaning.agent == i && meaning.cost <= as_cost(theory_.path(i).arrival))
        largest = lit;
    if (!largest.valid()) return;
    ++count_.told;
    EXPECT_TRUE(std::any_of(said.lemmas.begin(), said.lemmas.end(),
                            [&](const auto& clause) {
                              return std::find(clause.begin(), clause.end(), largest) !=
                                         clause.end() &&
                                     std::all_of(clause.begin(), clause.end(), [&](sat::Lit lit) {
                                       return lit == largest || now.is_refuted(lit);
                                     });
                            }))
        << "agent " << i.value();
  }
  void judge_full(const support::RecordingContext& said, const Situation& now) {
    if (said.made_literal || !said.lemmas.empty()) {
      EXPECT_FALSE(theory_.accepted());
      ++count_.rejected;
      return;
    }
    ++count_.accepted;
    EXPECT_TRUE(now.all_have_paths());
    expect_good_paths(now);
    ASSERT_TRUE(theory_.accepted());
    EXPECT_TRUE(verify(model_.instance(), *theory_.accepted()).valid());
    for (const AgentId i : model_.instance().agent_ids())
      EXPECT_EQ(cost(theory_.accepted()->paths[i]), as_cost(theory_.path(i).arrival));
  }
  void expect_good_paths(const Situation& now) const {
    for (const AgentId i : model_.instance().agent_ids())
      EXPECT_EQ(now.find_fault(i, theory_.path(i)), "") << "the path of agent " << i.value();
  }

  Model& model_;
  ContinuousTheory theory_;
  Count& count_;
  ContinuousTheory::Question question_;
  std::vector<sat::Lit> stack_;
};

}  // namespace quadrille::continuous::test
