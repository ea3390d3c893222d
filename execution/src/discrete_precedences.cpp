// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstddef>
#include <optional>
#include <tuple>
#include <vector>

#include "ordering.hpp"
#include "quadrille/discrete/verify.hpp"
#include "quadrille/execution/precedences.hpp"

namespace quadrille::execution {
namespace {

/// An agent is at a vertex, from the end of `in` to the beginning of `out`.
struct Visit {
  VertexId vertex;
  AgentId agent;
  Ticks arrive = 0;
  std::optional<MoveId> in, out;  // No move into its start, none out of its goal.
};

/// The moves of a path, and what it visits.
std::vector<TimedMove> moves_of(AgentId agent, const discrete::Path& path, Timestep now,
                                std::vector<Visit>& visits) {
  std::vector<TimedMove> moves;
  Visit visit{path.front(), agent, Ticks(std::int64_t{now}), std::nullopt, std::nullopt};
  for (std::size_t t = 0; t + 1 < path.size(); ++t) {
    if (path[t] == path[t + 1]) continue;
    const MoveId move{agent, static_cast<std::uint32_t>(moves.size())};
    const Ticks begin(now + static_cast<std::int64_t>(t));
    moves.push_back({path[t], path[t + 1], begin, begin + 1});
    visit.out = move;
    visits.push_back(visit);
    visit = Visit{path[t + 1], agent, begin + 1, move, std::nullopt};
  }
  visits.push_back(visit);
  return moves;
}

}  // namespace

Result<Precedences> precedences(const discrete::Instance& instance, const discrete::Plan& plan) {
  const discrete::Rules& rules = instance.rules();
  if (!rules.blockages.empty() || rules.robust > 0 || rules.turn > 0)
    return Error{
        ErrorCode::out_of_range,
        "the order in which agents come to places keeps no blockages, which have times, "
        "and leaves nobody time to turn or to wait k timesteps longer, as robust plans ask",
        {}};
  const auto report = discrete::verify(instance, plan);
  if (!report.valid()) return Error{ErrorCode::invalid_plan, report.violations.front().message, {}};
  Precedences result;
  result.now = Ticks(std::int64_t{plan.now});
  std::vector<Visit> visits;
  for (const AgentId agent : instance.agent_ids())
    result.moves.push_back(moves_of(agent, plan.paths[agent], plan.now, visits));
  std::sort(visits.begin(), visits.end(), [](const Visit& a, const Visit& b) {
    return std::tie(a.vertex, a.arrive) < std::tie(b.vertex, b.arrive);
  });
  for (std::size_t k = 0; k + 1 < visits.size(); ++k) {
    const Visit &first = visits[k], &next = visits[k + 1];
    if (first.vertex != next.vertex || first.agent == next.agent) continue;
    const Ticks begin = result.at(*next.in).begin;
    if (first.out)
      result.list.push_back({*first.out, *next.in, begin - result.at(*first.out).begin});
    else if (first.in)  // It leaves: when it has arrived, and not while it does.
      result.list.push_back({*first.in, *next.in, begin - result.at(*first.in).end});
  }
  sort_precedences(result.list);
  return result;
}

}  // namespace quadrille::execution
