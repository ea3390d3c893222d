// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "theory/domain.hpp"

namespace quadrille::continuous {

/// The theory of MAPF_R.
class ContinuousTheory final : public lazy::PathTheory<ContinuousDomain> {
 public:
  /// `model` outlives the theory.
  explicit ContinuousTheory(Model& model) : PathTheory(model.limits(), model) {}

  /// The current path of an agent. After a check that added no lemma, it keeps the cap and obeys
  /// the bans of all active obstacles.
  [[nodiscard]] const TimedPath& path(AgentId agent) const {
    return domain_.paths().path(agent)->path;
  }

  /// What a solve asks of the theory, all of it.
  struct Question {
    /// Looks at all assignments, at complete ones only, or not even at those, which leaves plain
    /// SAT solving.
    enum class Mode { always, complete, never };
    Mode mode = Mode::always;
    /// Which agents that collide again and again are searched together.
    PairLemmas::Scope pairs = PairLemmas::Scope::all;
  };
  /// Between solves: the question of the next one. Forgets the accepted paths.
  void ask(const Question& question) {
    question_ = question;
    domain_.pair_lemmas().set_scope(question.pairs);
    accepted_.reset();
  }

  /// Looks at an assignment that was found without this theory. True: it is accepted. False:
  /// clauses that exclude it were written. Throws LimitReached.
  [[nodiscard]] bool check_complete(std::span<const sat::Lit> assignment, FormulaWriter& target);

  void check(sat::Extent extent, sat::TheoryContext& context) override;

 private:
  Question question_;
};

}  // namespace quadrille::continuous
