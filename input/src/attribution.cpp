// SPDX-License-Identifier: MIT
#include "quadrille/input/attribution.hpp"

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "member.hpp"
#include "quadrille/core/stated_outcome.hpp"
#include "quadrille/text/text_input.hpp"

namespace quadrille::input {
namespace {

using text::Checker;
using text::Document;
using Node = Document::Node;

class AttributionReader {
 public:
  AttributionReader(const Document& document, Checker& check, std::size_t num_agents,
                    const ReadVertex& read_vertex)
      : document_(document), check_(check), num_agents_(num_agents), read_vertex_(read_vertex) {}

  bool read(Node node, Attribution& attribution) {
    std::optional<Node> free_bound, lower_bound, agents, raises, sites;
    std::vector<AgentCharge> charges;
    const bool is_read =
        check_.members(node, {{"free_bound", &free_bound},
                              {"lower_bound", &lower_bound},
                              {"agents", &agents},
                              {"raises", &raises},
                              {"sites", &sites}}) &&
        check_.integer(*free_bound, 0, INT64_MAX, attribution.free_bound) &&
        check_.integer(*lower_bound, attribution.free_bound, INT64_MAX, attribution.lower_bound) &&
        check_.array(*agents, "agents", num_agents_) &&
        read_list(*agents, "agents", charges,
                  [this](Node n, AgentCharge& charge) { return read_charge(n, charge); }) &&
        read_list(*raises, "raises", attribution.raises,
                  [this](Node n, Raise& raise) { return read_raise(n, raise); }) &&
        sums_up(*raises, attribution) &&
        read_list(*sites, "sites", attribution.sites,
                  [this](Node n, CollisionSite& site) { return read_site(n, site); });
    attribution.agents = IdVector<AgentId, AgentCharge>(std::move(charges));
    return is_read;
  }

 private:
  template <class Item, class ReadItem>
  bool read_list(Node list, std::string_view what, std::vector<Item>& items,
                 const ReadItem& read_item) {
    if (!check_.array(list, what)) return false;
    for (Node n = document_.first(list); n < document_.next(list); n = document_.next(n)) {
      items.emplace_back();
      if (!read_item(n, items.back())) return false;
    }
    return true;
  }

  bool read_charge(Node node, AgentCharge& charge) {
    std::optional<Node> free_cost, cost;
    return check_.members(node, {{"free_cost", &free_cost}, {"cost", &cost}}) &&
           check_.integer(*free_cost, 0, INT64_MAX, charge.free_cost) &&
           (is_null(*cost) || check_.integer(*cost, 0, INT64_MAX, charge.cost.emplace()));
  }

  bool read_raise(Node node, Raise& raise) {
    std::optional<Node> kind, amount, agents, bystanders;
    return check_.members(node, {{"kind", &kind},
                                 {"amount", &amount},
                                 {"agents", &agents},
                                 {"bystanders", &bystanders}}) &&
           read_kind(*kind,
                     {RaiseKind::core, RaiseKind::cover, RaiseKind::search, RaiseKind::total},
                     raise.kind) &&
           check_.integer(*amount, 1, INT64_MAX, raise.amount) &&
           read_agents(*agents, raise.agents) && read_agents(*bystanders, raise.bystanders);
  }

  bool sums_up(Node raises, const Attribution& attribution) {
    Cost missing = attribution.lower_bound - attribution.free_bound;
    for (const Raise& raise : attribution.raises)
      if (raise.amount > missing)
        return check_.fail(raises, "these are more than the lower bound is above the free bound");
      else
        missing -= raise.amount;
    return missing == 0 || check_.fail(raises, "the lower bound is " + std::to_string(missing) +
                                                   " more than the free bound and these together");
  }

  bool read_site(Node node, CollisionSite& site) {
    std::optional<Node> agents, place, other, begin, end, lemmas;
    std::vector<AgentId> pair;
    if (!check_.members(node, {{"agents", &agents},
                               {"place", &place},
                               {"other", &other},
                               {"begin", &begin},
                               {"end", &end},
                               {"lemmas", &lemmas}}) ||
        !check_.array(*agents, "agents", 2) || !read_agents(*agents, pair))
      return false;
    site.first = pair[0];
    site.second = pair[1];
    site.end = CollisionSite::kForever;
    return read_place(*place, site.place) &&
           (is_null(*other) || read_place(*other, site.other.emplace())) &&
           check_.integer(*begin, 0, INT64_MAX, site.begin) &&
           (is_null(*end) || check_.integer(*end, site.begin, INT64_MAX, site.end)) &&
           check_.integer(*lemmas, 1, INT64_MAX, site.num_lemmas);
  }

  bool read_place(Node node, Place& place) {
    using Kind = Place::Kind;
    std::optional<Node> kind, from, to;
    return check_.members(node, {{"kind", &kind}, {"from", &from}, {"to", &to}}) &&
           read_kind(*kind,
                     {Kind::vertex, Kind::edge, Kind::corridor, Kind::rectangle, Kind::goal,
                      Kind::crossing},
                     place.kind) &&
           read_vertex_(check_, *from, place.from) && read_vertex_(check_, *to, place.to);
  }

  bool read_agents(Node list, std::vector<AgentId>& agents) {
    if (!check_.array(list, "agents")) return false;
    for (Node n = document_.first(list); n < document_.next(list); n = document_.next(n)) {
      std::int64_t number = 0;
      if (!check_.integer(n, 0, static_cast<std::int64_t>(num_agents_) - 1, number)) return false;
      agents.emplace_back(static_cast<std::size_t>(number));
    }
    return true;
  }

  template <class Kind>
  bool read_kind(Node node, std::initializer_list<Kind> kinds, Kind& kind) {
    std::string_view name;
    if (!check_.text(node, name)) return false;
    for (const Kind known : kinds)
      if (to_string(known) == name) {
        kind = known;
        return true;
      }
    return check_.fail(node, "there is no kind " + text::in_quotes(name));
  }

  bool is_null(Node node) const { return document_.kind(node) == Document::Kind::null; }

  const Document& document_;
  Checker& check_;
  const std::size_t num_agents_;
  const ReadVertex& read_vertex_;
};

}  // namespace

Result<std::optional<Attribution>> read_attribution(const std::string& text,
                                                    const std::string& file, std::size_t num_agents,
                                                    const ReadVertex& read_vertex) {
  std::optional<Attribution> attribution;
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos || text[first] != '{') return attribution;
  const auto document = text::parse_json(text, file);
  if (!document) return document.error();
  const auto value = member(*document, "attribution");
  if (!value || document->kind(*value) == Document::Kind::null) return attribution;
  Checker check(*document);
  std::string_view objective;
  const auto stated = member(*document, "objective");
  if (!stated) return document->error(*value, ErrorCode::syntax, "the objective is missing");
  if (!check.text(*stated, objective)) return check.error();
  attribution.emplace().objective = parse_objective(objective).value_or(Objective::sum_of_costs);
  if (!AttributionReader(*document, check, num_agents, read_vertex).read(*value, *attribution))
    return check.error();
  return attribution;
}

}  // namespace quadrille::input
