// SPDX-License-Identifier: MIT
// How much faster a session answers after a change than a solve that knows nothing: CPU time of
// both, by kind of change, on random roadmaps. "time": a tenth of the plan has been followed;
// "goals": likewise, and whoever has arrived has got another goal.
//
// usage: quadrille_session_bench [vertices agents changes gap [time]]   default 200 20 40 0; with a
// fifth argument time goes on, and nothing else changes
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>

#include "quadrille/continuous/generator.hpp"
#include "quadrille/continuous/session.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/core/random.hpp"

using namespace quadrille;
using namespace quadrille::continuous;

namespace {

constexpr std::array kKinds{"close", "open", "move", "remove", "add", "again", "time", "goals"};
constexpr std::size_t kChanges = 6, kTime = 6, kGoals = 7;

struct Row {
  int count = 0, open = 0;
  double cold_s = 0, warm_s = 0;
};

class Bench {
 public:
  Bench(const Instance& instance, std::uint64_t seed)
      : instance_(instance), session_(instance.shared_roadmap()), random_(seed) {
    for (const Agent& agent : instance.agents()) static_cast<void>(session_.add(agent).value());
  }
  Session& session() { return session_; }

  /// False: there was nothing to do.
  bool change(std::size_t kind) {
    const std::vector<MemberId> members = session_.members();
    const MemberId some = members[draw(members.size())];
    Agent agent = session_.agent(some);
    if (kind == 0) {  // a road that is in use: that out of somebody's start
      const auto out = instance_.roadmap().out_edges(agent.start);
      closed_ = out[draw(out.size())];
      return !session_.close(*closed_);
    }
    if (kind == 1) return closed_ && !session_.open(*closed_);
    if (kind == 2) {
      agent.goals = VertexId(draw(instance_.roadmap().num_vertices()));
      return !session_.change(some, agent);
    }
    if (kind == 3) {
      removed_ = agent;
      return !session_.remove(some);
    }
    if (kind == 4) return removed_ && session_.add(*removed_).has_value();
    return true;
  }

  /// Time goes on. Whether somebody has got another goal.
  bool follow(const Plan& plan) {
    const Cost length = std::max<Cost>(10, cost(plan, Objective::makespan));
    static_cast<void>(session_.advance_to(session_.now() + as_ticks(length / 10), plan));
    bool has_goals = false;
    for (const MemberId member : session_.members()) {
      const Agent& agent = session_.agent(member);
      if (agent.under_way || !agent.goals.contains(agent.start)) continue;
      has_goals = true;
      do
        static_cast<void>(
            session_.assign(member, VertexId(draw(instance_.roadmap().num_vertices()))));
      while (!session_.instance());
    }
    return has_goals;
  }

 private:
  std::size_t draw(std::size_t count) { return static_cast<std::size_t>(random_.below(count)); }

  const Instance& instance_;
  Session session_;
  Random random_;
  std::optional<EdgeId> closed_;
  std::optional<Agent> removed_;
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
  RandomInstanceOptions shape;
  shape.num_vertices = number(argc, argv, 1, 200);
  shape.num_agents = number(argc, argv, 2, 20);
  // As dense as the default of a hundred vertices.
  const double side = 3.2e6 * std::sqrt(static_cast<double>(shape.num_vertices));
  shape.width = shape.height = Length(static_cast<std::int64_t>(side));
  const std::size_t num_changes = number(argc, argv, 3, 40);
  const bool goes_on = argc > 5;
  SolveOptions options;
  options.limits.cpu_s = 3;
  options.gap_percent = static_cast<double>(number(argc, argv, 4, 0));
  std::array<Row, kKinds.size()> rows;
  Row all;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Instance instance = random_instance(shape, seed).value();
    Bench bench(instance, seed);
    std::optional<Plan> plan = bench.session().solve(options).value().plan;
    for (std::size_t k = 0; k < num_changes; ++k) {
      std::size_t kind = k % kChanges;
      if (goes_on && plan)
        kind = bench.follow(*plan) ? kGoals : kTime;
      else if (goes_on || !bench.change(kind))
        continue;
      const auto now = bench.session().instance();
      if (!now) continue;
      const double begin_s = thread_cpu_seconds();
      const SolveOutcome warm = bench.session().solve(options).value();
      const double middle_s = thread_cpu_seconds();
      const SolveOutcome cold = solve(*now, options).value();
      const double end_s = thread_cpu_seconds();
      if (warm.plan) plan = warm.plan;
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
