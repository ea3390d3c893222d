// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <variant>

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

/// Why clauses hold. Each reason has what is needed beside the clause and its usages to derive the
/// clause again; the numbers are those of the claims in docs/soundness/.
namespace why {

/// Every path of the agent satisfies it, whatever the others do. 2.1, 6.2 and 11.
struct Path {
  AgentId agent;
};
/// The same, where the agent's paths are written out as variables. 6.7.
struct ExplicitPath {
  AgentId agent;
};
/// Two agents are in one vertex at one time. 3 and 6.3.
struct Vertex {};
/// Two agents pass each other on one edge. 3 and 6.3.
struct Edge {};
/// An agent is where another one rests for good. 3.
struct Goal {
  AgentId resident;
};
/// One agent crosses a rectangle of cells from side to side, another one from top to bottom, both
/// without a moment's delay. 6.4.
struct Rectangle {
  AgentId horizontal, vertical;
  /// Coordinates of the cells in which both would enter it first, and leave it last.
  std::int32_t from_x = 0, from_y = 0, to_x = 0, to_y = 0;
  std::int64_t begin = 0;  ///< The timestep at which an agent is in the first of these cells.
};
/// Two agents pass a chain of vertices with two neighbours in opposite directions. 6.5.
struct Corridor {
  VertexId inside;  ///< One of the chain.
};
/// Two moves in continuous time meet whenever they begin within given times. 11.
struct Moves {};
/// A move meets an agent that stands. 11.
struct Stay {};
/// No two paths of the agents together break no ban and are as cheap. 11.15.
struct Pair {
  AgentId first, second;
};
/// A cost implies those that are lower. 2.1 and 6.1.
struct Order {
  AgentId agent;
};
/// The agent costs less than this in every plan that is looked for. 6.1 and 11.13.
struct Ceiling {
  AgentId agent;
};
/// An agent that ends at a goal and costs less than some cost rests there and costs less. 6.8.
struct Rest {
  AgentId agent;
};
/// Nobody ends at a goal, or one of those does who can. 6.10.
struct Taken {
  VertexId goal;
};
/// Defines a counter over other literals (see Totalizer). 4.
struct Counter {};
/// Follows from all clauses so far: a core of assumptions, negated. 5.
struct Core {};

}  // namespace why

using Why = std::variant<why::Path, why::ExplicitPath, why::Vertex, why::Edge, why::Goal,
                         why::Rectangle, why::Corridor, why::Moves, why::Stay, why::Pair,
                         why::Order, why::Ceiling, why::Rest, why::Taken, why::Counter, why::Core>;

/// "path", "explicit path", "vertex", ...
[[nodiscard]] std::string_view to_string(const Why& why) noexcept;
/// Whether it is about what two agents may not do together.
[[nodiscard]] bool is_collision(const Why& why) noexcept;

/// A clause and its justification, as handed to the engine. A view: it owns nothing.
struct Lemma {
  Why why;
  std::span<const Lit> clause;
  std::span<const Usage> usages;
  /// The solver may drop it again; only for clauses that the theory finds again when needed.
  bool forgettable = false;

  template <class Reason>
  [[nodiscard]] bool is() const noexcept {
    return std::holds_alternative<Reason>(why);
  }
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

/// Hands all on to another observer, if there is one.
class PassingObserver : public ClauseObserver {
 public:
  /// `next` outlives this; may be null.
  explicit PassingObserver(ClauseObserver* next) : next_(next) {}
  void on_lemma(const Lemma& lemma) override {
    if (next_ != nullptr) next_->on_lemma(lemma);
  }
  void on_learned(std::span<const Lit> clause) override {
    if (next_ != nullptr) next_->on_learned(clause);
  }
  [[nodiscard]] bool wants_learned() const override {
    return next_ != nullptr && next_->wants_learned();
  }
  void on_core(std::span<const Lit> clause) override {
    if (next_ != nullptr) next_->on_core(clause);
  }

 private:
  ClauseObserver* const next_;
};

}  // namespace quadrille::sat

QUADRILLE_API_END
