// SPDX-License-Identifier: MIT
#include "pair_lemmas.hpp"

#include <algorithm>

namespace quadrille::continuous {
namespace {

constexpr std::size_t kMaxPairs = 3'000'000;

}  // namespace

bool PairLemmas::note_collision(Party i, Party j, FormulaWriter& writer) {
  Record& record = records_[{i.agent, j.agent}];
  if (++record.collisions < record.next_try || i.cap >= kForever || j.cap >= kForever) return false;
  if (std::any_of(record.open.begin(), record.open.end(), [&](const auto& caps) {
        return i.cap >= caps.first && j.cap >= caps.second;
      }))
    return false;
  record.next_try = 2 * record.collisions;
  const Cost raise = search_.refuted_raise(i, j, max_raise(i.agent), kMaxPairs);
  if (getenv("QDBG")) fprintf(stderr, "P %zu +%lld %zu +%lld: %lld effort %lld\n", i.agent.index(), (long long)(i.cap - model_.free_cost(i.agent)), j.agent.index(), (long long)(j.cap - model_.free_cost(j.agent)), (long long)raise, (long long)search_.effort());
  if (raise == 0) {
    record.open.emplace_back(i.cap, j.cap);
    return false;
  }
  record.next_try = record.collisions + 1;
  i.cap += raise - 1;
  const Cost raise_j = search_.refuted_raise(j, i, max_raise(j.agent), kMaxPairs);
  j.cap += std::max<Cost>(raise_j, 1) - 1;
  if (getenv("QDBG")) fprintf(stderr, "PP %zu +%lld %zu +%lld: effort %lld\n", i.agent.index(), (long long)(i.cap - model_.free_cost(i.agent)), j.agent.index(), (long long)(j.cap - model_.free_cost(j.agent)), (long long)search_.effort());
  const sat::Lit clause[] = {model_.at_least(i.agent, i.cap + 1, writer),
                             model_.at_least(j.agent, j.cap + 1, writer)};
  writer.add({sat::LemmaKind::collision, clause, {}, false});
  return true;
}

/// About one move, as a way round it often costs as much.
Cost PairLemmas::max_raise(AgentId i) const {
  const Instance& instance = model_.instance();
  Cost longest = 1;
  for (const EdgeId e : instance.roadmap().out_edges(instance.agent(i).start))
    longest = std::max(longest, instance.duration(instance.class_of(i), e));
  return longest;
}

}  // namespace quadrille::continuous
