// SPDX-License-Identifier: MIT
#include "certificate/certify.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "certificate/timed_meanings.hpp"
#include "cover/cover_tree.hpp"
#include "paths/timed_path.hpp"
#include "quadrille/sat/proof_log.hpp"

namespace quadrille::continuous {
namespace {

using sat::CertificateWriter;
using Index = sat::ProofLog::Index;
constexpr const char* kForm = "qcert 1 bin\n";

/// Collects the clauses that trees need, and writes the trees.
class DraftMaker {
 public:
  DraftMaker(Model& model, const sat::Engine& engine) : model_(model), engine_(engine) {}

  ProofDraft draft(std::span<const ProvedCover> covers, Objective objective, Cost free_bound) {
    ProofDraft draft;
    draft.bound = free_bound;
    const sat::ProofLog& log = *engine_.proof();
    if (!log.fault().empty()) {
      draft.fault = log.fault();
      return draft;
    }
    if (const auto empty = log.find({})) {
      wanted_.push_back(*empty);
      draft.is_exhausted = true;
    } else if (objective == Objective::makespan) {
      if (log.claim().bound > free_bound) {
        wanted_.push_back(*log.claim().refuted);
        draft.bound = log.claim().bound;
      }
    } else {
      add_trees(covers, draft);
    }
    const TimedMeanings meanings(model_, engine_.num_variables());
    auto trimmed = sat::trim_clauses(log, meanings, engine_.num_variables(), wanted_);
    if (!trimmed) {
      draft.fault = trimmed.error().message;
      return draft;
    }
    draft.records = std::move(trimmed->records);
    if (trees_.empty()) {
      if (!wanted_.empty()) draft.clause = trimmed->numbers.front();
    } else {
      CertificateWriter writer;
      for (const auto& tree : trees_) write(tree, trimmed->numbers, writer);
      draft.records += writer.text();
    }
    return draft;
  }

 private:
  struct Tree {
    CoverTree tree;
    std::vector<std::size_t> wanted;  // by core: where its clause is among those that are wanted
  };

  void add_trees(std::span<const ProvedCover> covers, ProofDraft& draft) {
    IdVector<AgentId, Cost> free_costs;
    for (const AgentId i : model_.instance().agent_ids()) free_costs.push_back(model_.free_cost(i));
    for (const ProvedCover& cover : covers) {
      Tree made{make_cover_tree(free_costs, cover.cores, cover.bound), {}};
      if (made.tree.bound == 0) continue;
      draft.bound += made.tree.bound;
      made.wanted.assign(cover.cores.size(), 0);
      std::vector<bool> is_used(cover.cores.size(), false);
      for (const CoverTree::Node& node : made.tree.nodes)
        for (const auto& [core, units] : node.multipliers) is_used[core] = true;
      for (std::size_t c = 0; c < cover.cores.size(); ++c)
        if (is_used[c]) made.wanted[c] = want(cover.cores[c], draft);
      trees_.push_back(std::move(made));
    }
  }

  [[nodiscard]] std::size_t want(const LevelCore& core, ProofDraft& draft) {
    std::vector<sat::Lit> clause;
    for (const Level& level : core) {
      const auto& rungs = model_.rungs(level.agent);
      const auto rung = std::find_if(rungs.begin(), rungs.end(), [&](const Model::Rung& known) {
        return known.cost == level.cost;
      });
      if (rung != rungs.end()) clause.push_back(rung->at_least);
    }
    const auto index = engine_.proof()->find(clause);
    if (!index) {
      draft.fault = "a core of the bound was never refuted";
      return 0;
    }
    wanted_.push_back(*index);
    return wanted_.size() - 1;
  }

  static void write(const Tree& tree, const std::vector<std::int64_t>& numbers,
                    CertificateWriter& writer) {
    std::vector<std::int64_t> values{tree.tree.bound, CoverTree::kFraction};
    for (const CoverTree::Node& node : tree.tree.nodes) {
      if (node.branch) {
        values.insert(values.end(),
                      {1, sat::ProofMeanings::agent_number(node.branch->agent), node.branch->cost});
        continue;
      }
      values.insert(values.end(), {0, static_cast<std::int64_t>(node.multipliers.size())});
      for (const auto& [core, units] : node.multipliers)
        values.insert(values.end(), {numbers[tree.wanted[core]], units});
    }
    writer.record('t', values);
  }

  Model& model_;
  const sat::Engine& engine_;
  std::vector<Index> wanted_;
  std::vector<Tree> trees_;
};

/// The edges that a path takes, by their ends, and when it sets out.
void write_path(AgentId agent, const Path& path, CertificateWriter& writer) {
  std::vector<std::int64_t> values{sat::ProofMeanings::agent_number(agent)};
  for (std::size_t k = 0; k + 1 < path.size(); ++k) {
    values.push_back(static_cast<std::int64_t>(path[k + 1].vertex.value()));
    values.push_back(path[k].depart.value());
    values.push_back(path[k + 1].arrive.value());
  }
  writer.record('p', values);
}

}  // namespace

ProofDraft draft_proof(Model& model, const sat::Engine& engine, std::span<const ProvedCover> covers,
                       Objective objective, Cost free_bound) {
  return DraftMaker(model, engine).draft(covers, objective, free_bound);
}

ProofDraft draft_without_search(const Instance& instance, Cost bound) {
  ProofDraft draft;
  draft.bound = bound;
  if (instance.obstacles().empty()) return draft;
  LimitMonitor unlimited{Limits()};
  const Scene scene(instance, unlimited);
  CertificateWriter writer;
  StandingBans(scene, 0).write(writer);
  draft.records = std::move(writer.text());
  return draft;
}

Certificate certify(const Instance& instance, Objective objective, const ProofDraft& draft,
                    const std::optional<Plan>& plan) {
  CertificateWriter head, tail;
  head.record('i', {static_cast<std::int64_t>(instance.num_agents()),
                    objective == Objective::makespan ? 1 : 0});
  Certificate made;
  if (plan) head.record('u', {cost(*plan, objective)});
  if (!plan && draft.is_exhausted) {
    tail.record('z', {draft.clause});
  } else {
    made.claim = draft.bound;
    if (plan)
      made.claim = draft.is_exhausted ? cost(*plan, objective)
                                      : std::min(draft.bound, cost(*plan, objective));
    tail.record('q', {*made.claim, draft.clause});
  }
  if (plan)
    for (const AgentId i : instance.agent_ids()) write_path(i, plan->paths[i], tail);
  made.bytes = kForm + head.text() + draft.records + tail.text();
  return made;
}

std::string why_no_certificate(const Instance& instance) {
  if (instance.has_goal_sets()) return "agents with several goals";
  if (instance.has_shapes()) return "agents whose bodies change on their way";
  if (!instance.roadmap().no_waiting().empty()) return "places where nobody may wait";
  if (!instance.parked_pairs().empty()) return "agents that overlap at their starts";
  if (instance.has_whole_moves()) return "moves that are released as a whole";
  // The checker would have to know exact places between whole coordinates.
  if (!instance.roadmap().lane_places().empty()) return "vertices in the middle of moves";
  return "";
}

}  // namespace quadrille::continuous
