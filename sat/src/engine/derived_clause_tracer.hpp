// SPDX-License-Identifier: MIT
#pragma once
#include <cadical.hpp>
#include <functional>
#include <tracer.hpp>
#include <tuple>
#include <utility>
#include <vector>

namespace quadrille::sat {

/// Hands on each clause that CaDiCaL derives.
///
/// What CaDiCaL tells besides differs: 2.1 has (number, redundant, clause, antecedents), 2.2 a
/// witness before the clause, and signed numbers. The parameters are therefore those of the header
/// at hand, and the clause is found among them by its type.
///
/// cmake/cadical_check.cpp includes this file, too, and has nothing else of this project: so does
/// this one.
template <class Member>
class DerivedClauseTracerOf;

template <class... Parameters>
class DerivedClauseTracerOf<void (CaDiCaL::Tracer::*)(Parameters...)> final
    : public CaDiCaL::Tracer {
 public:
  using Clause = std::vector<int>;
  /// `receive` must not throw: CaDiCaL's state is lost when an exception passes through it.
  explicit DerivedClauseTracerOf(std::function<void(const Clause&)> receive)
      : receive_(std::move(receive)) {}
  void add_derived_clause(Parameters... parameters) override {
    receive_(std::get<const Clause&>(std::tuple<Parameters...>(parameters...)));
  }

 private:
  std::function<void(const Clause&)> receive_;
};

using DerivedClauseTracer = DerivedClauseTracerOf<decltype(&CaDiCaL::Tracer::add_derived_clause)>;

}  // namespace quadrille::sat
