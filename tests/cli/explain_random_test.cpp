// SPDX-License-Identifier: MIT
//
// What the program says of a bound, over random instances of both domains: raises and reasons sum
// up, and each of them is held against optimal plans of the agents that it names, found alone by
// another system.
#include <fstream>
#include <functional>
#include <set>
#include <sstream>

#include "cli/process.hpp"
#include "support/environment.hpp"

namespace quadrille::cli::test {
namespace {

using nlohmann::json;
using Agents = std::set<std::size_t>;

Agents agents_of(const json& list) { return list.get<Agents>(); }

/// One random instance: how the program is told of it, and of some of its agents only.
struct Case {
  std::vector<std::string> all;
  std::function<std::vector<std::string>(const Agents&)> some;
  std::string independent_system;
  std::string cost, bound;  ///< The keys of both in timesteps or ticks.
};

class ExplainRandomTest : public CliTest {
 protected:
  /// Few cells, many agents.
  Case random_grid(std::size_t seed) const {
    const char* const kind = seed % 2 == 0 ? "random" : "room";
    const Finished made =
        run({"generate", "--kind", kind, "--width", "5", "--height", "5", "--agents", "4", "--seed",
             std::to_string(seed), "--map-output", path("m.map"), "--scen-output", path("m.scen")});
    EXPECT_EQ(made.code, 0) << made.err;
    const auto some = [this](const Agents& agents) {
      std::istringstream scen(read("m.scen"));
      std::string line, kept;
      for (std::size_t row = 0; std::getline(scen, line); ++row)
        if (row == 0 || agents.count(row - 1) > 0) kept += line + "\n";
      write("some.scen", kept);
      return std::vector<std::string>{"--map",    path("m.map"),
                                      "--scen",   path("some.scen"),
                                      "--agents", std::to_string(agents.size())};
    };
    return {{"--map", path("m.map"), "--scen", path("m.scen"), "--agents", "4"},
            some,
            "mdd-sat",
            "cost",
            "lower_bound"};
  }

  /// Discs of different sizes and speeds.
  Case random_roadmap(std::size_t seed) const {
    const Finished made = run({"generate", "--kind", "roadmap", "--vertices", "9", "--agents", "4",
                               "--width", "4", "--height", "4", "--mixed", "--seed",
                               std::to_string(seed), "--instance-output", path("r.json")});
    EXPECT_EQ(made.code, 0) << made.err;
    const auto some = [this](const Agents& agents) {
      json instance = json::parse(read("r.json"));
      json kept = json::array();
      for (const std::size_t i : agents) kept.push_back(instance["agents"][i]);
      instance["agents"] = kept;
      write("some.json", instance.dump());
      return std::vector<std::string>{"--instance", path("some.json")};
    };
    return {{"--instance", path("r.json")}, some, "smt-cbs", "cost_ticks", "lower_bound_ticks"};
  }

  /// What these agents cost at least when there are no others; nullopt: not known.
  std::optional<std::int64_t> cost_of(const Case& sample, const std::string& objective,
                                      const Agents& agents) const {
    const Finished alone = run(
        std::vector<std::string>{"solve"} + sample.some(agents) +
        std::vector<std::string>{"--system", sample.independent_system, "--objective", objective,
                                 "--conflict-limit", "500", "--quiet", "--json", "-"});
    if (alone.code != 0) return std::nullopt;
    return json::parse(alone.out)[sample.cost].get<std::int64_t>();
  }

  void check_sums(const json& result) const {
    const json& attribution = result["attribution"];
    const auto free_bound = attribution["free_bound"].get<std::int64_t>();
    std::int64_t free_costs = 0, largest = 0;
    for (const json& agent : attribution["agents"]) {
      free_costs += agent["free_cost"].get<std::int64_t>();
      largest = std::max(largest, agent["free_cost"].get<std::int64_t>());
    }
    EXPECT_EQ(free_bound, result["objective"] == "makespan" ? largest : free_costs);
    for (const char* const part : {"raises", "reasons"}) {
      std::int64_t sum = free_bound;
      for (const json& item : part == std::string("raises") ? attribution[part] : result[part])
        sum += item["amount"].get<std::int64_t>();
      EXPECT_EQ(sum, attribution["lower_bound"].get<std::int64_t>()) << part;
    }
  }

  /// `raised`: above what the agents cost alone.
  void check_claim(const Case& sample, const json& result, const Agents& agents,
                   std::int64_t raised) {
    const json& attribution = result["attribution"];
    const auto objective = result["objective"].get<std::string>();
    const auto cost = cost_of(sample, objective, agents);
    if (!cost) return;
    std::int64_t claimed = raised;
    if (objective == "makespan") claimed += attribution["free_bound"].get<std::int64_t>();
    if (objective != "makespan")
      for (const std::size_t i : agents)
        claimed += attribution["agents"][i]["free_cost"].get<std::int64_t>();
    EXPECT_LE(claimed, *cost) << json(agents);
    ++num_checked_;
  }

  void check_claims(const Case& sample, const json& result) {
    const bool is_makespan = result["objective"] == "makespan";
    std::int64_t so_far = 0;
    for (const json& raise : result["attribution"]["raises"]) {
      Agents agents = agents_of(raise["agents"]);
      agents.merge(agents_of(raise["bystanders"]));
      const auto amount = raise["amount"].get<std::int64_t>();
      EXPECT_GE(amount, 1);
      so_far += amount;
      check_claim(sample, result, agents, is_makespan ? so_far : amount);
    }
    for (const json& reason : result["reasons"])
      check_claim(sample, result, agents_of(reason["agents"]),
                  reason["amount"].get<std::int64_t>());
  }

  void check(const Case& sample, const std::string& command, const std::string& objective) {
    std::vector<std::string> arguments = std::vector<std::string>{command} + sample.all;
    if (command == "solve") arguments = arguments + std::vector<std::string>{"--explain"};
    const Finished finished =
        run(arguments + std::vector<std::string>{"--objective", objective, "--conflict-limit",
                                                 "500", "--json", "-"});
    if (finished.code == 20) return;  // infeasible: there is no bound
    ASSERT_TRUE(finished.code == 0 || finished.code == 10) << finished.err;
    const json result = json::parse(finished.out);
    check_sums(result);
    check_claims(sample, result);
    EXPECT_EQ(result["attribution"]["lower_bound"], result[sample.bound]);
  }

  std::size_t num_checked_ = 0;
};

TEST_F(ExplainRandomTest, EveryRaiseAndReasonHoldsForItsAgentsAlone) {
  const std::size_t count = support::scaled(8);
  for (std::size_t seed = 0; seed < count; ++seed) {
    SCOPED_TRACE(seed);
    const std::string objective = seed % 5 == 4 ? "makespan" : "sum-of-costs";
    const std::string command = seed % 3 == 0 ? "solve" : "explain";
    check(random_grid(seed), command, objective);
    check(random_roadmap(seed), command, objective);
  }
  EXPECT_GE(num_checked_, count);
}

TEST_F(ExplainRandomTest, TheSearchIsTheSameWithAndWithout) {
  for (std::size_t seed = 0; seed < support::scaled(4); ++seed)
    for (const Case& sample : {random_grid(seed), random_roadmap(seed)}) {
      SCOPED_TRACE(seed);
      const auto solve = std::vector<std::string>{"solve"} + sample.all;
      const Finished without = run(solve + std::vector<std::string>{"--json", "-"});
      const Finished with = run(solve + std::vector<std::string>{"--explain", "--json", "-"});
      ASSERT_EQ(with.code, without.code) << with.err;
      const json a = json::parse(without.out), b = json::parse(with.out);
      for (const char* const count : {"conflicts", "decisions", "sat_calls", "cores"})
        EXPECT_EQ(a["statistics"][count], b["statistics"][count]) << count;
      EXPECT_EQ(a["plan"], b["plan"]);
    }
}

}  // namespace
}  // namespace quadrille::cli::test
