// SPDX-License-Identifier: MIT
#include "answers/explanation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace quadrille::cli {
namespace {

/// Of reasons; the others are counted.
constexpr std::size_t kMaxReasons = 30;
constexpr std::size_t kMaxListedAgents = 12;

std::string pair_of(const CollisionSite& site) {
  return fmt::format("agents {} and {}", site.first.index(), site.second.index());
}

/// "at 4", "at 4 to 7", "from 4 on".
std::string describe_time(const CollisionSite& site, const Names& names) {
  if (site.end == CollisionSite::kForever) return "from " + names.cost(site.begin) + " on";
  const Cost last = names.has_timesteps ? site.end - 1 : site.end;
  if (last == site.begin) return "at " + names.cost(site.begin);
  return fmt::format("at {} to {}", names.cost(site.begin), names.cost(last));
}

/// One sentence without its full stop.
std::string describe_site(const CollisionSite& site, const Names& names) {
  const std::string from = names.vertex(site.place.from), to = names.vertex(site.place.to);
  const std::string when = describe_time(site, names);
  switch (site.place.kind) {
    case Place::Kind::vertex:
      return fmt::format("{} are both on their way through {}, {}", pair_of(site), from, when);
    case Place::Kind::edge:
      return fmt::format("{} both use the edge between {} and {}, {}", pair_of(site), from, to,
                         when);
    case Place::Kind::corridor:
      return fmt::format("{} pass the corridor between {} and {} in opposite directions, {}",
                         pair_of(site), from, to, when);
    case Place::Kind::rectangle:
      return fmt::format("{} cross each other's way in the rectangle from {} to {}, {}",
                         pair_of(site), from, to, when);
    case Place::Kind::goal:
      return fmt::format("agent {} rests at its goal {}, in the way of agent {}, {}",
                         site.second.index(), from, site.first.index(), when);
    case Place::Kind::crossing:
      break;
  }
  const Place other = site.other.value_or(site.place);
  return fmt::format("{} come too close on the edges {} to {} and {} to {}, {}", pair_of(site),
                     from, to, names.vertex(other.from), names.vertex(other.to), when);
}

std::string capitalised(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 32);
  return text;
}

/// What the agents of a reason cost alone, as its claim counts it.
Cost free_cost(const Attribution& attribution, const Reason& reason) {
  if (attribution.objective == Objective::makespan) return attribution.free_bound;
  Cost cost = 0;
  for (const AgentId i : reason.agents) cost += attribution.agents[i].free_cost;
  return cost;
}

std::string claim(const Attribution& attribution, const Reason& reason, const Names& names) {
  const Cost alone = free_cost(attribution, reason);
  const std::string who = capitalised(list_agents(reason.agents));
  if (attribution.objective == Objective::makespan)
    return fmt::format("{} cannot all arrive before {}", who, names.cost(alone + reason.amount));
  return fmt::format("{} cost at least {} together, {} if each were alone", who,
                     names.cost(alone + reason.amount), names.cost(alone));
}

Json agents_json(const std::vector<AgentId>& agents) {
  Json json = Json::array();
  for (const AgentId i : agents) json.push_back(i.index());
  return json;
}

Json place_json(const Place& place, const Names& names) {
  Json json;
  json["kind"] = to_string(place.kind);
  json["from"] = names.vertex_json(place.from);
  json["to"] = names.vertex_json(place.to);
  return json;
}

Json attribution_json(const Attribution& attribution, const Names& names) {
  Json json;
  json["free_bound"] = attribution.free_bound;
  json["lower_bound"] = attribution.lower_bound;
  json["agents"] = Json::array();
  for (const AgentCharge& charge : attribution.agents) {
    Json agent;
    agent["free_cost"] = charge.free_cost;
    agent["cost"] = or_null(charge.cost);
    json["agents"].push_back(std::move(agent));
  }
  json["raises"] = Json::array();
  for (const Raise& raise : attribution.raises) {
    Json item;
    item["kind"] = to_string(raise.kind);
    item["amount"] = raise.amount;
    item["agents"] = agents_json(raise.agents);
    item["bystanders"] = agents_json(raise.bystanders);
    json["raises"].push_back(std::move(item));
  }
  json["sites"] = Json::array();
  for (const CollisionSite& site : attribution.sites) {
    Json item;
    item["agents"] = agents_json({site.first, site.second});
    item["place"] = place_json(site.place, names);
    item["other"] = site.other ? place_json(*site.other, names) : Json(nullptr);
    item["begin"] = site.begin;
    item["end"] = site.end == CollisionSite::kForever ? Json(nullptr) : Json(site.end);
    item["lemmas"] = site.num_lemmas;
    json["sites"].push_back(std::move(item));
  }
  return json;
}

Json reasons_json(const std::vector<Reason>& reasons) {
  Json json = Json::array();
  for (const Reason& reason : reasons) {
    Json item;
    item["amount"] = reason.amount;
    item["agents"] = agents_json(reason.agents);
    item["checked"] = reason.is_checked;
    item["sites"] = reason.sites;
    json.push_back(std::move(item));
  }
  return json;
}

}  // namespace

std::optional<Limits> RemainingLimits::next(std::int64_t conflicts) const {
  Limits limits = limits_;
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin_;
  if (limits.interrupt != nullptr && limits.interrupt->load()) return std::nullopt;
  for (auto* const seconds : {&limits.wall_s, &limits.cpu_s}) {
    if (!*seconds) continue;
    **seconds -= passed.count();
    if (**seconds <= 0) return std::nullopt;
  }
  limits.conflicts = std::min(conflicts, limits.conflicts.value_or(conflicts));
  return limits;
}

std::string list_agents(const std::vector<AgentId>& agents) {
  std::string text = agents.size() == 1 ? "agent " : "agents ";
  const std::size_t shown = agents.size() <= kMaxListedAgents ? agents.size() : kMaxListedAgents;
  for (std::size_t k = 0; k < shown; ++k) {
    if (k > 0) text += k + 1 == agents.size() ? " and " : ", ";
    text += std::to_string(agents[k].index());
  }
  if (shown < agents.size()) text += fmt::format(" and {} more", agents.size() - shown);
  return text;
}

std::string describe_farther_goals(const std::vector<FartherGoal>& goals, const Names& names) {
  std::string text;
  for (std::size_t k = 0; k < goals.size() && k < kMaxListedAgents; ++k) {
    const FartherGoal& one = goals[k];
    text += fmt::format("{}agent {} takes {}, {} farther than {}, {}\n",
                        k == 0 ? "goals      " : "           ", one.agent.index(),
                        names.vertex(one.end), names.cost(one.farther), names.vertex(one.nearest),
                        one.owner ? fmt::format("because agent {} takes that", one.owner->index())
                                  : std::string("which nobody takes"));
  }
  if (goals.size() > kMaxListedAgents)
    text += fmt::format("           and {} more agents do not take their nearest goals\n",
                        goals.size() - kMaxListedAgents);
  return text;
}

std::string describe_attribution(const Attribution& attribution, const std::vector<Reason>& reasons,
                                 const Names& names, std::size_t max_sites) {
  const bool is_sum = attribution.objective == Objective::sum_of_costs;
  std::string text =
      fmt::format("bound      {} = {} {} + {}\n", names.cost(attribution.lower_bound),
                  names.cost(attribution.free_bound),
                  is_sum ? "that the agents cost alone" : "that one agent needs alone",
                  names.cost(attribution.lower_bound - attribution.free_bound));
  const std::size_t shown = std::min(kMaxReasons, reasons.size());
  for (std::size_t k = 0; k < shown; ++k) {
    const Reason& reason = reasons[k];
    text += fmt::format("because {:>2} +{}: {}{}.\n", k + 1, names.cost(reason.amount),
                        claim(attribution, reason, names),
                        reason.is_checked ? ", as a search of these alone shows" : "");
    for (std::size_t s = 0; s < std::min(max_sites, reason.sites.size()); ++s)
      text += fmt::format("           {}.\n",
                          capitalised(describe_site(attribution.sites[reason.sites[s]], names)));
    if (reason.sites.size() > max_sites)
      text += fmt::format("           And {} more places and times.\n",
                          reason.sites.size() - max_sites);
  }
  if (shown < reasons.size())
    text += fmt::format("           And {} more reasons.\n", reasons.size() - shown);
  return text;
}

void add_explanation(ResultJson& result, const std::optional<Attribution>& attribution,
                     const std::vector<Reason>& reasons, const Names& names) {
  result.add("attribution", attribution ? attribution_json(*attribution, names) : Json(nullptr));
  result.add("reasons", reasons_json(reasons));
}

}  // namespace quadrille::cli
