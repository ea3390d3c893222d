// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "quadrille/core/export.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/sat/lit.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::sat {

/// That an agent uses a resource. What a resource number means is the domain's business: a vertex
/// at a timestep, a timed move, the right to leave a goal late.
struct Usage {
  AgentId agent;
  std::uint64_t resource = 0;
  friend auto operator<=>(const Usage&, const Usage&) = default;
};

/// Why a clause holds. Together with the usages this is enough to derive the clause again.
enum class LemmaKind : std::uint8_t {
  path,       ///< Every path of the one agent in `usages` satisfies it, whatever the others do.
  collision,  ///< Two usages of different agents that may not both happen.
  order,      ///< "cost >= k+1" implies "cost >= k".
  counting,   ///< Defines a counter over other literals (see Totalizer).
  core,       ///< Follows from all clauses so far: a core of assumptions, negated.
};
[[nodiscard]] std::string_view to_string(LemmaKind kind) noexcept;

/// A clause and its justification, as handed to the engine. A view: it owns nothing.
struct Lemma {
  LemmaKind kind = LemmaKind::path;
  std::span<const Lit> clause;
  std::span<const Usage> usages;
  /// The solver may drop it again; only for clauses that the theory finds again when needed.
  bool forgettable = false;
};

/// Hears every clause that the engine is given, every clause that the solver derives from them, and
/// every core. For debugging and for proofs. Called on the solving thread; must not call the
/// engine.
class ClauseObserver {
 public:
  virtual ~ClauseObserver() = default;
  virtual void on_lemma(const Lemma& lemma) = 0;
  /// A consequence of all clauses so far; never depends on assumptions.
  virtual void on_learned(std::span<const Lit> clause) = 0;
  /// Asked once, before the first clause. False: `on_learned` is never called, which saves the
  /// solver the work of telling.
  [[nodiscard]] virtual bool wants_learned() const { return true; }
  /// For each verdict `unsat`: the negations of Engine::core, of which one has to be true. A
  /// consequence of all clauses so far, which a search may conclude a bound from without ever
  /// adding it as a clause. Empty if the clauses contradict each other.
  virtual void on_core(std::span<const Lit> /*clause*/) {}
};

}  // namespace quadrille::sat

QUADRILLE_API_END
