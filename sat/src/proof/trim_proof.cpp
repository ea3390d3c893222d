// SPDX-License-Identifier: MIT
#include <algorithm>
#include <optional>
#include <utility>

#include "proof/counter_nodes.hpp"
#include "quadrille/sat/certificate.hpp"

namespace quadrille::sat {
namespace {

using Index = ProofLog::Index;
using Kind = ProofLog::Kind;

class Trimmer {
 public:
  Trimmer(const ProofLog& log, const ProofMeanings& meanings, int num_variables)
      : log_(log), meanings_(meanings), nodes_(log, meanings, num_variables, writer_) {}

  Result<TrimmedProof> trim(Cost free_bound) {
    const ProofLog::Claim& claim = log_.claim();
    const bool is_free = claim.bound <= free_bound;
    if (!log_.fault().empty()) fail(log_.fault());
    if (!is_free && fault_.empty()) {
      if (claim.refuted) wanted_.push_back(*claim.refuted);
      mark(claim);
      write_needed();
    }
    if (auto error = find_fault()) return *std::move(error);
    const Cost bound = is_free ? free_bound : claim.bound;
    writer_.record('q', {bound, !is_free && claim.refuted ? numbers_[*claim.refuted] : 0});
    return TrimmedProof{bound, std::move(writer_.text())};
  }

  Result<TrimmedClauses> trim(std::span<const Index> wanted) {
    if (!log_.fault().empty()) fail(log_.fault());
    wanted_.assign(wanted.begin(), wanted.end());
    if (fault_.empty()) {
      meanings_.begin(writer_);
      mark({});
      write_needed();
    }
    if (auto error = find_fault()) return *std::move(error);
    TrimmedClauses trimmed;
    for (const Index index : wanted) trimmed.numbers.push_back(numbers_[index]);
    trimmed.records = std::move(writer_.text());
    return trimmed;
  }

 private:
  std::optional<Error> find_fault() {
    if (!nodes_.fault().empty()) fail(nodes_.fault());
    if (fault_.empty()) return std::nullopt;
    return Error{ErrorCode::internal, "no certificate: " + fault_, {}};
  }

  void write_needed() {
    find_last_uses();
    for (Index at = 0; at < log_.num_entries() && fault_.empty(); ++at)
      if (is_needed_[at]) write(at);
  }

  void fail(std::string what) {
    if (fault_.empty()) fault_ = std::move(what);
  }

  /// What the claim rests on, backwards: antecedents are older.
  void mark(const ProofLog::Claim& claim) {
    const Index size = log_.num_entries();
    is_needed_.assign(size, false);
    int pass = claim.pass;
    Index end = claim.end;
    for (const Index index : wanted_) is_needed_[index] = true;
    for (Index at = 0; at < size && claim.excess != 0; ++at) {
      const ProofLog::Entry entry = log_.entry(at);
      if (entry.kind != Kind::excess || log_.excess(entry.number).sum != claim.excess) continue;
      is_needed_[at] = true;
      pass = log_.excess(entry.number).pass;
      end = at;
    }
    for (Index at = size; at-- > 0;) {
      const ProofLog::Entry entry = log_.entry(at);
      if (entry.kind == Kind::core && pass != 0 && log_.core(entry.number).pass == pass &&
          at < end) {
        is_needed_[at] = true;
        is_needed_[log_.core(entry.number).clause] = true;
      }
      if (!is_needed_[at]) continue;
      for (const Index antecedent : entry.antecedents) is_needed_[antecedent] = true;
    }
  }

  void find_last_uses() {
    last_use_.assign(log_.num_entries(), 0);
    for (Index at = 0; at < log_.num_entries(); ++at) {
      if (!is_needed_[at]) continue;
      const ProofLog::Entry entry = log_.entry(at);
      for (const Index antecedent : entry.antecedents) last_use_[antecedent] = at;
      if (entry.kind == Kind::core) last_use_[log_.core(entry.number).clause] = at;
    }
    for (const Index index : wanted_) last_use_[index] = log_.num_entries();
    numbers_.assign(log_.num_entries(), 0);
  }

  void write(Index at) {
    const ProofLog::Entry entry = log_.entry(at);
    switch (entry.kind) {
      case Kind::lemma:
        return write_lemma(at, entry);
      case Kind::derived:
        return write_derived(at, entry);
      case Kind::core:
        return write_core(at, log_.core(entry.number));
      case Kind::excess:
        return writer_.record('e', {nodes_.root(log_.excess(entry.number).sum)});
    }
  }

  void write_lemma(Index at, const ProofLog::Entry& entry) {
    const Why& why = log_.why(entry.number);
    ProofMeanings::Rule rule;
    if (std::holds_alternative<why::Counter>(why)) {
      rule.number = nodes_.rule_of(entry.clause);
    } else {
      meanings_.prepare(why, entry.clause, writer_);
      rule = meanings_.rule_of(why, entry.clause);
    }
    if (rule.number == 0)
      return fail("there is no rule for a lemma that is needed: " + std::string(to_string(why)));
    nodes_.declare(entry.clause);
    numbers_[at] = writer_.axiom(rule.number, rule.parameters, entry.clause);
  }

  void write_derived(Index at, const ProofLog::Entry& entry) {
    nodes_.declare(entry.clause);
    std::vector<std::int64_t> hints;
    for (const Index antecedent : entry.antecedents) hints.push_back(numbers_[antecedent]);
    numbers_[at] = writer_.derived(entry.clause, hints);
    forget(at, entry.antecedents);
  }

  /// What nothing later needs.
  void forget(Index at, const std::vector<Index>& clauses) {
    std::vector<std::int64_t> dead;
    for (const Index clause : clauses) {
      if (last_use_[clause] != at) continue;
      dead.push_back(numbers_[clause]);
      last_use_[clause] = log_.num_entries();  // said once
    }
    if (!dead.empty()) writer_.record('d', dead);
  }

  /// As many steps as the core raises the bound by: of these numbers one exceeds its base by 1 or
  /// more, by 2 or more, ..., which follows from the last of them, the clause that was refuted.
  void write_core(Index at, const ProofLog::Core& core) {
    const std::vector<Lit> top = log_.entry(core.clause).clause;
    std::vector<std::pair<ProofItem, Lit>> softs;
    for (const ProofItem& soft : core.softs)
      if (const Lit lit = nodes_.beyond(soft, core.lift);
          std::find(top.begin(), top.end(), lit) != top.end())
        softs.emplace_back(soft, lit);
    if (softs.size() != top.size()) return fail("a core has other literals than its softs");
    for (Cost units = 1; units <= core.lift; ++units) {
      const std::int64_t clause =
          units == core.lift ? numbers_[core.clause] : write_step(softs, units, core.clause);
      writer_.record('k', {clause, node_of(core, units)});
      if (units < core.lift) writer_.record('d', {clause});
    }
    forget(at, {core.clause});
  }

  /// The clause that one of them exceeds its base by `units`.
  std::int64_t write_step(const std::vector<std::pair<ProofItem, Lit>>& softs, Cost units,
                          Index top) {
    std::vector<Lit> clause;
    std::vector<std::int64_t> hints;
    for (const auto& [soft, high] : softs) {
      const Lit low = nodes_.beyond(soft, units);
      if (!low.valid()) fail("a core's counter was never asked for less than it says");
      clause.push_back(low);
      const std::vector<Lit> order{~high, low};
      ProofMeanings::Rule rule;
      if (soft.kind == ProofItem::Kind::agent)
        rule = ProofMeanings::one_agent_rule(soft.agent);
      else
        rule.number = nodes_.rule_of(order);
      hints.push_back(writer_.axiom(rule.number, rule.parameters, order));
    }
    std::vector<std::int64_t> used = hints;
    hints.push_back(numbers_[top]);
    const std::int64_t made = writer_.derived(clause, hints);
    writer_.record('d', used);
    return made;
  }

  /// Of the counter of those that exceed their base by `units`; -1: nobody asked for it.
  std::int64_t node_of(const ProofLog::Core& core, Cost units) {
    if (core.counter == 0) return -1;
    const std::vector<int>& levels = log_.levels(core.counter);
    const auto level = static_cast<std::size_t>(units);
    return level <= levels.size() ? nodes_.root(levels[level - 1]) : -1;
  }

  const ProofLog& log_;
  const ProofMeanings& meanings_;
  CertificateWriter writer_;
  CounterNodes nodes_;
  std::vector<Index> wanted_;
  std::vector<bool> is_needed_;
  std::vector<Index> last_use_;
  std::vector<std::int64_t> numbers_;  // of clauses, by entry
  std::string fault_;
};

}  // namespace

Result<TrimmedProof> trim_proof(const ProofLog& log, const ProofMeanings& meanings,
                                int num_variables, Cost free_bound) {
  return Trimmer(log, meanings, num_variables).trim(free_bound);
}

Result<TrimmedClauses> trim_clauses(const ProofLog& log, const ProofMeanings& meanings,
                                    int num_variables, std::span<const ProofLog::Index> wanted) {
  return Trimmer(log, meanings, num_variables).trim(wanted);
}

}  // namespace quadrille::sat
