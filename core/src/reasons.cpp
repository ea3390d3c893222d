// SPDX-License-Identifier: MIT
#include "quadrille/core/reasons.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace quadrille {
namespace {

using Agents = std::vector<AgentId>;

Agents merge(const Agents& a, const Agents& b) {
  Agents all;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(all));
  return all;
}

Agents without(Agents agents, AgentId agent) {
  std::erase(agents, agent);
  return agents;
}

bool has(const Agents& agents, AgentId agent) {
  return std::binary_search(agents.begin(), agents.end(), agent);
}

/// Agents that belong together, with what they were charged.
struct Group {
  Agents agents, bystanders;
  Cost amount = 0;
};

/// Looks for reasons of one attribution.
class Finder {
 public:
  Finder(const Attribution& attribution, const Recheck& recheck, std::size_t max_checks)
      : attribution_(attribution), recheck_(recheck), max_checks_(max_checks) {}

  std::vector<Reason> find() {
    std::vector<Reason> reasons;
    for (const Group& group : groups())
      for (Reason& reason : reasons_of(group)) {
        add_sites(reason);
        reasons.push_back(std::move(reason));
      }
    std::stable_sort(reasons.begin(), reasons.end(), [](const Reason& a, const Reason& b) {
      return std::pair(-a.amount, a.agents) < std::pair(-b.amount, b.agents);
    });
    return reasons;
  }

 private:
  [[nodiscard]] bool is_sum() const { return attribution_.objective == Objective::sum_of_costs; }

  [[nodiscard]] std::vector<Group> groups() const {
    std::vector<Group> groups;
    if (!is_sum()) {
      if (attribution_.raises.empty()) return {};
      const Raise& last = attribution_.raises.back();
      return {{last.agents, last.bystanders, attribution_.lower_bound - attribution_.free_bound}};
    }
    for (const Raise& raise : attribution_.raises) {
      Group joined{raise.agents, raise.bystanders, raise.amount};
      std::erase_if(groups, [&](const Group& group) {
        const bool is_apart = std::none_of(group.agents.begin(), group.agents.end(),
                                           [&](AgentId i) { return has(raise.agents, i); });
        if (is_apart) return false;
        joined.agents = merge(joined.agents, group.agents);
        joined.bystanders = merge(joined.bystanders, group.bystanders);
        joined.amount += group.amount;
        return true;
      });
      groups.push_back(std::move(joined));
    }
    return groups;
  }

  [[nodiscard]] std::vector<Reason> reasons_of(const Group& group) {
    num_checks_ = 0;
    if (auto pairs = divide(group); !pairs.empty()) return pairs;
    Reason reason{merge(group.agents, group.bystanders), group.amount, false, {}};
    if (amounts_to(group.agents, group.amount)) {
      reason.agents = group.agents;
      reason.is_checked = true;
    }
    // Who was charged least often is most likely to be left out.
    Agents order = reason.agents;
    std::map<AgentId, Cost> charged;
    for (const Raise& raise : attribution_.raises)
      for (const AgentId i : raise.agents) charged[i] += raise.amount;
    std::stable_sort(order.begin(), order.end(),
                     [&](AgentId a, AgentId b) { return charged[a] < charged[b]; });
    for (const AgentId i : order) {
      if (reason.agents.size() <= (is_sum() ? 2 : 1)) break;
      Agents fewer = without(reason.agents, i);
      if (!amounts_to(fewer, group.amount)) continue;
      reason.agents = std::move(fewer);
      reason.is_checked = true;
    }
    return {std::move(reason)};
  }

  /// Pairs without common agents that amount to as much as the group; none if there are none such.
  [[nodiscard]] std::vector<Reason> divide(const Group& group) {
    if (!is_sum() || !recheck_ || group.agents.size() <= 2) return {};
    std::set<std::pair<AgentId, AgentId>> candidates;
    for (const CollisionSite& site : attribution_.sites)
      if (has(group.agents, site.first) && has(group.agents, site.second))
        candidates.insert(std::minmax(site.first, site.second));
    std::vector<Reason> pairs;
    for (const auto& [i, j] : candidates)
      if (const auto excess = excess_of({i, j}); excess.value_or(0) > 0)
        pairs.push_back({{i, j}, *excess, true, {}});
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const Reason& a, const Reason& b) { return a.amount > b.amount; });
    std::vector<Reason> chosen;
    std::set<AgentId> used;
    Cost missing = group.amount;
    for (Reason& pair : pairs) {
      if (missing == 0 || used.count(pair.agents[0]) > 0 || used.count(pair.agents[1]) > 0)
        continue;
      used.insert(pair.agents.begin(), pair.agents.end());
      pair.amount = std::min(pair.amount, missing);
      missing -= pair.amount;
      chosen.push_back(std::move(pair));
    }
    if (missing > 0) chosen.clear();
    return chosen;
  }

  /// What the agents cost at least above their free costs, if that can be found out.
  [[nodiscard]] std::optional<Cost> excess_of(const Agents& agents) {
    if (!recheck_ || num_checks_ >= max_checks_) return std::nullopt;
    ++num_checks_;
    const auto bound = recheck_(agents);
    if (!bound) return std::nullopt;
    if (!is_sum()) return *bound - attribution_.free_bound;
    Cost excess = *bound;
    for (const AgentId i : agents) excess -= attribution_.agents[i].free_cost;
    return excess;
  }
  [[nodiscard]] bool amounts_to(const Agents& agents, Cost amount) {
    const auto excess = excess_of(agents);
    return excess && *excess >= amount;
  }

  void add_sites(Reason& reason) const {
    const auto& sites = attribution_.sites;
    for (std::size_t k = 0; k < sites.size(); ++k)
      if (has(reason.agents, sites[k].first) && has(reason.agents, sites[k].second))
        reason.sites.push_back(k);
    std::stable_sort(reason.sites.begin(), reason.sites.end(), [&](std::size_t a, std::size_t b) {
      return sites[a].num_lemmas > sites[b].num_lemmas;
    });
  }

  const Attribution& attribution_;
  const Recheck& recheck_;
  const std::size_t max_checks_;
  std::size_t num_checks_ = 0;  // of the group at work
};

}  // namespace

std::vector<Reason> find_reasons(const Attribution& attribution, const Recheck& recheck,
                                 std::size_t max_checks) {
  return Finder(attribution, recheck, max_checks).find();
}

}  // namespace quadrille
