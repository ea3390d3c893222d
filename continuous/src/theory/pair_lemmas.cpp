// SPDX-License-Identifier: MIT
#include "theory/pair_lemmas.hpp"

#include <algorithm>

namespace quadrille::continuous {
namespace {

/// What can still be multiplied.
constexpr Effort kMost = Effort::nanoseconds(std::int64_t{1} << 45);
/// Of the move by which caps are raised at most.
constexpr std::int64_t kSmallPart = 64;

PairSearch::Party searched(const PairLemmas::Party& party) {
  return {party.agent, as_ticks(party.cap)};
}

}  // namespace

bool PairLemmas::note_collision(const Party& i, const Party& j, FormulaWriter& writer) {
  return note(collisions_[{i.agent, j.agent}], in_time(i), in_time(j), writer);
}

bool PairLemmas::note_explanation(const Party& i, const Party& j, FormulaWriter& writer) {
  return note(explanations_[{i.agent, j.agent}], in_time(i), in_time(j), writer);
}

PairLemmas::Party PairLemmas::in_time(Party party) const {
  if (const auto& deadline = model_.instance().agent(party.agent).deadline)
    party.cap = std::min(party.cap, as_cost(*deadline));
  return party;
}

// Searches that refute something do not count as waste: they would keep the next one waiting, while
// the same two collide without end. After a refutation every other collision becomes clauses: where
// the two have no plan at all, caps would rise for ever, and clauses may prove it.
bool PairLemmas::note(Record& record, const Party& i, const Party& j, FormulaWriter& writer) {
  if (scope_ == Scope::none || (scope_ == Scope::proven && !record.is_proven)) return false;
  if (has_choice(i.agent) || has_choice(j.agent)) return false;
  if (++record.count < std::max(record.next_try, settings_.pair_first_try)) return false;
  if (i.cap >= kAnyCost || j.cap >= kAnyCost) return false;
  if (wasted_ >
      Effort::microseconds(settings_.pair_waste) + path_effort_ / settings_.pair_path_part)
    return false;
  if (record.effort == Effort()) record.effort = Effort::microseconds(settings_.pair_effort);
  most_ = record.effort;
  search_.set_width(kForever);
  const Effort before = search_effort();
  const bool is_added = try_pair(record, i, j, writer);
  if (!is_added) wasted_ += search_effort() - before;
  record.is_proven = is_added;
  const std::pair caps{i.cap, j.cap};
  if (!is_added || record.refuted == caps)
    record.next_try = (is_added ? settings_.pair_again : 2) * record.count;
  else
    record.next_try = record.count + 2;
  if (is_added) record.refuted = caps;
  if (!is_added) record.effort = std::min(settings_.pair_more * record.effort, kMost);
  return is_added;
}

bool PairLemmas::has_choice(AgentId i) const {
  return !model_.instance().agent(i).goals.is_single();
}

bool PairLemmas::try_pair(Record& record, const Party& i, const Party& j, FormulaWriter& writer) {
  for (const std::size_t side : {0U, 1U}) {
    search_.bans(side).clear(model_.standing_bans((side == 0 ? i : j).agent));
    loaded_[side].clear();
  }
  const bool is_open = std::any_of(record.open.begin(), record.open.end(), [&](const auto& caps) {
    return i.cap >= caps.first && j.cap >= caps.second;
  });
  if (is_open || !refute(i, j)) {
    if (!is_open) record.open.emplace_back(i.cap, j.cap);
    load(i, j.agent, 0);
    load(j, i.agent, 1);
    if (!refute(i, j)) return false;
    reduce(i, j);
  }
  add_clauses(i, j, writer);
  return true;
}

bool PairLemmas::is_refuted(const Party& i, const Party& j) {
  const Effort before = search_effort();
  const bool is_refuted = search_.refuted_raise(searched(i), searched(j), 0, most_ / kStep) > 0;
  if (is_refuted) refutation_ = search_effort() - before;
  return is_refuted;
}

bool PairLemmas::refute(const Party& i, const Party& j) {
  while (true) {
    const Effort before = search_effort();
    if (is_refuted(i, j)) return true;
    const bool is_long = search_effort() - before >= most_ / settings_.pair_half_part;
    if (is_long || search_.width() <= passing_time(i.agent, j.agent)) return false;
    search_.set_width(search_.width() / 2);
  }
}

Ticks PairLemmas::passing_time(AgentId i, AgentId j) {
  const Instance& instance = model_.instance();
  Ticks least = kForever;
  for (const auto& [mover, stander] : {std::pair{i, j}, std::pair{j, i}}) {
    const ClassId c = instance.class_of(mover), d = instance.class_of(stander);
    for (const EdgeId e : instance.out_edges(c, instance.agent(mover).start)) {
      const VertexId to = instance.roadmap().to(e);
      if (const auto w = model_.scene().contacts().window(c, e, d, to))
        least = std::min(least, w->end - w->begin);
    }
  }
  return std::max(least, Ticks{1});
}

Effort PairLemmas::effort_for_more() const {
  return std::max(std::min(settings_.pair_raise_share * most_,
                           Effort::microseconds(settings_.pair_raise_effort)),
                  settings_.pair_raise_share * refutation_);
}

void PairLemmas::load(const Party& party, AgentId other, std::size_t side) {
  for (const ObstacleId id : party.active) {
    const Obstacle& obstacle = model_.obstacles()[id];
    const auto& partners = obstacle.partners;
    if (std::find(partners.begin(), partners.end(), other) != partners.end()) continue;
    loaded_[side].push_back(id);
    search_.bans(side).add(obstacle.bans);
  }
}

void PairLemmas::reduce(const Party& i, const Party& j) {
  const Effort last = search_effort() + effort_for_more();
  most_ = std::max({most_, Effort::microseconds(settings_.pair_test_effort),
                    settings_.pair_test_share * refutation_});
  struct Slot {
    std::size_t side, slot;
  };
  std::vector<Slot> slots;
  for (const std::size_t side : {0U, 1U})
    for (std::size_t slot = 0; slot < loaded_[side].size(); ++slot) slots.push_back({side, slot});
  const auto enable = [&](std::size_t from, std::size_t to, bool on) {
    for (std::size_t k = from; k < to; ++k) search_.bans(slots[k].side).enable(slots[k].slot, on);
  };
  for (std::size_t chunk = std::max<std::size_t>(slots.size() / 2, 1); !slots.empty(); chunk /= 2) {
    for (std::size_t at = 0; at < slots.size();) {
      if (search_effort() > last) return;
      const std::size_t end = std::min(at + chunk, slots.size());
      enable(at, end, false);
      if (refute(i, j)) {
        slots.erase(slots.begin() + static_cast<std::ptrdiff_t>(at),
                    slots.begin() + static_cast<std::ptrdiff_t>(end));
      } else {
        enable(at, end, true);
        at = end;
      }
    }
    if (chunk == 1) break;
  }
}

// Raising one cap may leave no room for the other: then a second clause raises the other one first.
void PairLemmas::add_clauses(const Party& i, const Party& j, FormulaWriter& writer) {
  PairSearch::Party first = searched(i), second = searched(j);
  raise(first, second, false);
  raise(second, first, true);
  add_clause(first, second, writer);
  if (second.cap - as_ticks(j.cap) >= max_raise(j.agent) / kSmallPart) return;
  PairSearch::Party other_first = searched(i), other_second = searched(j);
  raise(other_second, other_first, true);
  raise(other_first, other_second, false);
  if (other_second.cap > second.cap) add_clause(other_first, other_second, writer);
}

void PairLemmas::raise(PairSearch::Party& party, const PairSearch::Party& other, bool is_second) {
  if (is_second) search_.swap_bans();
  const Ticks most = max_raise(party.agent);
  const auto refuted = [&](Ticks tried) {
    return search_.refuted_raise(party, other, tried, effort_for_more() / kStep);
  };
  const Ticks tried = most / settings_.pair_first_raise;
  Ticks raise = refuted(tried);
  if (raise > tried) raise = std::max(raise, refuted(most));
  if (is_second) search_.swap_bans();
  party.cap += std::max<Ticks>(raise, 1) - 1;  // one tick is what is refuted anyway
}

void PairLemmas::add_clause(const PairSearch::Party& i, const PairSearch::Party& j,
                            FormulaWriter& writer) {
  std::vector<sat::Lit> clause{model_.at_least(i.agent, as_cost(i.cap + 1), writer),
                               model_.at_least(j.agent, as_cost(j.cap + 1), writer)};
  std::vector<sat::Usage> usages;
  for (const std::size_t side : {0U, 1U})
    for (std::size_t slot = 0; slot < loaded_[side].size(); ++slot) {
      if (!search_.bans(side).is_enabled(slot)) continue;
      const Obstacle& obstacle = model_.obstacles()[loaded_[side][slot]];
      usages.push_back({obstacle.agent, loaded_[side][slot].value()});
      if (std::find(clause.begin(), clause.end(), obstacle.allowed) == clause.end())
        clause.push_back(obstacle.allowed);
    }
  writer.add({sat::why::Pair{i.agent, j.agent}, clause, usages, false});
}

/// About one move, as a way round it often costs as much.
Ticks PairLemmas::max_raise(AgentId i) const {
  const Instance& instance = model_.instance();
  Ticks longest = 1;
  for (const EdgeId e : instance.out_edges(instance.class_of(i), instance.agent(i).start))
    longest = std::max(longest, instance.duration(instance.class_of(i), e));
  return longest;
}

}  // namespace quadrille::continuous
