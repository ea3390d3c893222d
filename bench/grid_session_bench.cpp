// SPDX-License-Identifier: MIT
// How much faster a session on a grid answers after a change than a solve that knows nothing: CPU
// time of both, by kind of change, on random grids. "again": nothing has changed; "goal": one agent
// has got another goal; "time": two timesteps of the plan have been followed; "work": likewise, and
// whoever has arrived has got another goal.
//
// usage: quadrille_grid_session_bench [side agents changes]   default 24 30 40
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <optional>
#include <vector>

#include "quadrille/core/limits.hpp"
#include "quadrille/core/random.hpp"
#include "quadrille/discrete/generator.hpp"
#include "quadrille/discrete/session.hpp"

using namespace quadrille;
using namespace quadrille::discrete;

namespace {

constexpr std::array kKinds{"again", "goal", "time", "work"};

struct Row {
  int count = 0, open = 0;
  double cold_s = 0, warm_s = 0;
};

class Bench {
 public:
  Bench(const GridMap& map, std::size_t agents, std::uint64_t seed)
      : graph_(std::make_shared<const Graph>(map.graph())), session_(graph_), random_(seed) {
    const auto scenario = random_scenario(map, agents, seed).value();
    const Instance first = make_instance(graph_, scenario, agents).value();
    for (const Agent& agent : first.agents()) static_cast<void>(session_.add(agent).value());
  }
  Session& session() { return session_; }

  void change(std::size_t kind, const Plan& plan) {
    const std::vector<MemberId> members = session_.members();
    if (kind >= 2) static_cast<void>(session_.advance_to(session_.now() + 2, plan));
    if (kind == 1) send(members[draw(members.size())]);
    if (kind == 3)
      for (const MemberId member : members)
        if (const Agent& agent = session_.agent(member); agent.goals.contains(agent.start))
          send(member);
  }

 private:
  std::size_t draw(std::size_t count) { return static_cast<std::size_t>(random_.below(count)); }
  /// To a place that is nobody's goal, within reach.
  void send(MemberId member) {
    const auto distances = distances_from(*graph_, session_.agent(member).start);
    for (;;) {
      const VertexId goal(draw(graph_->num_vertices()));
      if (distances[goal] == kUnreachable || session_.assign(member, goal)) continue;
      if (session_.instance()) return;
    }
  }

  std::shared_ptr<const Graph> graph_;
  Session session_;
  Random random_;
};

std::size_t number(int argc, char** argv, int at, std::size_t otherwise) {
  return argc > at ? std::strtoul(argv[at], nullptr, 10) : otherwise;
}

void print(const char* name, const Row& row) {
  std::printf("%-8s %4d changes, %3d to a limit, cold %8.3f s, session %8.3f s, ratio %.2f\n", name,
              row.count, row.open, row.cold_s, row.warm_s, row.cold_s / row.warm_s);
}

}  // namespace

int main(int argc, char** argv) {
  const auto side = static_cast<std::int32_t>(number(argc, argv, 1, 24));
  const std::size_t agents = number(argc, argv, 2, 30), num_changes = number(argc, argv, 3, 40);
  SolveOptions options;
  options.limits.cpu_s = 3;
  std::array<Row, kKinds.size()> rows;
  Row all;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const GridMap map = random_map(side, side, 0.15, seed).value();
    Bench bench(map, agents, seed);
    std::optional<Plan> plan = bench.session().solve(options).value().plan;
    for (std::size_t k = 0; plan && k < num_changes; ++k) {
      const std::size_t kind = k % kKinds.size();
      bench.change(kind, *plan);
      const Instance now = bench.session().instance().value();
      const double begin_s = thread_cpu_seconds();
      const SolveOutcome warm = bench.session().solve(options).value();
      const double middle_s = thread_cpu_seconds();
      const SolveOutcome cold = solve(now, options).value();
      const double end_s = thread_cpu_seconds();
      plan = warm.plan ? warm.plan : cold.plan;
      const bool are_open = warm.stop == StopReason::cpu_time || cold.stop == StopReason::cpu_time;
      for (Row* row : {&rows[kind], &all}) {
        ++row->count;
        row->open += are_open ? 1 : 0;
        row->warm_s += middle_s - begin_s;
        row->cold_s += end_s - middle_s;
      }
    }
  }
  for (std::size_t kind = 0; kind < kKinds.size(); ++kind)
    if (rows[kind].count > 0) print(kKinds[kind], rows[kind]);
  print("all", all);
}
