// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <vector>

#include "exports/export.hpp"
#include "exports/hints.hpp"
#include "read/records.hpp"

namespace quadrille_check {
namespace {

class LratExport {
 public:
  explicit LratExport(const std::string& content) {
    RecordReader reader(content);
    for (Record record; reader.next(record);) read(record, reader.num_clauses());
    // A new variable for each clause that the bound rests on: if it is true, the clause is false.
    for (const Int clause : rests_on_) {
      const Int selector = ++num_variables_;
      selectors_.push_back(selector);
      first_extra_.push_back(static_cast<Int>(axioms_.size() + extra_.size()) + 1);
      for (const Int lit : literals_[clause]) extra_.push_back({-selector, -lit});
    }
    extra_.push_back(selectors_);
  }

  bool write(const std::string& cnf, const std::string& lrat) const {
    std::ofstream formula(cnf), proof(lrat);
    const Int size = static_cast<Int>(axioms_.size() + extra_.size());
    formula << "p cnf " << num_variables_ << ' ' << size << '\n';
    for (const Int axiom : axioms_) line(formula, literals_.at(axiom));
    for (const Ints& clause : extra_) line(formula, clause);
    std::map<Int, Int> number;
    for (std::size_t k = 0; k < axioms_.size(); ++k) number[axioms_[k]] = static_cast<Int>(k) + 1;
    Int next = size;
    for (const auto& [clause, hints] : derived_) {
      number[clause] = ++next;
      step(proof, next, literals_.at(clause), hints, number);
    }
    Ints units;
    for (std::size_t k = 0; k < rests_on_.size(); ++k) {
      proof << ++next << ' ' << -selectors_[k] << " 0";
      for (std::size_t at = 0; at < literals_.at(rests_on_[k]).size(); ++at)
        proof << ' ' << first_extra_[k] + static_cast<Int>(at);
      proof << ' ' << number.at(rests_on_[k]) << " 0\n";
      units.push_back(next);
    }
    proof << ++next << " 0";
    for (const Int unit : units) proof << ' ' << unit;
    proof << ' ' << size << " 0\n";
    formula.flush();
    proof.flush();
    return formula.good() && proof.good();
  }

 private:
  void read(const Record& record, Int clause) {
    const auto note = [&](std::span<const Int> literals) {
      Ints sorted(literals.begin(), literals.end());
      std::sort(sorted.begin(), sorted.end());
      sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
      for (const Int lit : sorted) num_variables_ = std::max(num_variables_, std::abs(lit));
      literals_[clause] = std::move(sorted);
    };
    if (record.tag == 'a') {
      note(record.literals());
      axioms_.push_back(clause);
    } else if (record.tag == 'l') {
      note(record.derived());
      Ints hints;
      for (const Int hint : record.hints()) hints.push_back(clause - hint);
      derived_.emplace_back(clause, std::move(hints));
    } else if (record.tag == 'k') {
      rests_on_.push_back(record.values[0]);
    } else if (record.tag == 'q' && record.values[1] != 0) {
      rests_on_.push_back(record.values[1]);
    }
  }

  static void line(std::ostream& out, const Ints& clause) {
    for (const Int lit : clause) out << lit << ' ';
    out << "0\n";
  }

  /// With the hints that are used, and no others: not every checker passes over useless ones.
  void step(std::ostream& out, Int name, const Ints& clause, const Ints& hints,
            const std::map<Int, Int>& number) const {
    out << name;
    for (const Int lit : clause) out << ' ' << lit;
    out << " 0";
    for (const UsedHint& used : used_hints(clause, hints, literals_))
      out << ' ' << number.at(used.clause);
    out << " 0\n";
  }

  std::map<Int, Ints> literals_;  // by clause
  Ints axioms_, rests_on_, selectors_, first_extra_;
  std::vector<std::pair<Int, Ints>> derived_;
  std::vector<Ints> extra_;
  Int num_variables_ = 0;
};

}  // namespace

bool export_lrat(const std::string& content, const std::string& cnf, const std::string& lrat) {
  return LratExport(content).write(cnf, lrat);
}

}  // namespace quadrille_check
