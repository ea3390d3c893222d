// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <set>

#include "exports/export.hpp"
#include "exports/hints.hpp"
#include "exports/pb_numbers.hpp"

namespace quadrille_check {
namespace {

constexpr Int kRuleOfSums = 6, kRuleOfOrder = 7;

class PbExport {
 public:
  PbExport(const std::string& content, const Checker& checker)
      : meanings_(checker.meanings()),
        ledger_(checker.ledger()),
        proof_(meanings_.last_variable()),
        numbers_(meanings_, proof_) {
    RecordReader reader(content);
    for (Record record; reader.next(record);) {
      if (record.tag != 'a' && record.tag != 'l')
        read(record);
      else
        clauses_.emplace_back(reader.num_clauses(), record);
    }
  }

  void refute() {
    write_formula();
    for (const auto& [number, record] : clauses_) {
      if (record.tag == 'l')
        derive(number, record);
      else if (record.values[0] == kRuleOfSums)
        derive_sum(number, record);
      else if (record.values[0] == kRuleOfOrder)
        derive_order(number, record);
    }
    conclude();
  }

  bool write(const std::string& opb, const std::string& pbp) const {
    std::ofstream formula(opb), proof(pbp);
    formula << proof_.formula();
    proof << proof_.refutation(contradiction_);
    formula.flush();
    proof.flush();
    return formula.good() && proof.good();
  }

 private:
  struct Core {
    Int clause = 0, node = 0;
  };

  void read(const Record& record) {
    const Ints& values = record.values;
    if (record.tag == 'i') is_makespan_ = values[1] == 1;
    if (record.tag == 'c' || record.tag == 's' || record.tag == 'n') numbers_.note(record);
    if (record.tag == 'k') cores_.push_back({values[0], values[1]});
    if (record.tag == 'e') excess_ = values[0];
    if (record.tag == 'q') {
      claim_ = values[0];
      claimed_by_ = values[1];
    }
  }

  static void sort(Ints& literals) {
    std::sort(literals.begin(), literals.end());
    literals.erase(std::unique(literals.begin(), literals.end()), literals.end());
  }

  /// Of the certificate's clause, sorted.
  [[nodiscard]] Ints literals_of(Int number) const {
    if (number == 0) return {};
    const Record& record = clauses_[static_cast<std::size_t>(number) - 1].second;
    Ints literals;
    for (const Int lit : record.tag == 'a' ? record.literals() : record.derived())
      literals.push_back(numbers_.same(lit));
    sort(literals);
    return literals;
  }
  [[nodiscard]] Ints claim_literals() const { return literals_of(claimed_by_); }

  /// False: it has a literal and its opposite, and says nothing.
  bool note(Int number, std::span<const Int> clause, bool without_numbers = false) {
    Ints& literals = literals_[number];
    for (const Int lit : clause) {
      const auto kind = meanings_.variable(lit).kind;
      if (without_numbers && kind == Variable::Kind::number_is_at_least) continue;
      literals.push_back(numbers_.same(lit));
    }
    sort(literals);
    return std::none_of(literals.begin(), literals.end(), [&](Int lit) {
      return std::binary_search(literals.begin(), literals.end(), -lit);
    });
  }

  // ---- the formula

  /// Axioms about agents, in which a literal about a number has no part; how costs are ordered; and
  /// that a plan costs less than is claimed.
  void write_formula() {
    for (const Int lit : claim_literals())
      if (const Variable& x = meanings_.variable(lit);
          x.kind == Variable::Kind::costs_at_most && !is_makespan_)
        numbers_.fill(x.agent, ledger_.free_cost(x.agent));
    for (const auto& [number, record] : clauses_)
      if (record.tag == 'a' && record.values[0] < kRuleOfSums &&
          note(number, record.literals(), true))
        ids_[number] = proof_.given(literals_[number], 1);
    numbers_.give_orders();
    const Int least = is_makespan_ ? ledger_.free_makespan() : ledger_.free_sum();
    if (claim_ <= least)
      contradiction_ = proof_.given({}, 1);  // all plans cost so much
    else if (is_makespan_)
      for (const Int lit : claim_literals()) at_most_[lit] = proof_.given(Ints{-lit}, 1);
    else
      bound_sum();
  }

  /// Units that cost one each; fewer are true than the claim has beyond what plans cost anyway.
  void bound_sum() {
    const Int beyond = claim_ - ledger_.free_sum();
    std::set<Int> units;
    for (const Int lit : claim_literals()) {
      const Variable& x = meanings_.variable(lit);
      if (x.kind == Variable::Kind::costs_at_most) {
        for (Int cost = ledger_.free_cost(x.agent); cost <= x.number; ++cost)
          units.insert(numbers_.costs_more(x.agent, cost));
      } else if (excess_ && ledger_.excess_base() + meanings_.implied(*excess_, lit) >= claim_) {
        by_excess_.insert(lit);
        add_costs(*excess_, units);
      } else {
        add_costs(x.node, units);
      }
    }
    uses_cores_ = claimed_by_ == 0 || !by_excess_.empty();
    for (const Core& core : cores_)
      for (const Int lit : literals_of(core.clause))
        if (uses_cores_ && lit < 0) units.insert(lit);
    units_.assign(units.begin(), units.end());
    Ints paid;
    for (const Int unit : units_) paid.push_back(-unit);
    cheaper_ = proof_.given(paid, static_cast<Int>(units_.size()) - beyond + 1);
  }

  void add_costs(Int node, std::set<Int>& units) {
    for (const Int leaf : meanings_.leaves(node))
      if (meanings_.node(leaf).kind == Node::Kind::agent)
        units.insert(numbers_.terms(leaf).begin(), numbers_.terms(leaf).end());
  }

  // ---- the proof, clause by clause

  /// By resolution, backwards from the hint that is false.
  void derive(Int number, const Record& record) {
    if (!note(number, record.derived())) return;
    Ints hints;
    for (const Int hint : record.hints()) hints.push_back(number - hint);
    std::vector<UsedHint> used = used_hints(literals_[number], hints, literals_);
    Ints literals = literals_.at(used.back().clause);
    Int made = ids_.at(used.back().clause);
    PbSum sum;
    sum.add(made);
    bool is_new = false;
    for (used.pop_back(); !used.empty(); used.pop_back()) {
      const auto [hint, implied] = used.back();
      const auto pivot = std::find(literals.begin(), literals.end(), -implied);
      if (pivot == literals.end()) continue;
      literals.erase(pivot);
      for (const Int lit : literals_.at(hint))
        if (lit != implied) literals.push_back(lit);
      sort(literals);
      sum.resolve(ids_.at(hint));
      is_new = true;
    }
    ids_[number] = is_new ? proof_.derive(sum) : made;
    literals_[number] = std::move(literals);
  }

  void derive_sum(Int number, const Record& record) {
    if (!note(number, record.literals())) return;
    for (const Int sum : record.literals()) {
      const Variable& s = meanings_.variable(sum);
      if (sum < 0 || s.kind != Variable::Kind::number_is_at_least) continue;
      const Node& n = meanings_.node(s.node);
      const auto [whole, whole_lit] = best(record.literals(), sum, s.node);
      const auto [left, left_lit] = best(record.literals(), sum, n.of);
      const auto [right, right_lit] = best(record.literals(), sum, n.base);
      if (std::max(whole, left + right) < s.number) continue;
      PbSum made;
      Ints literals;
      if (numbers_.add_if(made, s.node, s.number)) literals.push_back(numbers_.same(sum));
      const auto add = [&](Int node, Int lit) {
        numbers_.add_implied(made, node, -lit);
        if (lit != 0) literals.push_back(numbers_.same(lit));
      };
      if (whole >= s.number) {
        add(s.node, whole_lit);
      } else {
        add(n.of, left_lit);
        add(n.base, right_lit);
      }
      sort(literals);
      literals_[number] = std::move(literals);
      ids_[number] = proof_.derive(made.as_clause());
      return;
    }
  }

  /// What the node is at least if the other literals are false, and by which of them; 0: by none.
  [[nodiscard]] std::pair<Int, Int> best(std::span<const Int> clause, Int sum, Int node) const {
    std::pair<Int, Int> found{0, 0};
    for (const Int lit : clause)
      if (lit != sum)
        found = std::max(found, {meanings_.implied(node, -lit), lit},
                         [](auto& a, auto& b) { return a.first < b.first; });
    return found;
  }

  void derive_order(Int number, const Record& record) {
    const auto clause = record.literals();
    if (!note(number, clause)) return;
    ids_[number] = meanings_.implies(-clause[0], clause[1])
                       ? numbers_.implication(-clause[0], clause[1])
                       : numbers_.implication(-clause[1], clause[0]);
  }

  // ---- what the clauses come to

  void conclude() {
    if (contradiction_ != 0) return;
    const Int cores = uses_cores_ ? add_up_cores() : 0;
    PbSum last;
    if (claimed_by_ == 0) {
      last.add(cores).add(cheaper_);
    } else {
      last.add(ids_.at(claimed_by_));
      for (const Int lit : literals_.at(claimed_by_))
        last.add(is_makespan_ ? at_most_.at(lit) : refute(lit, cores));
    }
    contradiction_ = proof_.derive(last);
  }

  /// That a literal of the claim's clause is false, as plans that cost less make it.
  Int refute(Int lit, Int cores) {
    const Variable& x = meanings_.variable(lit);
    PbSum sum;
    std::set<Int> covered;
    const auto cover = [&](const Ints& terms) { covered.insert(terms.begin(), terms.end()); };
    sum.add(cheaper_);
    if (x.kind == Variable::Kind::costs_at_most) {
      for (Int cost = ledger_.free_cost(x.agent); cost <= x.number; ++cost) {
        const Int unit = numbers_.costs_more(x.agent, cost);
        covered.insert(unit);
        if (unit != lit) sum.add(numbers_.implication(lit, unit));
      }
    } else if (by_excess_.count(lit) != 0) {
      sum.add(cores);
      numbers_.add_implied(sum, *excess_, lit);
      cover(numbers_.terms(*excess_));
      for (const Core& core : cores_) cover(literals_of(core.clause));
    } else {
      numbers_.add_implied(sum, x.node, lit);
      cover(numbers_.terms(x.node));
    }
    for (const Int unit : units_)
      if (covered.count(unit) == 0) sum.add_literal(unit);
    return proof_.derive(sum.as_clause());
  }

  /// That as many units of agents are true as there are core steps, and one more for each unit that
  /// the excess counts.
  Int add_up_cores() {
    std::set<Int> spent;  // units of sums
    std::map<Int, Int> reach;
    const auto spend = [&](Int lit) {
      if (lit < 0) return;
      const auto [node, number] = numbers_.meaning(lit);
      spent.insert(lit);
      reach[node] = std::max(reach[node], number);
    };
    for (const Core& core : cores_)
      for (const Int lit : literals_of(core.clause)) spend(lit);
    if (!by_excess_.empty())
      for (const Int term : numbers_.terms(*excess_)) spend(term);
    PbSum total;
    for (const Core& core : cores_) {
      const Int last = core.node < 0 ? 1 : reach[core.node];
      total.add(at_least_one_and_more(core, last));
      for (Int k = 2; k <= last; ++k)
        if (const Int unit = numbers_.at_least(core.node, k); spent.count(unit) == 0)
          total.add_literal(unit);
    }
    return proof_.derive(total);
  }

  /// Of the core's literals at least one is true, and one more for each unit of its counter, up to
  /// "at least `last`", that is.
  Int at_least_one_and_more(const Core& core, Int last) {
    Int made = ids_.at(core.clause);
    const Ints& known = literals_.at(core.clause);
    PbSum whole;
    whole.add(made);
    for (const Int lit : literals_of(core.clause))
      if (!std::binary_search(known.begin(), known.end(), lit)) whole.add_literal(lit);
    if (literals_of(core.clause) != known) made = proof_.derive(whole);
    for (Int k = 2; k <= last; ++k)
      made = proof_.derive(PbSum().add(made, k - 1).add(numbers_.only_if(core.node, k)).divide(k));
    return made;
  }

  const Meanings& meanings_;
  const Ledger& ledger_;
  PbProof proof_;
  PbNumbers numbers_;
  std::vector<std::pair<Int, Record>> clauses_;
  std::vector<Core> cores_;
  std::optional<Int> excess_;
  bool is_makespan_ = false, uses_cores_ = false;
  Int claim_ = 0, claimed_by_ = 0, cheaper_ = 0, contradiction_ = 0;
  Ints units_;
  std::set<Int> by_excess_;
  std::map<Int, Int> at_most_;
  std::map<Int, Ints> literals_;  // by clause: those that the proof has
  std::map<Int, Int> ids_;        // likewise: its constraint
};

}  // namespace

bool export_pb(const std::string& content, const Checker& checker, const std::string& opb,
               const std::string& pbp) {
  PbExport made(content, checker);
  made.refute();
  return made.write(opb, pbp);
}

}  // namespace quadrille_check
