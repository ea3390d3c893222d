// SPDX-License-Identifier: MIT
#include "theory/encounters.hpp"

#include <algorithm>
#include <utility>

#include "quadrille/core/contract.hpp"

namespace quadrille::continuous {
namespace {

/// Whether starts add much to a set of bans: none before tick 0 does.
bool is_worth_a_ban(const TickInterval& starts, Ticks min_length) {
  return !starts.is_empty() && starts.length() >= min_length && starts.end > 0;
}

}  // namespace

std::vector<ObstacleId> EncounterClauses::exclude(const Encounter& encounter, Ticks stay_i,
                                                  Ticks stay_j, FormulaWriter& writer) {
  const Instance& instance = model_.instance();
  const Party i{encounter.first, instance.class_of(encounter.first)};
  const Party j{encounter.second, instance.class_of(encounter.second)};
  if (encounter.a.is_move && encounter.b.is_move)
    return exclude_moves(i, encounter.a, j, encounter.b, writer);
  if (encounter.a.is_move) return exclude_stay(i, encounter.a, j, encounter.b, stay_j, writer);
  return exclude_stay(j, encounter.b, i, encounter.a, stay_i, writer);
}

// Every start of e in [s, t - lo] collides with every start of f in [t, s + hi], where lo and hi
// are the first and the last unsafe offset: those of the corners are t - (t - lo) = lo and (s + hi)
// - s = hi, and the others are between them.
std::vector<ObstacleId> EncounterClauses::exclude_moves(Party i, const Step& a, Party j,
                                                        const Step& b, FormulaWriter& writer) {
  const auto offsets = model_.contacts().offsets(i.c, a.edge, j.c, b.edge);
  QUADRILLE_REQUIRE(offsets.has_value(), "the moves collide");
  const Ticks s = a.begin, t = b.begin;
  std::vector<Ban> bans_i{Ban::start(a.edge, {s, starts_before(*offsets, t).end})};
  std::vector<Ban> bans_j{Ban::start(b.edge, {t, starts_against(*offsets, s).end})};
  lift(i, bans_i, j, bans_j[0].when.length() / 2, bans_j);
  lift(j, bans_j, i, bans_i[0].when.length() / 2, bans_i);
  return add_pair(i.agent, std::move(bans_i), j.agent, std::move(bans_j), sat::why::Moves{},
                  writer);
}

// What collides with all bans of a together is what collides with each of them.
void EncounterClauses::lift(Party a, std::span<const Ban> bans_of_a, Party b, Ticks min_length,
                            std::vector<Ban>& bans_of_b) {
  const EdgeId known(bans_of_b.front().place);
  const auto& near = model_.contacts().near_edge(a.c, EdgeId(bans_of_a.front().place), b.c);
  for (const EdgeId f : near.edges) {
    if (f == known) continue;
    TickInterval starts{-kForever, kForever};
    for (const Ban& ban : bans_of_a) {
      const auto& offsets = model_.contacts().offsets(a.c, EdgeId(ban.place), b.c, f);
      if (!offsets) {
        starts = {};
        break;
      }
      const TickInterval hit = starts_against_all(*offsets, ban.when);
      starts = {std::max(starts.begin, hit.begin), std::min(starts.end, hit.end)};
      if (starts.length() < min_length) break;
    }
    if (is_worth_a_ban(starts, min_length)) bans_of_b.push_back(Ban::start(f, starts));
  }
}

void EncounterClauses::lift_over_stay(Party a, Party b, const Ban& stay, Ticks min_length,
                                      std::vector<Ban>& bans_of_a) {
  const VertexId v(stay.place);
  const EdgeId known(bans_of_a.front().place);
  for (const EdgeId e : model_.contacts().near_vertex(b.c, v, a.c).edges) {
    if (e == known) continue;
    const auto& window = model_.contacts().window(a.c, e, b.c, v);
    if (!window) continue;
    const TickInterval starts = starts_meeting_all(*window, stay.when);
    if (is_worth_a_ban(starts, min_length)) bans_of_a.push_back(Ban::start(e, starts));
  }
}

std::vector<ObstacleId> EncounterClauses::exclude_stay(Party mover, const Step& move, Party stander,
                                                       const Step& stay, Ticks final_from,
                                                       FormulaWriter& writer) {
  const auto window = model_.contacts().window(mover.c, move.edge, stander.c, stay.vertex);
  QUADRILLE_REQUIRE(window.has_value(), "the move meets the stay");
  const TickInterval contact = window->shifted(move.begin);
  if (stay.end == kForever && final_from < contact.end) {
    // Whoever stays for good before the contact ends is in the way of this move; see keep_off_goal.
    bool is_new = false;
    const ObstacleId id =
        model_.keep_off_goal(mover.agent, stander.agent, stay.vertex, contact.end, writer, is_new);
    if (is_new) add_price(id, writer);
    return {id};
  }
  // Any `from` before the departure gives a sound pair: all starts of the mover's ban are in
  // contact during all of the stander's. It is chosen half-way through the contact.
  const Ticks middle = contact.begin + contact.length() / 2;
  const Ticks depart = stay.end == kForever ? contact.end : stay.end;
  const Ticks from = std::min({depart - 1, contact.end - 1, std::max(stay.begin, middle)});
  const Ban ban_stander = Ban::stay(stay.vertex, {from, contact.end});
  const TickInterval starts{move.begin, starts_meeting_all(*window, ban_stander.when).end};
  std::vector<Ban> bans_mover{Ban::start(move.edge, starts)};
  lift_over_stay(mover, stander, ban_stander, starts.length() / 4, bans_mover);
  return add_pair(mover.agent, std::move(bans_mover), stander.agent, {ban_stander},
                  sat::why::Stay{}, writer);
}

std::vector<ObstacleId> EncounterClauses::exclude_ends(const End& i, const End& j,
                                                       FormulaWriter& writer) {
  return add_pair(i.agent, {Ban::end(i.goal)}, j.agent, {Ban::end(j.goal)}, sat::why::Goal{j.agent},
                  writer);
}

std::vector<ObstacleId> EncounterClauses::add_pair(AgentId i, std::vector<Ban> bans_i, AgentId j,
                                                   std::vector<Ban> bans_j, const sat::Why& why,
                                                   FormulaWriter& writer) {
  bool is_new_i = false, is_new_j = false;
  const ObstacleId a = model_.usage(i, std::move(bans_i), j, writer, is_new_i);
  const ObstacleId b = model_.usage(j, std::move(bans_j), i, writer, is_new_j);
  const sat::Lit clause[] = {~model_.obstacles()[a].allowed, ~model_.obstacles()[b].allowed};
  const sat::Usage usages[] = {{i, a.value()}, {j, b.value()}};
  writer.add({why, clause, usages, false});
  if (is_new_i) add_price(a, writer);
  if (is_new_j) add_price(b, writer);
  return {a, b};
}

// The path lemma whose only usage is this one.
void EncounterClauses::add_price(ObstacleId id, FormulaWriter& writer) {
  const AgentId i = model_.obstacles()[id].agent;
  bans_.clear(model_.standing_bans(i));
  bans_.add(model_.obstacles()[id].bans);
  const auto arrival = finder_.find(model_.task(i), bans_, kForever, nullptr);
  if (arrival && as_cost(*arrival) <= model_.free_cost(i)) return;
  std::vector<sat::Lit> clause{model_.obstacles()[id].allowed};
  if (arrival) clause.push_back(model_.at_least(i, as_cost(*arrival), writer));
  const sat::Usage usages[] = {{i, id.value()}};
  writer.add({sat::why::Path{i}, clause, usages, false});
}

}  // namespace quadrille::continuous
