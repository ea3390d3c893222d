// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/core/outcome.hpp"
#include "quadrille/sat/derivation.hpp"
#include "quadrille/sat/lemma.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::sat {

/// A number that each plan determines, and of which a sum has what is beyond `base`.
struct ProofItem {
  enum class Kind : std::uint8_t {
    literal,  ///< 1 if it is true, else 0.
    agent,    ///< What the agent costs.
    counter,  ///< Of a core's counter, see CoreCounter.
  };
  Kind kind = Kind::literal;
  Lit literal;
  AgentId agent;
  int counter = 0;
  /// Of a counter of one level, 0: how many of its numbers reach that. Else: the number of levels
  /// that `rank` of its numbers reach.
  int rank = 0;
  Cost base = 0;
};

/// Notes all that a lower bound may rest on, so that a certificate can be made of it when the
/// search has ended (docs/certificates.md): the lemmas, how the SAT solvers derive clauses from
/// them, what counters count, which cores were paid for, which bounds were claimed.
///
/// All is kept in memory: 1 to 3 MB per second of search. Nothing is decided here, and nothing is
/// asked of it by those who search. Numbers of sums, counters and passes begin with 1; 0 is none.
/// One thread.
class ProofLog final : public PassingObserver, public DerivationObserver {
 public:
  /// `next`: hears of lemmas, too, and outlives the log; may be null.
  explicit ProofLog(ClauseObserver* next) : PassingObserver(next), offline_(*this) {}
  ProofLog(const ProofLog&) = delete;
  ProofLog& operator=(const ProofLog&) = delete;

  // ---- by the engine
  void on_lemma(const Lemma& lemma) override;
  void on_given(Number number, Clause clause) override;
  void on_derived(Number number, Clause clause, std::span<const Number> antecedents) override;
  void on_refuted(Number number, Clause clause, std::span<const Number> antecedents) override;
  /// Of the one solver without theory: it is given all lemmas of the engine, in their order.
  [[nodiscard]] DerivationObserver& offline() noexcept { return offline_; }

  // ---- by counters
  /// A tree of sums of two: items 0 .. num_inputs - 1 are the inputs, then the adders by their
  /// items.
  [[nodiscard]] int add_sum(std::size_t num_inputs,
                            std::vector<std::pair<std::size_t, std::size_t>> adders);
  void set_inputs(int sum, std::vector<ProofItem> inputs);
  /// Its inputs are by how much agents cost more than this, one after the other.
  void set_inputs_beyond(int sum, std::span<const Cost> costs);
  /// `lit` is true if the item is at least `k`.
  void set_output(int sum, std::size_t item, int k, Lit lit);
  /// The next core's counter.
  [[nodiscard]] int add_counter();
  /// The next level of a counter.
  void add_level(int counter, int sum);

  // ---- by searches for the least cost
  [[nodiscard]] int add_pass();
  /// Of these numbers, all of which are open, one exceeds its base by `lift` or more: the clause of
  /// the last lemma says so. `counter`: of what the others come to; 0 for one number.
  void add_core(int pass, int counter, Cost lift, std::vector<ProofItem> softs);
  /// `sum` is over what the pass has left open.
  void add_excess(int pass, int sum, Cost bound);
  /// That an agent costs more than its ceiling, which no plan does that is looked for.
  struct Beyond {
    AgentId agent;
    Lit lit;
  };
  /// The clause follows from its refutation together with `beyond`. To be told before it is
  /// announced as a lemma (why::Core). What it rests on are lemmas (why::Ceiling) that the solver
  /// does not have.
  void conclude(std::span<const Lit> clause, std::span<const Beyond> beyond);
  /// No plan costs less than `bound`: by the cores of a pass, ...
  void claim_by_cores(int pass, Cost bound);
  /// ... because the excess `sum` is refuted to be less by the core of the last verdict, ...
  void claim_by_excess(int sum, Cost bound, Lit refuted);
  /// ... or by a core of assumptions that bound costs. Of claims that are equal the first counts.
  void claim_by_core(Cost bound, std::span<const Lit> core);

  // ---- what was noted
  using Index = std::uint32_t;  ///< Of an entry; antecedents have smaller ones.
  enum class Kind : std::uint8_t { lemma, derived, core, excess };
  struct Entry {
    Kind kind = Kind::lemma;
    std::vector<Lit> clause;         ///< Of lemma and derived.
    std::vector<Index> antecedents;  ///< Of derived.
    std::size_t number = 0;          ///< Of lemma, core and excess: in the lists below.
  };
  struct Sum {
    std::size_t num_inputs = 0;
    std::vector<std::pair<std::size_t, std::size_t>> adders;
    std::vector<ProofItem> inputs;
    [[nodiscard]] std::size_t root() const noexcept { return num_inputs + adders.size() - 1; }
  };
  struct Output {
    int sum = 0;
    std::size_t item = 0;
    int k = 0;
  };
  struct Core {
    int pass = 0, counter = 0;
    Cost lift = 1;
    std::vector<ProofItem> softs;
    Index clause = 0;
  };
  struct Excess {
    int pass = 0, sum = 0;
    Cost bound = 0;
  };
  struct Claim {
    Cost bound = 0;
    int pass = 0;                  ///< Of cores; else 0.
    std::optional<Index> refuted;  ///< The clause that it follows from; absent: from the cores.
    int excess = 0;                ///< The sum that the clause is about; 0: none.
    Index end = 0;                 ///< The number of entries when it was made.
  };

  [[nodiscard]] Index num_entries() const noexcept { return static_cast<Index>(begins_.size()); }
  [[nodiscard]] Entry entry(Index index) const;
  [[nodiscard]] const Why& why(std::size_t lemma) const { return whys_[lemma]; }
  [[nodiscard]] const Core& core(std::size_t number) const { return cores_[number]; }
  [[nodiscard]] const Excess& excess(std::size_t number) const { return excesses_[number]; }
  [[nodiscard]] const Sum& sum(int number) const {
    return sums_[static_cast<std::size_t>(number) - 1];
  }
  /// Sums by level, from 1.
  [[nodiscard]] const std::vector<int>& levels(int counter) const {
    return counters_[static_cast<std::size_t>(counter) - 1];
  }
  /// The counter that the sum is a level of; 0: of none.
  [[nodiscard]] int counter_of(int sum) const;
  /// Null: not an output of a sum.
  [[nodiscard]] const Output* output_of(int variable) const;
  /// Invalid: it was never asked for.
  [[nodiscard]] Lit find_output(int sum, std::size_t item, int k) const;
  /// Where a clause was refuted or concluded, the last time; the empty one also if the clauses
  /// contradict each other.
  [[nodiscard]] std::optional<Index> find(std::span<const Lit> clause) const;
  /// The best one; its bound is 0 if there was none.
  [[nodiscard]] const Claim& claim() const noexcept { return claim_; }
  /// Why no certificate can be made of it, which is an error of the program; empty otherwise.
  [[nodiscard]] const std::string& fault() const noexcept { return fault_; }

 private:
  /// What one solver tells, by its numbers.
  class Offline final : public DerivationObserver {
   public:
    explicit Offline(ProofLog& log) : log_(log) {}
    void on_given(Number number, Clause clause) override;
    void on_derived(Number number, Clause clause, std::span<const Number> antecedents) override;
    void on_refuted(Number number, Clause clause, std::span<const Number> antecedents) override;

   private:
    ProofLog& log_;
    std::vector<Index> indices_;
    std::size_t num_given_ = 0;
  };

  [[nodiscard]] Index begin(Kind kind);
  void put(std::uint64_t value);
  void fail(const char* what);
  static void set(std::vector<Index>& indices, Number number, Index index);
  std::optional<Index> derive(std::vector<Index>& indices, Number number, Clause clause,
                              std::span<const Number> antecedents);
  void refute(std::vector<Index>& indices, Number number, Clause clause,
              std::span<const Number> antecedents);
  [[nodiscard]] Index begin_lemma(const Why& why, std::span<const Lit> clause);
  [[nodiscard]] std::optional<Index> find_refuted(std::vector<int> clause) const;
  void offer(const Claim& claim);

  Offline offline_;
  std::vector<unsigned char> bytes_;
  std::vector<std::uint64_t> begins_;  // of entries
  std::vector<Why> whys_;              // of lemmas
  std::vector<Index> lemmas_;          // their entries; those of cores have that of the refutation
  std::vector<Index> indices_;         // by the engine's numbers
  std::unordered_multimap<std::uint64_t, Index> announced_;  // by hash, until the solver has them
  std::map<std::vector<int>, Index> refuted_;                // by sorted literals; the last one
  std::vector<Sum> sums_;
  std::vector<std::vector<int>> counters_;
  std::map<int, int> counter_of_;  // by sum
  std::map<int, Output> outputs_;  // by variable
  std::map<std::tuple<int, std::size_t, int>, Lit> literals_;
  std::vector<Core> cores_;
  std::vector<Excess> excesses_;
  int num_passes_ = 0;
  Claim claim_;
  std::string fault_;
};

}  // namespace quadrille::sat

QUADRILLE_API_END
