// SPDX-License-Identifier: MIT
#include "check/timed_support.hpp"

#include <algorithm>
#include <sstream>

#include "quadrille/continuous/instance_json.hpp"

namespace quadrille_check::support {

namespace continuous = quadrille::continuous;
using quadrille::AgentId;

Road checked(const continuous::Instance& instance) {
  std::ostringstream text;
  if (write_instance_json(text, "", instance)) throw BadInput("it cannot be written");
  return read_road(parse_json(text.str()));
}

std::string rejection(const Road& road, const std::string& lines, bool is_makespan) {
  const std::string head =
      "qcert 1 text\ni " + std::to_string(road.agents.size()) + (is_makespan ? " 1\n" : " 0\n");
  try {
    TimedChecker checker(road);
    RecordReader reader(head + lines);
    for (Record record; reader.next(record);) checker.check(record);
    return "";
  } catch (const Rejected& rejected) {
    return rejected.what();
  }
}

Answer ask(const Road& road, const std::string& certificate) {
  try {
    TimedChecker checker(road);
    RecordReader reader(certificate);
    for (Record record; reader.next(record);) checker.check(record);
    return {true, checker.verdict(), ""};
  } catch (const Rejected& rejected) {
    return {false, {}, rejected.what()};
  }
}

TimedInterpretation::TimedInterpretation(const TimedMeanings& meanings,
                                         const continuous::Instance& instance,
                                         const continuous::Plan& plan)
    : meanings_(meanings) {
  const continuous::Roadmap& roadmap = instance.roadmap();
  for (const AgentId i : instance.agent_ids()) {
    std::vector<Use>& uses = uses_.emplace_back();
    const continuous::Path& path = plan.paths[i];
    const auto since_now = [&](continuous::Ticks ticks) {
      return (ticks - instance.now()).value();
    };
    for (std::size_t k = 0; k < path.size(); ++k) {
      const bool is_last = k + 1 == path.size();
      const int vertex = static_cast<int>(path[k].vertex.index());
      uses.push_back({true,
                      {vertex},
                      since_now(path[k].arrive),
                      is_last && !instance.agent(i).leaves ? kNever : since_now(path[k].depart)});
      if (is_last) continue;
      Use move{false, {}, since_now(path[k].depart), 0};
      for (std::size_t e = 0; e < roadmap.num_edges(); ++e) {
        const continuous::Edge& edge = roadmap.edge(continuous::EdgeId(e));
        if (edge.from == path[k].vertex && edge.to == path[k + 1].vertex &&
            instance.duration(instance.class_of(i), continuous::EdgeId(e)) ==
                path[k + 1].arrive - path[k].depart)
          move.places.push_back(static_cast<int>(e));
      }
      uses.push_back(move);
    }
    costs_.push_back(cost(path));
  }
}

bool TimedInterpretation::is_true(Int lit) const {
  const TimedVariable& x = meanings_.variable(lit);
  const auto agent = static_cast<std::size_t>(x.agent);
  if (x.kind == TimedVariable::Kind::costs_at_most) return (costs_[agent] <= x.number) == (lit > 0);
  const auto is_broken = [&](const TimedBan& ban) {
    return std::any_of(uses_[agent].begin(), uses_[agent].end(), [&](const Use& use) {
      if (ban.is_stay != use.is_stay ||
          std::find(use.places.begin(), use.places.end(), ban.place) == use.places.end())
        return false;
      return ban.is_stay ? use.begin < ban.end && use.end > ban.begin
                         : ban.begin <= use.begin && use.begin < ban.end;
    });
  };
  return std::none_of(x.bans.begin(), x.bans.end(), is_broken) == (lit > 0);
}

bool TimedInterpretation::is_true(std::span<const Int> clause) const {
  return std::any_of(clause.begin(), clause.end(), [&](Int lit) { return is_true(lit); });
}

}  // namespace quadrille_check::support
