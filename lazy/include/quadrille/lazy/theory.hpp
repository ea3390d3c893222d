// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "quadrille/core/contract.hpp"
#include "quadrille/core/effort.hpp"
#include "quadrille/core/internal_error.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/lazy/path_cache.hpp"
#include "quadrille/lazy/trail.hpp"
#include "quadrille/lazy/vocabulary.hpp"
#include "quadrille/lazy/writer.hpp"
#include "quadrille/sat/theory.hpp"

namespace quadrille::lazy {

/// "The agent costs `bound` or more, or one of the blamed obstacles is allowed", as the search for
/// a path has shown. The clause says just that; without a bound (kNoCap) only the latter.
struct Explanation {
  AgentId agent;
  Cost bound = kNoCap;
  std::span<const ObstacleId> blamed;
  std::span<const sat::Lit> clause;
};

/// What a domain tells the theory of its paths, its obstacles and their geometry.
///
/// - `Paths`: the current paths, one per agent, each a cheapest one when the domain was made.
/// - `find_cheapest(agent, obstacles, cap)`: what a search for a cheapest path around the obstacles
///   has found, with `path()`, null if there is none within the cap; `blame(found, bound)` then
///   names obstacles without which no path costs less than `bound`. To be asked before the next
///   search.
/// - `conflicts(trail)`: where the current paths of the agents that count meet. `exclude(conflict,
///   trail, writer)` writes a clause about obstacles that the current paths break, unless it was
///   written before, and returns these obstacles; or it writes a clause about costs and returns
///   none. What was written and is no clause that is false forbids somebody his path: so nobody
///   finds the conflict again. InternalError where that is not so.
/// - `before_conflicts(trail)`: once in each complete assignment, to part paths without clauses.
///   `on_explained`, `on_obstacles`: a lemma about a path, or new obstacles, were written.
template <class D>
concept Domain = TrailPaths<typename D::Paths> &&
    requires(D& domain, const D& known, AgentId i, Cost cost, const typename D::Paths::Path& path,
             const typename D::Conflict& conflict, ObstacleTrail<typename D::Paths>& trail,
             const std::vector<ObstacleId>& obstacles, FormulaWriter& writer,
             const Explanation& explanation, std::int64_t num_assigned) {
  typename D::Plan;
  { domain.paths() } -> std::same_as<typename D::Paths&>;
  { domain.vocabulary() } -> std::convertible_to<Vocabulary&>;
  domain.obstacles();
  domain.find_cheapest(i, obstacles, cost);
  domain.conflicts(trail);
  { domain.exclude(conflict, trail, writer) } -> std::same_as<std::vector<ObstacleId>>;
  domain.before_conflicts(trail);
  domain.on_explained(explanation, trail, writer);
  domain.on_obstacles(writer);
  { known.plan() } -> std::same_as<typename D::Plan>;
  { D::hint(path) } -> std::same_as<std::optional<ObstacleId>*>;
  { known.effort(num_assigned) } -> std::same_as<Effort>;
  { D::kAbsentWithoutCap } -> std::convertible_to<bool>;
  { D::kSearchesToCap } -> std::convertible_to<bool>;
};

/// Keeps one current path per agent inside the SAT search: the theory of all lazy path models.
///
/// A trail knows each agent's active obstacles and the cap on its cost, as the assignment says. A
/// path that an obstacle hits or that costs more than the cap is replaced by a remembered or by a
/// cheapest one; if there is none within the cap, a path lemma says why. Where agents without a cap
/// are absent, their paths are left alone and their conflicts do not count. On complete assignments
/// all conflicts become clauses at once.
template <Domain D>
class PathTheory : public sat::Theory {
 public:
  using Path = typename D::Paths::Path;

  /// Times that the paths of a complete assignment were checked for conflicts.
  [[nodiscard]] std::int64_t num_checks() const noexcept { return num_checks_; }
  /// The paths of the last complete assignment that was accepted; absent if an agent was.
  [[nodiscard]] const std::optional<typename D::Plan>& accepted() const noexcept {
    return accepted_;
  }
  [[nodiscard]] Effort effort() const noexcept final { return domain_.effort(num_assigned_); }

  void on_assign(std::span<const sat::Lit> newly_true) override;
  void on_retract(std::size_t kept) override { trail_.retract(kept); }
  void check(sat::Extent extent, sat::TheoryContext& context) override {
    ContextWriter target(context);
    CheckWriter writer(target, &context);
    trail_.notice(domain_.obstacles());
    if (extent == sat::Extent::partial)
      static_cast<void>(replan_all(writer));
    else
      check_paths(writer);
  }
  sat::Lemma explain(sat::Lit /*implied*/, std::vector<sat::Lit>& /*clause*/) final {
    QUADRILLE_REQUIRE(false, "this theory propagates by clauses only");
    return {};
  }

 protected:
  /// The limits outlive the theory. When one is met the theory ends the solve that it takes part
  /// in.
  template <class... Arguments>
  explicit PathTheory(LimitMonitor& limits, Arguments&&... domain)
      : limits_(limits),
        domain_(std::forward<Arguments>(domain)...),
        trail_(domain_.paths(), domain_.num_agents(), kNoCap),
        cache_(domain_.num_agents(), kRememberedPaths) {
    for (const AgentId i : IdRange<AgentId>(domain_.num_agents()))
      remember(i, domain_.paths().path(i));
  }

  /// Whether the agent's path has to obey, and its conflicts count.
  [[nodiscard]] bool takes_part(AgentId i) const {
    return !D::kAbsentWithoutCap || trail_.cap(i) < kNoCap;
  }
  /// Makes paths obey and their conflicts clauses, until there is none or something was written
  /// that excludes the assignment.
  void check_paths(CheckWriter& writer);
  /// Makes clauses of a conflict, as the domain says, and holds it to its word.
  std::vector<ObstacleId> exclude(const typename D::Conflict& conflict, FormulaWriter& writer) {
    auto made = domain_.exclude(conflict, trail_, writer);
    for (const ObstacleId id : made)
      if (!domain_.paths().breaks(domain_.paths().path(domain_.obstacles()[id].agent), id))
        throw InternalError{"a collision clause does not exclude the paths that collide"};
    return made;
  }
  void notice_obstacles(FormulaWriter& writer) {
    trail_.notice(domain_.obstacles());
    domain_.on_obstacles(writer);
  }

  LimitMonitor& limits_;
  D domain_;
  ObstacleTrail<typename D::Paths> trail_;
  std::optional<typename D::Plan> accepted_;

 private:
  /// Of each agent. Measured: nine in ten violated paths are replaced by a remembered one; without
  /// any the ladders' last rungs take 1.7 times as long (geometric mean). 8 to 32 make no
  /// difference on most instances, fewer cost time on hard ones.
  static constexpr std::size_t kRememberedPaths = 16;

  /// Replaces violated paths of agents that take part. False if a lemma says that one has none, or
  /// if a limit was met.
  bool replan_all(CheckWriter& writer);
  bool replan(AgentId i, FormulaWriter& writer);
  [[nodiscard]] bool obeys(AgentId i, const Path& path) const;
  /// The cheapest remembered path that a search could have found as well: within the cap, around
  /// the active obstacles, and so cheap that it leaves no bound to refute. Null if there is none.
  [[nodiscard]] const Path* recall(AgentId i) const;
  template <class Found>
  const Path& remember(AgentId i, const Found& found) {
    return cache_.remember(
        i, [&](const Path& known) { return domain_.is_same(known, found); },
        [&] { return domain_.make_path(i, found); });
  }
  template <class Cheapest>
  void explain_bound(AgentId i, const Cheapest& found, Cost bound, FormulaWriter& writer);
  void accept();

  PathCache<Path> cache_;
  std::int64_t num_checks_ = 0;
  std::int64_t num_assigned_ = 0;  // literals
};

// ---- the assignment -----------------------------------------------------------------------------

template <Domain D>
void PathTheory<D>::on_assign(std::span<const sat::Lit> newly_true) {
  trail_.notice(domain_.obstacles());
  num_assigned_ += static_cast<std::int64_t>(newly_true.size());
  const Vocabulary& vocabulary = domain_.vocabulary();
  for (const sat::Lit lit : newly_true) {
    trail_.push(lit);
    const auto meaning = vocabulary.variable(lit);
    if (meaning.kind != Vocabulary::VariableKind::cost) continue;
    if (!vocabulary.is_at_least(lit))
      trail_.lower_cap(meaning.agent, meaning.cost - 1);
    else
      trail_.raise_floor(meaning.agent, meaning.cost);
  }
}

// ---- paths --------------------------------------------------------------------------------------

template <Domain D>
bool PathTheory<D>::obeys(AgentId i, const Path& path) const {
  std::optional<ObstacleId>* const hint = D::hint(path);
  if (hint != nullptr && *hint && trail_.is_active(**hint)) return false;
  const auto broken = trail_.find_broken(i, path);
  if (hint != nullptr && broken) *hint = broken;
  return !broken;
}

template <Domain D>
bool PathTheory<D>::replan_all(CheckWriter& writer) {
  bool good = true;
  trail_.mend_violated([&](AgentId i) {
    if (!takes_part(i)) return true;
    if (limits_.exhausted()) {
      writer.stop();
      return good = false;
    }
    good = replan(i, writer) && good;
    return true;
  });
  return good;
}

template <Domain D>
bool PathTheory<D>::replan(AgentId i, FormulaWriter& writer) {
  auto& paths = domain_.paths();
  const auto& rungs = domain_.vocabulary().rungs(i);
  const Cost cap = trail_.cap(i);
  // What was in its way may be gone.
  if (paths.cost(paths.path(i)) <= cap && obeys(i, paths.path(i))) {
    trail_.keep_path(i);
    return true;
  }
  if (const Path* known = recall(i)) {
    trail_.replace_path(i, *known);
    return true;
  }
  const auto found = domain_.find_cheapest(i, trail_.active(i), D::kSearchesToCap ? cap : kNoCap);
  // What it costs at least.
  const Cost least = found.path() != nullptr ? domain_.cost(*found.path())
                     : D::kSearchesToCap     ? cap + 1
                                             : kNoCap;
  if (found.path() == nullptr || least > cap) {
    const auto at = std::find_if(rungs.begin(), rungs.end(), [&](const Vocabulary::Rung& rung) {
      return rung.is_natural && rung.cost > cap;
    });
    explain_bound(i, found, at != rungs.end() ? std::min(at->cost, least) : least, writer);
    return false;
  }
  Cost refuted = 0;  // the largest open natural rung that this search refutes
  for (const Vocabulary::Rung& rung : rungs) {
    if (rung.cost > least) break;
    if (rung.is_natural && trail_.value(rung.at_least) == sat::Truth::unassigned)
      refuted = rung.cost;
  }
  if (refuted > 0) explain_bound(i, found, refuted, writer);
  trail_.replace_path(i, remember(i, *found.path()));
  return true;
}

template <Domain D>
auto PathTheory<D>::recall(AgentId i) const -> const Path* {
  Cost most = trail_.cap(i);  // a costlier path needs the search's proof that it must be
  for (const Vocabulary::Rung& rung : domain_.vocabulary().rungs(i)) {
    if (rung.cost > most) break;
    if (rung.is_natural && trail_.value(rung.at_least) == sat::Truth::unassigned)
      most = rung.cost - 1;
  }
  const Path* best = nullptr;
  Cost least = 0;
  for (const Path& known : cache_.paths(i)) {
    const Cost cost = domain_.paths().cost(known);
    if (cost > most || (best != nullptr && cost >= least) || !obeys(i, known)) continue;
    best = &known;
    least = cost;
  }
  return best;
}

template <Domain D>
template <class Cheapest>
void PathTheory<D>::explain_bound(AgentId i, const Cheapest& found, Cost bound,
                                  FormulaWriter& writer) {
  const std::vector<ObstacleId> blamed = domain_.blame(found, bound);
  std::vector<sat::Lit> clause;
  std::vector<sat::Usage> usages;
  if (bound < kNoCap) clause.push_back(domain_.vocabulary().at_least(i, bound, writer));
  for (const ObstacleId id : blamed) {
    usages.push_back({i, id.value()});
    const sat::Lit allowed = domain_.obstacles()[id].allowed;
    if (std::find(clause.begin(), clause.end(), allowed) == clause.end()) clause.push_back(allowed);
  }
  writer.add({sat::why::Path{i}, clause, usages, false});
  domain_.on_explained({i, bound, blamed, clause}, trail_, writer);
}

// ---- checks -------------------------------------------------------------------------------------

// Obstacles whose literal is false already take effect without a clause: then paths change, and
// this has to look again, because a formula that is still satisfied would count as consent.
template <Domain D>
void PathTheory<D>::check_paths(CheckWriter& writer) {
  for (bool is_first = true;; is_first = false) {
    if (!replan_all(writer) || writer.has_excluded()) return;
    ++num_checks_;
    if (limits_.exhausted_now()) return writer.stop();
    if (is_first) domain_.before_conflicts(trail_);
    const auto conflicts = domain_.conflicts(trail_);
    if (conflicts.empty()) return accept();
    for (const auto& conflict : conflicts) {
      // One may take several searches of the whole map.
      if (limits_.exhausted()) return writer.stop();
      exclude(conflict, writer);
    }
    notice_obstacles(writer);
    if (writer.has_excluded()) return;
    if (!trail_.any_violated([&](AgentId i) { return takes_part(i); }))
      throw InternalError{"clauses that were written before do not exclude a collision"};
  }
}

template <Domain D>
void PathTheory<D>::accept() {
  accepted_.reset();
  for (const AgentId i : IdRange<AgentId>(domain_.num_agents()))
    if (!takes_part(i)) return;
  accepted_ = domain_.plan();
}

}  // namespace quadrille::lazy
