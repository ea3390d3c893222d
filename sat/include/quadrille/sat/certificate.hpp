// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <unordered_set>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/core/outcome.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/sat/proof_log.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::sat {

/// Writes the records of a certificate, docs/certificates.md: a tag each, the number of integers,
/// and these.
class CertificateWriter {
 public:
  using Integers = std::span<const std::int64_t>;
  /// Of a clause, in the order of the records, from 1.
  using ClauseNumber = std::int64_t;

  /// From now on: the certificate's variable of this number means the opposite of the solver's.
  void negate(int variable) { negated_.insert(variable); }
  /// The certificate's literal.
  [[nodiscard]] std::int64_t number(Lit lit) const {
    return negated_.count(lit.variable()) == 0 ? lit.dimacs() : -lit.dimacs();
  }

  void record(char tag, Integers values);
  void record(char tag, std::initializer_list<std::int64_t> values) {
    record(tag, Integers(values.begin(), values.size()));
  }
  /// A clause that holds by a rule.
  ClauseNumber axiom(int rule, Integers parameters, std::span<const Lit> clause);
  /// A clause that follows from others by unit propagation, in their order.
  ClauseNumber derived(std::span<const Lit> clause, std::span<const ClauseNumber> hints);

  /// All that was written.
  [[nodiscard]] std::string& text() noexcept { return text_; }

 private:
  void put(std::uint64_t value);
  void put_signed(std::int64_t value);

  std::string text_;
  std::unordered_set<int> negated_;
  ClauseNumber num_clauses_ = 0;
};

/// What a domain's variables and lemmas mean, for a certificate.
class ProofMeanings {
 public:
  virtual ~ProofMeanings() = default;
  /// Writes what the variable means. False: it is none of this domain.
  [[nodiscard]] virtual bool declare(int variable, CertificateWriter& writer) const = 0;
  /// Writes what comes before all clauses, and perhaps some.
  virtual void begin(CertificateWriter& /*writer*/) const {}
  /// Writes what the rule of a lemma needs besides, before `rule_of` is asked for it.
  virtual void prepare(const Why& /*why*/, std::span<const Lit> /*clause*/,
                       CertificateWriter& /*writer*/) const {}
  struct Rule {
    int number = 0;  ///< 0: there is no rule for such a lemma.
    std::vector<std::int64_t> parameters;
  };
  /// The rule by which a lemma holds that is no counter's.
  [[nodiscard]] virtual Rule rule_of(const Why& why, std::span<const Lit> clause) const = 0;
  /// The literal "the agent costs more than `cost`"; invalid if nobody asked for it so far.
  [[nodiscard]] virtual Lit cost_above(AgentId agent, Cost cost) const = 0;

  // The same in all domains.
  [[nodiscard]] static std::int64_t agent_number(AgentId agent) {
    return static_cast<std::int64_t>(agent.value());
  }
  /// Writes that a variable of the certificate means: the agent costs at most `cost`.
  static void declare_cost(int variable, AgentId agent, Cost cost, CertificateWriter& writer) {
    writer.record('c', {variable, agent_number(agent), cost});
  }
  /// That no walk of the agent makes the clause false.
  [[nodiscard]] static Rule one_agent_rule(AgentId agent) { return {1, {agent_number(agent)}}; }
};

/// The records of a certificate, without head and plan.
struct TrimmedProof {
  Cost claim = 0;  ///< No plan costs less.
  std::string records;
};
/// The records of clauses alone.
struct TrimmedClauses {
  std::string records;
  std::vector<CertificateWriter::ClauseNumber>
      numbers;  ///< Of those that were asked for, in order.
};
/// Of all that was noted, what the `wanted` clauses rest on. Otherwise as trim_proof.
[[nodiscard]] Result<TrimmedClauses> trim_clauses(const ProofLog& log,
                                                  const ProofMeanings& meanings, int num_variables,
                                                  std::span<const ProofLog::Index> wanted);
/// Of all that was noted, what the best claim rests on, with the claim at the end. `free_bound`:
/// what plans cost at least when each agent is alone; the claim if there is no better one.
/// `num_variables`: of the engine. Deterministic; linear in the size of the log. Errors: internal,
/// when the log does not have what the claim rests on, or what it rests on has no rule.
[[nodiscard]] Result<TrimmedProof> trim_proof(const ProofLog& log, const ProofMeanings& meanings,
                                              int num_variables, Cost free_bound);

}  // namespace quadrille::sat

QUADRILLE_API_END
