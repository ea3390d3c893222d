// SPDX-License-Identifier: MIT
#include "quadrille/sat/certificate.hpp"

namespace quadrille::sat {

void CertificateWriter::put(std::uint64_t value) {
  for (; value >= 128; value >>= 7) text_.push_back(static_cast<char>(value | 128));
  text_.push_back(static_cast<char>(value));
}

void CertificateWriter::put_signed(std::int64_t value) {
  put(static_cast<std::uint64_t>(value) << 1 ^ static_cast<std::uint64_t>(value >> 63));
}

void CertificateWriter::record(char tag, Integers values) {
  text_.push_back(tag);
  put(values.size());
  for (const std::int64_t value : values) put_signed(value);
}

CertificateWriter::ClauseNumber CertificateWriter::axiom(int rule, Integers parameters,
                                                         std::span<const Lit> clause) {
  text_.push_back('a');
  put(2 + parameters.size() + clause.size());
  put_signed(rule);
  put_signed(static_cast<std::int64_t>(parameters.size()));
  for (const std::int64_t value : parameters) put_signed(value);
  for (const Lit lit : clause) put_signed(number(lit));
  return ++num_clauses_;
}

CertificateWriter::ClauseNumber CertificateWriter::derived(std::span<const Lit> clause,
                                                           std::span<const ClauseNumber> hints) {
  ++num_clauses_;
  text_.push_back('l');
  put(1 + clause.size() + hints.size());
  put_signed(static_cast<std::int64_t>(clause.size()));
  for (const Lit lit : clause) put_signed(number(lit));
  for (const ClauseNumber hint : hints) put_signed(num_clauses_ - hint);
  return num_clauses_;
}

}  // namespace quadrille::sat
