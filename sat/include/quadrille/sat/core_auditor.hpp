// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/sat/engine.hpp"
#include "quadrille/sat/lemma.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::sat {

/// Proves the core of each refutation again, and each core clause that an engine is given, from the
/// clauses that the engine was given before, in a solver of its own that has no theory and no
/// assumptions but what is said here. It keeps all of those clauses: for debugging, on small
/// instances.
class CoreAuditor final : public ClauseObserver {
 public:
  static constexpr int kMaxConflicts = 10'000;
  /// A proof that takes more conflicts is given up: the core stays unaudited.
  explicit CoreAuditor(int max_conflicts = kMaxConflicts);

  void on_lemma(const Lemma& lemma) override;
  void on_learned(std::span<const Lit> /*clause*/) override {}
  /// With nothing assumed: a core names all that it rests on.
  void on_core(std::span<const Lit> clause) override { prove(clause, {}); }

  /// From now on, core clauses have to hold only where all of these do.
  void assume(std::vector<Lit> given) { given_ = std::move(given); }
  /// Some literal of `core` follows from the clauses so far and from what is assumed: proves it
  /// again. An empty core says that these contradict each other.
  void audit(std::span<const Lit> core) { prove(core, given_); }

  /// The first core that does not follow.
  [[nodiscard]] const std::optional<std::string>& complaint() const noexcept { return complaint_; }
  [[nodiscard]] std::int64_t num_proved() const noexcept { return num_proved_; }
  /// Those whose proof was given up.
  [[nodiscard]] std::int64_t num_open() const noexcept { return num_open_; }

 private:
  void make_variables(std::span<const Lit> lits);
  void prove(std::span<const Lit> core, std::vector<Lit> given);

  const int max_conflicts_;
  LimitMonitor limits_;
  Engine solver_;
  std::vector<Lit> given_;
  std::optional<std::string> complaint_;
  std::int64_t num_proved_ = 0, num_open_ = 0;
};

}  // namespace quadrille::sat

QUADRILLE_API_END
