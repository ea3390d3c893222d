// SPDX-License-Identifier: MIT
#include "certificate/certify.hpp"

#include <utility>
#include <vector>

#include "certificate/place_number.hpp"

namespace quadrille::discrete {

sat::TrimmedProof free_proof(Cost bound) {
  sat::CertificateWriter writer;
  writer.record('q', {bound, 0});
  return {bound, std::move(writer.text())};
}

Certificate certify(const Instance& instance, Objective objective, const sat::TrimmedProof& proof,
                    const std::optional<Plan>& plan) {
  sat::CertificateWriter head, tail;
  head.record('i', {static_cast<std::int64_t>(instance.num_agents()),
                    objective == Objective::makespan ? 1 : 0});
  if (plan)
    for (const AgentId i : instance.agent_ids()) {
      std::vector<std::int64_t> values{static_cast<std::int64_t>(i.value())};
      for (const VertexId v : plan->paths[i]) values.push_back(place_number(instance.graph(), v));
      tail.record('p', values);
    }
  return {proof.claim, "qcert 1 bin\n" + head.text() + proof.records + tail.text()};
}

}  // namespace quadrille::discrete
