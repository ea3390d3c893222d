// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "read/basics.hpp"

namespace quadrille_check {

/// One record of a certificate, docs/certificates.md. The values are those of the binary form:
///     a   rule, number of parameters, parameters, literals
///     l   number of literals, literals, for each hint how many clauses before this one it is
struct Record {
  char tag = 0;
  Ints values;

  /// Of an axiom. Throw Rejected if the record is too short for them.
  [[nodiscard]] std::span<const Int> parameters() const;
  [[nodiscard]] std::span<const Int> literals() const;
  /// Of a derived clause.
  [[nodiscard]] std::span<const Int> derived() const;
  [[nodiscard]] std::span<const Int> hints() const;

  /// A line of the text form. `clause`: the number of the clause, if the record is one.
  [[nodiscard]] std::string text(Int clause) const;

 private:
  [[nodiscard]] std::span<const Int> part(std::size_t begin, Int count) const;
};

/// Reads a certificate record by record, in its binary or its text form.
class RecordReader {
 public:
  explicit RecordReader(std::string content);  ///< Throws Rejected if it is no certificate.
  /// False at the end. Throws Rejected.
  [[nodiscard]] bool next(Record& record);
  /// How many were read.
  [[nodiscard]] Int number() const { return number_; }
  [[nodiscard]] Int num_clauses() const { return num_clauses_; }

 private:
  [[nodiscard]] bool next_binary(Record& record);
  [[nodiscard]] bool next_line(Record& record);
  void read_fields(const std::string& line, Record& record) const;
  [[nodiscard]] std::uint64_t unsigned_number();

  const std::string content_;
  std::size_t at_ = 0;
  bool is_text_ = false;
  Int number_ = 0, num_clauses_ = 0;
};

}  // namespace quadrille_check
