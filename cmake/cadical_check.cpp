// SPDX-License-Identifier: MIT
// Compiled by FindCaDiCaL.cmake: all that sat/src/engine/engine.cpp uses of CaDiCaL, so that a
// library that is found is one that the engine compiles with. tests/setup/cadical_test compares the
// two files.
#include <cadical.hpp>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "derivation_tracer.hpp"
#include "derived_clause_tracer.hpp"

namespace {

struct Callbacks final : CaDiCaL::ExternalPropagator, CaDiCaL::Terminator, CaDiCaL::Learner {
  Callbacks() { are_reasons_forgettable = true; }
  void notify_assignment(const std::vector<int>&) override {}
  void notify_new_decision_level() override {}
  void notify_backtrack(std::size_t) override {}
  bool cb_check_found_model(const std::vector<int>&) override { return true; }
  int cb_propagate() override { return 0; }
  int cb_decide() override { return 0; }
  int cb_add_reason_clause_lit(int) override { return 0; }
  bool cb_has_external_clause(bool& forgettable) override { return forgettable = false; }
  int cb_add_external_clause_lit() override { return 0; }
  bool terminate() override { return false; }
  bool learning(int) override { return false; }
  void learn(int) override {}
};

struct Receiver {
  void given(std::uint64_t, const std::vector<int>&) {}
  void derived(std::uint64_t, const std::vector<int>&, const std::vector<std::uint64_t>&) {}
  void refuted(std::uint64_t, const std::vector<int>&, const std::vector<std::uint64_t>&) {
    has_refuted = true;
  }
  bool has_refuted = false;
};

}  // namespace

int main() {
  Callbacks callbacks;
  quadrille::sat::DerivedClauseTracer tracer([](const std::vector<int>&) {});
  Receiver receiver;
  quadrille::sat::DerivationTracer<Receiver> derivations(receiver);
  CaDiCaL::Solver solver;
  bool known = solver.configure("plain");
  // Options that the engine sets: an answer of 1 is for the test, which runs this with each
  // version.
  for (const char* option : {"quiet", "seed", "ilb", "walk", "lucky", "phase", "exteagerreasons",
                             "exteagerrecalc", "chrono", "chronolevelim", "bumpreason"})
    known = solver.set(option, 0) && known;
  solver.connect_terminator(&callbacks);
  solver.connect_learner(&callbacks);
  solver.connect_proof_tracer(&tracer, false);
  solver.connect_proof_tracer(&derivations, true);
  solver.connect_external_propagator(&callbacks);
  solver.add_observed_var(1);
  solver.phase(1);
  solver.unphase(1);
  solver.add(1);
  solver.add(0);
  solver.assume(-1);
  known = solver.limit("conflicts", 1) && solver.limit("decisions", 1) && known;
  bool right = solver.solve() == 20 && solver.failed(-1) && receiver.has_refuted;
  right = solver.solve() == 10 && solver.val(1) > 0 && right;
  solver.reset_assumptions();
  solver.disconnect_external_propagator();
  solver.disconnect_proof_tracer(&tracer);
  solver.disconnect_proof_tracer(&derivations);
  solver.disconnect_learner();
  solver.disconnect_terminator();
  return known && right ? 0 : 1;
}
