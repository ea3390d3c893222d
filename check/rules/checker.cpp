// SPDX-License-Identifier: MIT
#include "rules/checker.hpp"

#include <algorithm>
#include <unordered_map>

#include "rules/infeasible.hpp"

namespace quadrille_check {

Checker::Checker(const Instance& instance)
    : CheckerFrame(instance.agents().size()),
      instance_(instance),
      distances_(instance),
      meanings_(instance),
      ledger_(instance, meanings_),
      one_agent_(instance, meanings_, distances_) {}

void Checker::check_own(const Record& record) {
  const auto value = [&](std::size_t k) {
    require(k < record.values.size(), "the record is too short");
    return record.values[k];
  };
  switch (record.tag) {
    case 'f':
    case 'c':
    case 'x':
    case 's':
      return meanings_.add_variable(record);
    case 'n':
      return meanings_.add_node(record);
    case 'k':
      return ledger_.pay(clauses_[value(0)], value(1));
    case 'e':
      return ledger_.count_excess(value(0));
    default:
      throw Rejected("no such record");
  }
}

bool Checker::holds(Int rule, std::span<const Int> parameters, std::span<const Int> clause) {
  switch (rule) {
    case 1:
      require(parameters.size() == 1 && parameters[0] >= 0 &&
                  parameters[0] < static_cast<Int>(instance_.agents().size()),
              "rule 1 has an agent");
      return one_agent_.holds(static_cast<int>(parameters[0]), clause);
    case 2:
      return is_same_place(meanings_, clause);
    case 3:
      return is_swap(meanings_, clause);
    case 4:
      return is_rectangle(instance_, meanings_, clause, parameters);
    case 5:
      return is_corridor(instance_, meanings_, distances_, clause, parameters);
    case 6:
      return is_sum(meanings_, clause);
    case 7:
      return is_order(meanings_, clause);
    default:
      throw Rejected("no such rule");
  }
}

Int Checker::proved(Int clause) const {
  std::optional<Ints> literals;
  if (clause != 0) literals = clauses_[clause];
  return ledger_.bound(literals, is_makespan());
}

void Checker::require_infeasible(std::span<const Int> values) const {
  require(is_infeasible(instance_, values),
          "the agents could come to their goals for all that is said");
}

Int Checker::plan_cost(const std::vector<Ints>& paths) const {
  std::size_t end = 0;
  Int cost = 0;
  for (std::size_t a = 0; a < paths.size(); ++a) {
    const Ints& path = paths[a];
    const Instance::Agent& agent = instance_.agents()[a];
    require(!path.empty() && path.front() == agent.start && path.back() == agent.goal,
            "a path of the plan has another start or goal");
    for (const Int place : path) require(instance_.has(place), "no such place");
    for (std::size_t t = 0; t + 1 < path.size(); ++t)
      require(path[t] == path[t + 1] ||
                  instance_.are_joined(static_cast<int>(path[t]), static_cast<int>(path[t + 1])),
              "a path of the plan jumps");
    std::size_t arrival = path.size() - 1;
    while (arrival > 0 && path[arrival - 1] == agent.goal) --arrival;
    const Int own = static_cast<Int>(arrival);
    cost = is_makespan() ? std::max(cost, own) : cost + own;
    end = std::max(end, path.size());
  }
  const auto where = [&](std::size_t a, std::size_t t) {
    return paths[a][std::min(t, paths[a].size() - 1)];
  };
  for (std::size_t t = 0; t < end; ++t) {
    std::unordered_map<Int, std::size_t> occupants;
    for (std::size_t a = 0; a < paths.size(); ++a)
      require(occupants.emplace(where(a, t), a).second, "two agents of the plan are in one place");
    for (std::size_t a = 0; a < paths.size(); ++a) {
      const auto other = occupants.find(where(a, t + 1));
      require(other == occupants.end() || other->second == a ||
                  where(other->second, t + 1) != where(a, t),
              "two agents of the plan swap places");
    }
  }
  return cost;
}

}  // namespace quadrille_check
