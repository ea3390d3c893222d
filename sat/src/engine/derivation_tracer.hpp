// SPDX-License-Identifier: MIT
#pragma once
#include <cadical.hpp>
#include <cstdint>
#include <tracer.hpp>
#include <tuple>
#include <utility>
#include <vector>

namespace quadrille::sat {

/// Hands on each clause that CaDiCaL is given or derives, and each refutation of assumptions, with
/// their numbers and antecedents. To be connected with antecedents.
///
/// `Receiver` has given(number, clause), derived(number, clause, antecedents) and refuted(number,
/// clause, antecedents), which must not throw: CaDiCaL's state is lost when an exception passes
/// through it. Numbers are std::uint64_t, clauses std::vector<int>.
///
/// As derived_clause_tracer.hpp says, what CaDiCaL tells besides differs from version to version,
/// in order and type: what is wanted is found by its type. cmake/cadical_check.cpp includes this
/// file, too, and has nothing else of this project: so does this one.
template <class Receiver, class Given, class Derived, class Refuted>
class DerivationTracerOf;

template <class Receiver, class... Given, class... Derived, class... Refuted>
class DerivationTracerOf<Receiver, void (CaDiCaL::Tracer::*)(Given...),
                         void (CaDiCaL::Tracer::*)(Derived...),
                         void (CaDiCaL::Tracer::*)(Refuted...)>
    final : public CaDiCaL::Tracer {
 public:
  using Clause = std::vector<int>;
  explicit DerivationTracerOf(Receiver& receiver) : receiver_(receiver) {}

  void add_original_clause(Given... parameters) override {
    const std::tuple<Given...> told(parameters...);
    const bool is_restored = std::get<sizeof...(Given) - 1>(told);  // it has its number already
    if (!is_restored) receiver_.given(number(told), std::get<const Clause&>(told));
  }
  void add_derived_clause(Derived... parameters) override {
    const std::tuple<Derived...> told(parameters...);
    receiver_.derived(number(told), std::get<const Clause&>(told), antecedents(told));
  }
  void add_assumption_clause(Refuted... parameters) override {
    const std::tuple<Refuted...> told(parameters...);
    receiver_.refuted(number(told), std::get<const Clause&>(told), antecedents(told));
  }

 private:
  template <class Told>
  static std::uint64_t number(const Told& told) {
    return static_cast<std::uint64_t>(std::get<0>(told));
  }
  template <class Number, class... Others>
  const std::vector<std::uint64_t>& antecedents(const std::tuple<Number, Others...>& told) {
    antecedents_.clear();
    for (const Number antecedent : std::get<const std::vector<Number>&>(told))
      antecedents_.push_back(static_cast<std::uint64_t>(antecedent));
    return antecedents_;
  }

  Receiver& receiver_;
  std::vector<std::uint64_t> antecedents_;
};

template <class Receiver>
using DerivationTracer =
    DerivationTracerOf<Receiver, decltype(&CaDiCaL::Tracer::add_original_clause),
                       decltype(&CaDiCaL::Tracer::add_derived_clause),
                       decltype(&CaDiCaL::Tracer::add_assumption_clause)>;

}  // namespace quadrille::sat
