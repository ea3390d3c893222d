// SPDX-License-Identifier: MIT
#include "certificate/certify.hpp"

#include <utility>
#include <vector>

#include "certificate/records.hpp"

namespace quadrille::discrete {

sat::TrimmedProof free_proof(Cost bound) {
  sat::CertificateWriter writer;
  writer.record('q', {bound, 0});
  return {bound, std::move(writer.text())};
}

namespace {

constexpr const char* kForm = "qcert 1 bin\n";

void write_head(const Instance& instance, Objective objective, sat::CertificateWriter& writer) {
  writer.record('i', {static_cast<std::int64_t>(instance.num_agents()),
                      objective == Objective::makespan ? 1 : 0});
}

}  // namespace

// The numbers of the kinds in the file, and what comes before the places.
Certificate certify_infeasible(const Instance& instance, Objective objective,
                               const Invariant& invariant) {
  using Kind = Invariant::Kind;
  const auto place = [&](VertexId v) { return place_number(instance.graph(), v); };
  sat::CertificateWriter writer;
  write_head(instance, objective, writer);
  const bool has_agent = invariant.kind != Kind::cycle && invariant.kind != Kind::parity;
  std::vector<std::int64_t> values{static_cast<std::int64_t>(invariant.kind)};
  if (has_agent) values.push_back(sat::ProofMeanings::agent_number(*invariant.agent));
  if (invariant.kind == Kind::corridor)
    values.push_back(invariant.beyond ? place(*invariant.beyond) : -1);
  for (const VertexId v : invariant.vertices) values.push_back(place(v));
  writer.record('z', values);
  return {std::nullopt, kForm + writer.text()};
}

Certificate certify(const Instance& instance, Objective objective, const sat::TrimmedProof& proof,
                    const std::optional<Plan>& plan) {
  sat::CertificateWriter head, tail;
  write_head(instance, objective, head);
  if (plan)
    for (const AgentId i : instance.agent_ids()) {
      std::vector<std::int64_t> values{static_cast<std::int64_t>(i.value())};
      for (const VertexId v : plan->paths[i]) values.push_back(place_number(instance.graph(), v));
      tail.record('p', values);
    }
  return {proof.claim, kForm + head.text() + proof.records + tail.text()};
}

}  // namespace quadrille::discrete
