// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <random>
#include <set>
#include <vector>

#include "engine/theory_host.hpp"

namespace quadrille::support {

/// Plays a CDCL solver with chronological backtracking against a TheoryHost: every callback
/// sequence that the external-propagator protocol allows, chosen at random. Decides nothing by
/// reasoning of its own, but never keeps a clause false that it was given: it backtracks first, as
/// a solver does.
class MockSolver {
 public:
  MockSolver(sat::TheoryHost& host, int num_variables, std::uint64_t seed)
      : host_(host), num_variables_(num_variables), random_(seed) {}

  [[nodiscard]] std::uint64_t draw(std::uint64_t bound) { return random_() % bound; }

  // ---- what happened
  // ------------------------------------------------------------------------------
  /// Literals that are true and announced.
  [[nodiscard]] std::set<sat::Lit> announced() const {
    std::set<sat::Lit> lits;
    for (const Assigned& a : trail_)
      if (a.announced) lits.insert(a.lit);
    return lits;
  }
  [[nodiscard]] const std::vector<std::vector<sat::Lit>>& clauses() const { return clauses_; }
  /// Reasons that were asked for, with what they explain.
  [[nodiscard]] const std::vector<std::pair<sat::Lit, std::vector<sat::Lit>>>& reasons() const {
    return reasons_;
  }
  /// True if a reason that was asked for at once had a literal that was not false.
  [[nodiscard]] bool has_bad_reason() const { return has_bad_reason_; }
  [[nodiscard]] bool is_true(sat::Lit lit) const { return value(lit) == 1; }
  [[nodiscard]] std::size_t num_assigned() const { return trail_.size(); }

  // ---- moves of the solver
  // ------------------------------------------------------------------------
  void open_level() {
    host_.notify_new_decision_level();
    ++level_;
    level_begin_.push_back(announcements_);
  }

  /// Assigns without announcing; at a level of the past now and then (chronological backtracking).
  void assign(sat::Lit lit) {
    if (value(lit) != 0) return;
    const std::size_t level = draw(4) == 0 ? draw(level_ + 1) : level_;
    trail_.push_back({lit, level, false, 0});
    set_value(lit, 1);
  }

  /// A clause that came from elsewhere than the host, such as an earlier solve.
  void add_clause(std::vector<sat::Lit> clause) { clauses_.push_back(std::move(clause)); }

  /// Announces what is not announced yet, in batches, some of them empty, with repetitions of
  /// literals at level 0.
  void announce() {
    std::vector<int> batch;
    const auto flush = [&] {
      host_.notify_assignment(batch);
      batch.clear();
    };
    if (draw(4) == 0) flush();
    for (Assigned& a : trail_) {
      if (a.level == 0 && a.announced && draw(3) == 0) batch.push_back(a.lit.dimacs());
      if (a.announced) continue;
      a.announced = true;
      a.order = announcements_++;
      batch.push_back(a.lit.dimacs());
      if (draw(3) == 0) flush();
    }
    flush();
  }

  void backtrack(std::size_t level) {
    host_.notify_backtrack(level);
    if (level >= level_) return;
    const std::size_t kept = level_begin_[level];
    level_begin_.resize(level);
    level_ = level;
    announcements_ = kept;
    std::vector<Assigned> survivors, others;
    for (Assigned a : trail_) {
      if (a.level > level) {
        set_value(a.lit, 0);
        continue;
      }
      if (a.announced && a.order >= kept) {  // the host has forgotten it
        a.announced = false;
        survivors.push_back(a);
      } else {
        others.push_back(a);
      }
    }
    for (std::size_t i = survivors.size(); i > 1; --i)
      std::swap(survivors[i - 1], survivors[draw(i)]);
    trail_ = others;
    trail_.insert(trail_.end(), survivors.begin(), survivors.end());
  }

  /// A backtrack that nothing was announced for.
  void backtrack_unannounced_levels() { host_.notify_backtrack(level_ + draw(3)); }

  /// Asks for propagations and clauses until there are none, as at the end of unit propagation.
  /// Reasons are asked for at once, later or never. False if a clause made it backtrack.
  bool propagate() {
    announce();
    while (const int literal = host_.propagate()) {
      const sat::Lit lit = sat::Lit::from_dimacs(literal);
      if (value(lit) == 0) {
        trail_.push_back({lit, level_, false, 0});
        set_value(lit, 1);
        propagated_.push_back(lit);
        if (draw(3) != 0) {
          ask_reason(lit);
          for (const sat::Lit other : reasons_.back().second)
            if (other != lit && value(other) != -1) has_bad_reason_ = true;
        }
        announce();
      } else {
        ask_reason(lit);
      }
    }
    fetch_clauses();
    return !resolve_conflicts();
  }

  void ask_late_reason() {
    if (!propagated_.empty()) ask_reason(propagated_[draw(propagated_.size())]);
  }

  /// Fetches the queued clauses, now and then not all of them.
  void fetch_clauses() {
    bool forgettable = false;
    while (host_.has_clause(forgettable)) {
      std::vector<sat::Lit> clause;
      while (const int literal = host_.next_clause_literal())
        clause.push_back(sat::Lit::from_dimacs(literal));
      clauses_.push_back(std::move(clause));
      if (draw(16) == 0) return;
    }
  }

  /// Backtracks until no clause is false. True if that took a step.
  bool resolve_conflicts() {
    bool any = false;
    for (const auto& clause : clauses_) {
      while (std::all_of(clause.begin(), clause.end(),
                         [&](sat::Lit lit) { return value(lit) == -1; })) {
        any = true;
        std::size_t highest = 0;
        for (const sat::Lit lit : clause) highest = std::max(highest, level_of(~lit));
        if (highest == 0) {
          dead_ = true;  // refuted at the root: a solver would stop here
          return true;
        }
        backtrack(highest - 1 - draw(highest));
      }
    }
    return any;
  }
  [[nodiscard]] bool dead() const { return dead_; }

  /// Asks for a decision and takes it at a level of its own. No literal if there is none.
  sat::Lit decide() {
    const int literal = host_.decide();
    if (literal == 0) return {};
    const sat::Lit lit = sat::Lit::from_dimacs(literal);
    open_level();
    assign(lit);
    return lit;
  }

  /// Gives every variable below `end` a value such that no clause is false. False if it ran into a
  /// conflict; then it has backtracked. Variables are false by default, as in the solver.
  bool complete(int end) {
    std::vector<std::vector<std::size_t>> occurrences(2 * static_cast<std::size_t>(end));
    const auto index = [](sat::Lit lit) {
      return 2 * static_cast<std::size_t>(lit.variable()) + (lit.positive() ? 0 : 1);
    };
    for (std::size_t c = 0; c < clauses_.size(); ++c) {
      for (const sat::Lit lit : clauses_[c]) occurrences[index(lit)].push_back(c);
      assign_if_unit(clauses_[c]);
    }
    std::size_t head = 0;
    int next = 1;
    while (true) {
      for (; head < trail_.size(); ++head)
        for (const std::size_t c : occurrences[index(~trail_[head].lit)])
          assign_if_unit(clauses_[c]);
      while (next < end && value(sat::Lit::from_dimacs(next)) != 0) ++next;
      if (next == end) return !resolve_conflicts();
      if (draw(3) == 0) open_level();
      assign(sat::Lit::from_dimacs(draw(8) == 0 ? next : -next));
    }
  }

  [[nodiscard]] bool check_found_model() {
    announce();
    return host_.check_found_model();
  }
  [[nodiscard]] std::size_t level() const { return level_; }
  [[nodiscard]] int num_variables() const { return num_variables_; }

 private:
  struct Assigned {
    sat::Lit lit;
    std::size_t level;
    bool announced;
    std::size_t order;  // of the announcement
  };

  /// 1 true, -1 false, 0 unassigned.
  [[nodiscard]] int value(sat::Lit lit) const {
    const auto index = static_cast<std::size_t>(lit.variable());
    if (index >= values_.size()) return 0;
    return lit.positive() ? values_[index] : -values_[index];
  }
  void set_value(sat::Lit lit, int value) {
    const auto index = static_cast<std::size_t>(lit.variable());
    if (index >= values_.size()) values_.resize(index + 1, 0);
    values_[index] = static_cast<std::int8_t>(lit.positive() ? value : -value);
  }
  void assign_if_unit(const std::vector<sat::Lit>& clause) {
    sat::Lit open;
    for (const sat::Lit lit : clause) {
      if (value(lit) == 1 || (value(lit) == 0 && open.valid())) return;
      if (value(lit) == 0) open = lit;
    }
    if (open.valid()) assign(open);
  }
  [[nodiscard]] std::size_t level_of(sat::Lit lit) const {
    for (const Assigned& a : trail_)
      if (a.lit == lit) return a.level;
    return 0;
  }
  void ask_reason(sat::Lit lit) {
    std::vector<sat::Lit> reason;
    while (const int literal = host_.next_reason_literal(lit.dimacs()))
      reason.push_back(sat::Lit::from_dimacs(literal));
    reasons_.emplace_back(lit, std::move(reason));
  }

  sat::TheoryHost& host_;
  int num_variables_;
  std::mt19937_64 random_;
  std::vector<Assigned> trail_;
  std::vector<std::int8_t> values_;       // by variable: 1 true, -1 false, 0 unassigned
  std::vector<std::size_t> level_begin_;  // announcements_ when the level was opened
  std::size_t level_ = 0, announcements_ = 0;
  std::vector<std::vector<sat::Lit>> clauses_;
  std::vector<sat::Lit> propagated_;
  std::vector<std::pair<sat::Lit, std::vector<sat::Lit>>> reasons_;
  bool dead_ = false, has_bad_reason_ = false;
};

}  // namespace quadrille::support
