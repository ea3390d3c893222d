// SPDX-License-Identifier: MIT
#include "solve/lemma_keeper.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "theory/path_search.hpp"

namespace quadrille::continuous {
namespace {

using Kind = LemmaStock::Kind;
using sat::Lit;

/// Makes literals again, and clauses of them.
class Taker {
 public:
  Taker(const LemmaStock& stock, Model& model, FormulaWriter& writer)
      : stock_(stock), model_(model), writer_(writer), made_(stock.obstacles.size()) {}

  bool take(const LemmaStock::Lemma& lemma) {
    if (is_plain(lemma)) return false;
    obstacles_.clear();
    for (const std::uint32_t number : lemma.obstacles) obstacles_.push_back(obstacle(number));
    std::vector<Level> levels = lemma.levels;
    if (lemma.is_doubtful && !look_again(levels)) return false;
    add(lemma.kind, levels);
    return true;
  }

 private:
  /// Whether every plan satisfies it, because somebody cannot cost less anyway.
  [[nodiscard]] bool is_plain(const LemmaStock::Lemma& lemma) const {
    const auto is_free = [&](AgentId i, Cost cost) { return cost <= model_.free_cost(i); };
    return std::any_of(lemma.levels.begin(), lemma.levels.end(),
                       [&](const Level& level) { return is_free(level.agent, level.cost); }) ||
           std::any_of(lemma.obstacles.begin(), lemma.obstacles.end(), [&](std::uint32_t number) {
             const auto& goal = stock_.obstacles[number].goal;
             return goal && is_free(goal->resident, as_cost(goal->from));
           });
  }

  [[nodiscard]] ObstacleId obstacle(std::uint32_t number) {
    if (made_[number]) return *made_[number];
    const LemmaStock::Obstacle& known = stock_.obstacles[number];
    bool is_new = false;
    if (known.goal)
      made_[number] = model_.keep_off_goal(known.agent, known.goal->resident, known.goal->vertex,
                                           known.goal->from, writer_, is_new);
    for (const AgentId partner : known.partners)
      made_[number] = model_.usage(known.agent, known.bans, partner, writer_, is_new);
    return *made_[number];
  }

  /// What the obstacles cost their agent. False: nothing.
  [[nodiscard]] bool look_again(std::vector<Level>& levels) {
    if (!search_) search_.emplace(model_);
    const AgentId i = model_.obstacles()[obstacles_.front()].agent;
    const auto found = search_->find(i, obstacles_, kAnyCost);
    levels.clear();
    if (found.path() == nullptr) return true;
    levels.push_back({i, as_cost(found.path()->arrival)});
    return levels.front().cost > model_.free_cost(i);
  }

  void add(Kind kind, const std::vector<Level>& levels) {
    std::vector<Lit> clause;
    std::vector<sat::Usage> usages;
    for (const Level& level : levels)
      clause.push_back(model_.at_least(level.agent, level.cost, writer_));
    for (const ObstacleId id : obstacles_) {
      const Obstacle& obstacle = model_.obstacles()[id];
      usages.push_back({obstacle.agent, id.value()});
      const Lit lit = kind == Kind::collision ? ~obstacle.allowed : obstacle.allowed;
      if (std::find(clause.begin(), clause.end(), lit) == clause.end()) clause.push_back(lit);
    }
    writer_.add({why(kind, levels), clause, usages, false});
  }

  [[nodiscard]] sat::Why why(Kind kind, const std::vector<Level>& levels) const {
    const auto owner = [&](ObstacleId id) { return model_.obstacles()[id].agent; };
    if (kind == Kind::path) return sat::why::Path{owner(obstacles_.front())};
    if (kind == Kind::pair) return sat::why::Pair{levels[0].agent, levels[1].agent};
    if (model_.obstacles()[obstacles_.front()].cause.is_end())
      return sat::why::Goal{owner(obstacles_.back())};
    const bool is_stay = std::any_of(obstacles_.begin(), obstacles_.end(), [&](ObstacleId id) {
      return model_.obstacles()[id].cause.kind == Ban::Kind::stay;
    });
    return is_stay ? sat::Why(sat::why::Stay{}) : sat::Why(sat::why::Moves{});
  }

  const LemmaStock& stock_;
  Model& model_;
  FormulaWriter& writer_;
  std::optional<PathSearch> search_;
  std::vector<std::optional<ObstacleId>> made_;  // by number in the stock
  std::vector<ObstacleId> obstacles_;            // of the lemma at hand
};

LemmaStock::Obstacle kept(const Model& model, ObstacleId id) {
  const Obstacle& known = model.obstacles()[id];
  LemmaStock::Obstacle kept{known.agent, {}, {}};
  const auto meaning = model.variable(known.allowed);
  if (meaning.kind == Model::VariableKind::cost) {
    kept.goal = {meaning.agent, model.instance().agent(meaning.agent).goal(),
                 as_ticks(meaning.cost)};
  } else if (meaning.kind == Model::VariableKind::rest) {
    kept.goal = {meaning.agent, meaning.goal, as_ticks(meaning.cost)};
  } else {
    kept.bans = known.bans;
    const auto cause = std::find(kept.bans.begin(), kept.bans.end(), known.cause);
    std::rotate(kept.bans.begin(), cause, cause + 1);
    kept.partners = known.partners;
  }
  return kept;
}

}  // namespace

void LemmaKeeper::on_lemma(const sat::Lemma& lemma) {
  PassingObserver::on_lemma(lemma);
  const auto* path = std::get_if<sat::why::Path>(&lemma.why);
  const auto* pair = std::get_if<sat::why::Pair>(&lemma.why);
  if ((path == nullptr && !sat::is_collision(lemma.why)) || lemma.usages.empty()) return;
  LemmaStock::Lemma kept;
  kept.kind = path != nullptr ? Kind::path : pair != nullptr ? Kind::pair : Kind::collision;
  // The literals of obstacles around goals are costs, too: of others than the path's agent, and
  // after the two of a pair.
  for (std::size_t k = 0; k < lemma.clause.size(); ++k) {
    const auto meaning = model_.variable(lemma.clause[k]);
    const bool is_level =
        path != nullptr ? meaning.kind == Model::VariableKind::cost && meaning.agent == path->agent
                        : pair != nullptr && k < 2;
    if (is_level) kept.levels.push_back({meaning.agent, meaning.cost});
  }
  for (const sat::Usage& usage : lemma.usages)
    kept.obstacles.push_back(static_cast<std::uint32_t>(usage.resource));
  // Now and then, all at once.
  if (lemmas_.size() >= 2 * kMostLemmas)
    lemmas_.erase(lemmas_.begin(), lemmas_.begin() + kMostLemmas);
  lemmas_.push_back(std::move(kept));
}

LemmaStock LemmaKeeper::stock() const {
  LemmaStock stock;
  std::vector<std::optional<std::uint32_t>> numbers(model_.obstacles().size());
  const std::size_t count = std::min(lemmas_.size(), kMostLemmas);
  stock.lemmas.assign(lemmas_.end() - static_cast<std::ptrdiff_t>(count), lemmas_.end());
  for (LemmaStock::Lemma& lemma : stock.lemmas)
    for (std::uint32_t& obstacle : lemma.obstacles) {
      auto& number = numbers[obstacle];
      if (!number) {
        number = static_cast<std::uint32_t>(stock.obstacles.size());
        stock.obstacles.push_back(kept(model_, ObstacleId(obstacle)));
      }
      obstacle = *number;
    }
  return stock;
}

std::size_t take_up(const LemmaStock& stock, Model& model, FormulaWriter& writer) {
  Taker taker(stock, model, writer);
  return static_cast<std::size_t>(
      std::count_if(stock.lemmas.begin(), stock.lemmas.end(),
                    [&](const LemmaStock::Lemma& lemma) { return taker.take(lemma); }));
}

}  // namespace quadrille::continuous
