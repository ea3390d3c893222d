// SPDX-License-Identifier: MIT
#include "quadrille/core/attribution.hpp"

#include <algorithm>
#include <tuple>

#include "quadrille/core/contract.hpp"

namespace quadrille {
namespace {

/// All that has to be equal for two sites to be one.
auto key(const CollisionSite& site) {
  return std::tie(site.place, site.first, site.second, site.other);
}

}  // namespace

std::string_view to_string(RaiseKind kind) noexcept {
  switch (kind) {
    case RaiseKind::core:
      return "core";
    case RaiseKind::cover:
      return "cover";
    case RaiseKind::search:
      return "search";
    case RaiseKind::total:
      break;
  }
  return "total";
}

std::string_view to_string(Place::Kind kind) noexcept {
  switch (kind) {
    case Place::Kind::vertex:
      return "vertex";
    case Place::Kind::edge:
      return "edge";
    case Place::Kind::corridor:
      return "corridor";
    case Place::Kind::rectangle:
      return "rectangle";
    case Place::Kind::goal:
      return "goal";
    case Place::Kind::crossing:
      break;
  }
  return "crossing";
}

std::vector<CollisionSite> merged(std::vector<CollisionSite> sites) {
  std::sort(sites.begin(), sites.end(), [](const CollisionSite& a, const CollisionSite& b) {
    return std::tuple_cat(key(a), std::tie(a.begin, a.end)) <
           std::tuple_cat(key(b), std::tie(b.begin, b.end));
  });
  std::vector<CollisionSite> result;
  for (CollisionSite& site : sites) {
    if (!result.empty() && key(result.back()) == key(site) && site.begin <= result.back().end) {
      result.back().end = std::max(result.back().end, site.end);
      result.back().num_lemmas += site.num_lemmas;
    } else {
      result.push_back(std::move(site));
    }
  }
  return result;
}

void fit_to_bound(Attribution& attribution) {
  QUADRILLE_REQUIRE(attribution.lower_bound >= attribution.free_bound,
                    "no plan is cheaper than the free costs");
  Cost missing = attribution.lower_bound - attribution.free_bound;
  for (const Raise& raise : attribution.raises) missing -= raise.amount;
  while (missing < 0) {
    Raise& last = attribution.raises.back();
    const Cost cut = std::min(-missing, last.amount);
    last.amount -= cut;
    missing += cut;
    if (last.amount == 0) attribution.raises.pop_back();
  }
  if (missing == 0) return;
  Raise total{RaiseKind::total, missing, {}, {}};
  for (const AgentId i : IdRange<AgentId>(attribution.agents.size())) total.agents.push_back(i);
  QUADRILLE_REQUIRE(!total.agents.empty(), "nobody costs nothing");
  attribution.raises.push_back(std::move(total));
}

}  // namespace quadrille
