// SPDX-License-Identifier: MIT
#include "quadrille/sat/proof_log.hpp"

#include <algorithm>
#include <limits>

namespace quadrille::sat {
namespace {

constexpr ProofLog::Index kNone = std::numeric_limits<ProofLog::Index>::max();

std::uint64_t folded(int value) {
  return static_cast<std::uint64_t>(value) << 1 ^ static_cast<std::uint64_t>(value >> 31);
}

template <class Literals, class Dimacs>
std::uint64_t hash(const Literals& literals, const Dimacs& dimacs) {
  std::uint64_t h = 0;
  for (const auto& lit : literals)
    h = (h ^ static_cast<std::uint32_t>(dimacs(lit))) * 0x9E3779B97F4A7C15ULL;
  return h;
}

std::vector<int> sorted_numbers(std::span<const Lit> lits, int sign = 1) {
  std::vector<int> clause;
  for (const Lit lit : lits) clause.push_back(sign * lit.dimacs());
  std::sort(clause.begin(), clause.end());
  return clause;
}

/// Reads what ProofLog::put has written.
class Reader {
 public:
  Reader(const std::vector<unsigned char>& bytes, std::size_t at) : bytes_(bytes), at_(at) {}
  std::uint64_t next() {
    std::uint64_t value = 0;
    for (int shift = 0;; shift += 7) {
      const unsigned char byte = bytes_[at_++];
      value |= static_cast<std::uint64_t>(byte & 127) << shift;
      if (byte < 128) return value;
    }
  }
  std::vector<Lit> clause() {
    std::vector<Lit> lits(next());
    for (Lit& lit : lits) {
      const std::uint64_t value = next();
      const int variable = static_cast<int>(value >> 1);
      lit = Lit::from_dimacs((value & 1) != 0 ? ~variable : variable);
    }
    return lits;
  }

 private:
  const std::vector<unsigned char>& bytes_;
  std::size_t at_;
};

}  // namespace

// ---- entries: kind, then what belongs to it -----------------------------------------------------

ProofLog::Index ProofLog::begin(Kind kind) {
  begins_.push_back(bytes_.size());
  bytes_.push_back(static_cast<unsigned char>(kind));
  return num_entries() - 1;
}

void ProofLog::put(std::uint64_t value) {
  for (; value >= 128; value >>= 7) bytes_.push_back(static_cast<unsigned char>(value | 128));
  bytes_.push_back(static_cast<unsigned char>(value));
}

ProofLog::Entry ProofLog::entry(Index index) const {
  Entry entry;
  const std::uint64_t at = begins_[index];
  entry.kind = static_cast<Kind>(bytes_[at]);
  Reader reader(bytes_, at + 1);
  if (entry.kind != Kind::derived) entry.number = reader.next();
  if (entry.kind == Kind::lemma || entry.kind == Kind::derived) entry.clause = reader.clause();
  if (entry.kind == Kind::derived) {
    entry.antecedents.resize(reader.next());
    for (Index& antecedent : entry.antecedents)
      antecedent = index - static_cast<Index>(reader.next());
  }
  return entry;
}

void ProofLog::fail(const char* what) {
  if (fault_.empty()) fault_ = what;
}

// ---- by the engine ------------------------------------------------------------------------------

void ProofLog::on_lemma(const Lemma& lemma) {
  PassingObserver::on_lemma(lemma);
  Index index = kNone;
  if (lemma.is<why::Core>()) {
    if (const auto refuted = find(lemma.clause))
      index = *refuted;
    else
      fail("a core was never refuted");
  } else {
    index = begin_lemma(lemma.why, lemma.clause);
  }
  lemmas_.push_back(index);
  announced_.emplace(hash(lemma.clause, [](Lit lit) { return lit.dimacs(); }), index);
}

ProofLog::Index ProofLog::begin_lemma(const Why& why, std::span<const Lit> clause) {
  const Index index = begin(Kind::lemma);
  put(whys_.size());
  put(clause.size());
  for (const Lit lit : clause) put(folded(lit.dimacs()));
  whys_.push_back(why);
  return index;
}

// The solver may be given clauses in another order than that in which they were announced.
void ProofLog::on_given(Number number, Clause clause) {
  const auto [first, last] = announced_.equal_range(hash(clause, [](int lit) { return lit; }));
  const auto is_this = [&](const auto& announced) {
    if (announced.second == kNone) return false;
    // That of a refutation may be in another order.
    std::vector<Lit> known = entry(announced.second).clause;
    std::vector<Lit> given;
    for (const int lit : clause) given.push_back(Lit::from_dimacs(lit));
    std::sort(known.begin(), known.end());
    std::sort(given.begin(), given.end());
    return known == given;
  };
  // Of equal ones the first, whatever the order of the table.
  auto found = last;
  for (auto at = first; at != last; ++at)
    if (is_this(*at) && (found == last || at->second < found->second)) found = at;
  if (found == last) return fail("the solver has a clause that nobody announced");
  set(indices_, number, found->second);
  announced_.erase(found);
}

void ProofLog::set(std::vector<Index>& indices, Number number, Index index) {
  if (indices.size() <= number) indices.resize(number + 1, kNone);
  indices[number] = index;
}

std::optional<ProofLog::Index> ProofLog::derive(std::vector<Index>& indices, Number number,
                                                Clause clause,
                                                std::span<const Number> antecedents) {
  if (!fault_.empty()) return std::nullopt;
  for (const Number antecedent : antecedents)
    if (antecedent >= indices.size() || indices[antecedent] == kNone) {
      fail("a clause follows from one that is not known");
      return std::nullopt;
    }
  const Index index = begin(Kind::derived);
  put(clause.size());
  for (const int lit : clause) put(folded(lit));
  put(antecedents.size());
  for (const Number antecedent : antecedents) put(index - indices[antecedent]);
  set(indices, number, index);
  if (clause.empty()) refuted_[std::vector<int>()] = index;
  return index;
}

void ProofLog::refute(std::vector<Index>& indices, Number number, Clause clause,
                      std::span<const Number> antecedents) {
  const auto index = derive(indices, number, clause, antecedents);
  if (!index) return;
  std::vector<int> sorted(clause.begin(), clause.end());
  std::sort(sorted.begin(), sorted.end());
  refuted_[std::move(sorted)] = *index;
}

void ProofLog::on_derived(Number number, Clause clause, std::span<const Number> antecedents) {
  static_cast<void>(derive(indices_, number, clause, antecedents));
}
void ProofLog::on_refuted(Number number, Clause clause, std::span<const Number> antecedents) {
  refute(indices_, number, clause, antecedents);
}

void ProofLog::Offline::on_given(Number number, Clause) {
  if (num_given_ == log_.lemmas_.size())
    return log_.fail("the offline solver has more clauses than the engine");
  set(indices_, number, log_.lemmas_[num_given_++]);
}
void ProofLog::Offline::on_derived(Number number, Clause clause,
                                   std::span<const Number> antecedents) {
  static_cast<void>(log_.derive(indices_, number, clause, antecedents));
}
void ProofLog::Offline::on_refuted(Number number, Clause clause,
                                   std::span<const Number> antecedents) {
  log_.refute(indices_, number, clause, antecedents);
}

std::optional<ProofLog::Index> ProofLog::find_refuted(std::vector<int> clause) const {
  const auto found = refuted_.find(clause);
  if (found == refuted_.end()) return std::nullopt;
  return found->second;
}

std::optional<ProofLog::Index> ProofLog::find(std::span<const Lit> clause) const {
  return find_refuted(sorted_numbers(clause));
}

void ProofLog::conclude(std::span<const Lit> clause, std::span<const Beyond> beyond) {
  std::vector<Lit> whole(clause.begin(), clause.end());
  for (const Beyond& agent : beyond) whole.push_back(agent.lit);
  const auto refuted = find(whole);
  if (!refuted) return fail("a core was never refuted");
  if (beyond.empty()) return;
  std::vector<Index> antecedents;
  for (const auto& [agent, lit] : beyond)
    antecedents.push_back(begin_lemma(why::Ceiling{agent}, std::vector{~lit}));
  antecedents.push_back(*refuted);
  const Index index = begin(Kind::derived);
  put(clause.size());
  for (const Lit lit : clause) put(folded(lit.dimacs()));
  put(antecedents.size());
  for (const Index antecedent : antecedents) put(index - antecedent);
  refuted_[sorted_numbers(clause)] = index;
}

// ---- by counters --------------------------------------------------------------------------------

int ProofLog::add_sum(std::size_t num_inputs,
                      std::vector<std::pair<std::size_t, std::size_t>> adders) {
  sums_.push_back({num_inputs, std::move(adders), {}});
  return static_cast<int>(sums_.size());
}

void ProofLog::set_inputs(int sum, std::vector<ProofItem> inputs) {
  sums_[static_cast<std::size_t>(sum) - 1].inputs = std::move(inputs);
}

void ProofLog::set_inputs_beyond(int sum, std::span<const Cost> costs) {
  std::vector<ProofItem> items(costs.size());
  for (std::size_t at = 0; at < costs.size(); ++at) {
    items[at].kind = ProofItem::Kind::agent;
    items[at].agent = AgentId(at);
    items[at].base = costs[at];
  }
  set_inputs(sum, std::move(items));
}

void ProofLog::set_output(int sum, std::size_t item, int k, Lit lit) {
  outputs_[lit.variable()] = {sum, item, k};
  literals_[{sum, item, k}] = lit;
}

int ProofLog::add_counter() {
  counters_.emplace_back();
  return static_cast<int>(counters_.size());
}

void ProofLog::add_level(int counter, int sum) {
  counters_[static_cast<std::size_t>(counter) - 1].push_back(sum);
  counter_of_[sum] = counter;
}

int ProofLog::counter_of(int sum) const {
  const auto found = counter_of_.find(sum);
  return found == counter_of_.end() ? 0 : found->second;
}

const ProofLog::Output* ProofLog::output_of(int variable) const {
  const auto found = outputs_.find(variable);
  return found == outputs_.end() ? nullptr : &found->second;
}

Lit ProofLog::find_output(int sum, std::size_t item, int k) const {
  const auto found = literals_.find({sum, item, k});
  return found == literals_.end() ? Lit() : found->second;
}

// ---- by searches --------------------------------------------------------------------------------

int ProofLog::add_pass() { return ++num_passes_; }

void ProofLog::add_core(int pass, int counter, Cost lift, std::vector<ProofItem> softs) {
  if (lemmas_.empty() || lemmas_.back() == kNone) return fail("a core has no clause");
  static_cast<void>(begin(Kind::core));
  put(cores_.size());
  cores_.push_back({pass, counter, lift, std::move(softs), lemmas_.back()});
}

void ProofLog::add_excess(int pass, int sum, Cost bound) {
  static_cast<void>(begin(Kind::excess));
  put(excesses_.size());
  excesses_.push_back({pass, sum, bound});
}

void ProofLog::offer(const Claim& claim) {
  if (claim.bound <= claim_.bound) return;
  claim_ = claim;
  claim_.end = num_entries();
}

void ProofLog::claim_by_cores(int pass, Cost bound) { offer({bound, pass, {}, 0, 0}); }

void ProofLog::claim_by_excess(int sum, Cost bound, Lit refuted) {
  const auto clause = find_refuted({refuted.dimacs()});
  if (!clause) return fail("a claim was never refuted");
  offer({bound, 0, clause, sum, 0});
}

void ProofLog::claim_by_core(Cost bound, std::span<const Lit> core) {
  const auto clause = find_refuted(sorted_numbers(core, -1));
  if (!clause) return fail("a claim was never refuted");
  offer({bound, 0, clause, 0, 0});
}

}  // namespace quadrille::sat
