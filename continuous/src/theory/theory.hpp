// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "quadrille/sat/theory.hpp"
#include "theory/current_paths.hpp"
#include "theory/encounters.hpp"
#include "theory/model.hpp"
#include "theory/pair_lemmas.hpp"
#include "theory/path_cache.hpp"
#include "theory/path_search.hpp"

namespace quadrille::continuous {

class CountingWriter;

/// Keeps one current path per agent: the theory of MAPF_R.
///
/// A trail knows each agent's active obstacles, the cap on its cost, and a cost from which on its
/// stay at the goal is final, as the assignment says. A path that an obstacle is in the way of, or
/// that costs more than the cap, is replaced by a known one or by a cheapest one; if there is none
/// within the cap, a path lemma says why. On complete assignments the collisions of all paths
/// become clauses.
class ContinuousTheory final : public sat::Theory {
 public:
  /// `model` outlives the theory.
  explicit ContinuousTheory(Model& model);

  /// The current path of an agent. After a check that added no lemma, it keeps the cap and obeys
  /// the bans of all active obstacles.
  [[nodiscard]] const TimedPath& path(AgentId agent) const { return paths_.path(agent)->path; }
  /// The paths of the last complete assignment that was accepted.
  [[nodiscard]] const std::optional<Plan>& accepted() const noexcept { return accepted_; }
  /// Times that the paths of a complete assignment were checked for collisions.
  [[nodiscard]] std::int64_t num_checks() const noexcept { return num_checks_; }

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
    pair_lemmas_.set_scope(question.pairs);
    accepted_.reset();
  }

  /// Looks at an assignment that was found without this theory. True: it is accepted. False:
  /// clauses that exclude it were written.
  [[nodiscard]] bool check_complete(std::span<const sat::Lit> assignment, FormulaWriter& writer);

  void on_assign(std::span<const sat::Lit> newly_true) override;
  void on_retract(std::size_t kept) override;
  void check(sat::Effort effort, sat::TheoryContext& context) override;
  /// In steps of some 50 ns on every map. The weights are a least-squares fit to 48 runs on six
  /// maps: edges and visits 50 ns, steps of pairs 27 ns, literals 150 ns.
  [[nodiscard]] std::int64_t effort() const noexcept override {
    return search_.effort() + finder_.effort() + pair_lemmas_.effort() / 2 + 3 * num_assigned_ +
           100 * num_comparisons_;
  }
  sat::Lemma explain(sat::Lit implied, std::vector<sat::Lit>& clause) override;

 private:
  using ObstacleIds = std::vector<ObstacleId>;

  /// Whether the path keeps clear of all active obstacles.
  [[nodiscard]] bool obeys(AgentId i, const KnownPathRef& known) const;

  /// Replaces violated paths. False if lemmas say that some agent has none.
  bool replan_all(FormulaWriter& writer);
  bool replan(AgentId i, FormulaWriter& writer);
  /// Searches around all active obstacles.
  [[nodiscard]] PathSearch::Cheapest search(AgentId i, Cost bound);
  /// Adds "i costs `bound` or more, or one of these usages is allowed", as the search has shown.
  void explain_bound(AgentId i, const PathSearch::Cheapest& search, Cost bound,
                     FormulaWriter& writer);
  /// Tries to find a stronger lemma of two agents for one that explains a bound by `blamed`.
  void blame_pairs(AgentId i, Cost bound, const ObstacleIds& blamed, FormulaWriter& writer);
  /// A known path that obeys all active bans and the cap, if no lemma about a cost would be found
  /// by looking for a cheapest one. Null: none.
  [[nodiscard]] KnownPathRef recall(AgentId i) const;
  [[nodiscard]] KnownPathRef remember(AgentId i, const TimedPath& path);
  /// What i costs at least: its path does, or literals say so.
  [[nodiscard]] Cost current_cost(AgentId i) const;
  void check_paths(CountingWriter& writer);
  /// True if a lemma of the two agents excludes the encounter.
  bool note_collision(const Encounter& encounter, FormulaWriter& writer);
  [[nodiscard]] std::vector<Encounter> encounters();

  Model& model_;
  CurrentPaths paths_;
  PathTrail trail_;
  PathSearch search_;
  PathFinder finder_;  // of clauses_, as the next one
  BanTable bans_;
  EncounterClauses clauses_;
  PairLemmas pair_lemmas_;
  Question question_;

  IdVector<AgentId, PathCache> caches_;
  std::uint64_t last_version_ = 0;
  /// By pair of agents: the versions of their paths when they were last found not to collide.
  std::vector<std::pair<std::uint64_t, std::uint64_t>> apart_;

  std::optional<Plan> accepted_;
  std::int64_t num_checks_ = 0;
  std::int64_t num_comparisons_ = 0;  // of two agents' paths
  std::int64_t num_assigned_ = 0;     // literals
};

}  // namespace quadrille::continuous
