// SPDX-License-Identifier: MIT
#include "session/lemma_store.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <utility>

namespace quadrille::continuous {
namespace {

using Kind = LemmaStock::Kind;
using Lemma = LemmaStock::Lemma;
using Obstacle = LemmaStock::Obstacle;

constexpr std::size_t kMostCores = 3000;

/// What becomes of learned things in another situation.
class Passage {
 public:
  Passage(const Situation& then, const Situation& now, const Roadmap& base)
      : base_(base),
        elapsed_(now.begin - then.begin),
        is_opened_(!std::includes(now.closed.begin(), now.closed.end(), then.closed.begin(),
                                  then.closed.end())) {
    for (const auto& [member, task] : then.tasks) {
      const auto at = now.tasks.find(member);
      if (at == now.tasks.end()) {
        fates_.push_back({});
        continue;
      }
      const Agent &before = task.agent, &after = at->second.agent;
      Fate fate;
      fate.now = AgentId(static_cast<std::size_t>(std::distance(now.tasks.begin(), at)));
      fate.is_same = elapsed_ == 0 && at->second == task;
      fate.is_alike = before.body == after.body && before.shapes == after.shapes &&
                      before.speed == after.speed && before.group == after.group;
      fate.rests_alike =
          fate.is_alike && before.goals == after.goals && before.leaves == after.leaves;
      fates_.push_back(fate);
    }
  }

  [[nodiscard]] LemmaStock lemmas(const LemmaStock& stock) const {
    LemmaStock passed;
    std::vector<std::optional<std::uint32_t>> numbers;
    for (const Obstacle& then : stock.obstacles) {
      auto now = obstacle(then);
      numbers.push_back(now ? std::optional(static_cast<std::uint32_t>(passed.obstacles.size()))
                            : std::nullopt);
      if (now) passed.obstacles.push_back(*std::move(now));
    }
    for (const Lemma& then : stock.lemmas) {
      const bool is_whole = std::all_of(then.obstacles.begin(), then.obstacles.end(),
                                        [&](std::uint32_t o) { return numbers[o].has_value(); });
      if (!is_whole) continue;
      Lemma now = then;
      if (then.kind != Kind::collision && !is_known(now, stock)) continue;
      for (std::uint32_t& o : now.obstacles) o = *numbers[o];
      passed.lemmas.push_back(std::move(now));
    }
    return passed;
  }

  [[nodiscard]] std::optional<LevelCore> core(LevelCore core) const {
    for (Level& level : core) {
      const Fate& fate = fates_[level.agent];
      if (!fate.is_same && (elapsed_ == 0 || !fate.rests_alike)) return std::nullopt;
      level.agent = fate.now;
      level.cost -= as_cost(elapsed_);
    }
    return core;
  }

 private:
  struct Fate {
    AgentId now = {};
    bool is_same = false;      // all of its task
    bool is_alike = false;     // what contacts depend on
    bool rests_alike = false;  // and what it keeps others from when it has arrived
  };

  [[nodiscard]] std::optional<Obstacle> obstacle(Obstacle obstacle) const {
    const auto is_there = [&](const Ban& ban) {
      return ban.place < (ban.kind == Ban::Kind::start ? base_.num_edges() : base_.num_vertices());
    };
    if (!fates_[obstacle.agent].is_alike ||
        !std::all_of(obstacle.bans.begin(), obstacle.bans.end(), is_there))
      return std::nullopt;
    obstacle.agent = fates_[obstacle.agent].now;
    if (obstacle.goal) {
      if (!fates_[obstacle.goal->resident].rests_alike) return std::nullopt;
      obstacle.goal->resident = fates_[obstacle.goal->resident].now;
      obstacle.goal->from -= elapsed_;
      if (obstacle.goal->from < 0) return std::nullopt;
      return obstacle;
    }
    if (elapsed_ > 0 && !put_earlier(obstacle.bans)) return std::nullopt;
    std::erase_if(obstacle.partners, [&](AgentId then) { return !fates_[then].is_alike; });
    for (AgentId& partner : obstacle.partners) partner = fates_[partner].now;
    if (obstacle.partners.empty()) return std::nullopt;
    return obstacle;
  }

  /// Without what is over. False: the cause is.
  [[nodiscard]] bool put_earlier(std::vector<Ban>& bans) const {
    for (Ban& ban : bans) {
      if (ban.is_end()) continue;
      ban.when.begin -= elapsed_;
      if (ban.when.end < kForever) ban.when.end -= elapsed_;
    }
    const auto is_over = [](const Ban& ban) { return ban.when.end <= 0; };
    if (is_over(bans.front())) return false;
    std::erase_if(bans, is_over);
    return true;
  }

  /// Of lemmas that speak of costs, all of whose obstacles are there.
  [[nodiscard]] bool is_known(Lemma& lemma, const LemmaStock& stock) const {
    bool is_same = !is_opened_;
    for (Level& level : lemma.levels) {
      is_same = is_same && fates_[level.agent].is_same;
      level.agent = fates_[level.agent].now;
    }
    if (lemma.kind == Kind::pair) return is_same;
    lemma.is_doubtful = !is_same || !fates_[stock.obstacles[lemma.obstacles.front()].agent].is_same;
    if (lemma.is_doubtful) lemma.levels.clear();
    return true;
  }

  const Roadmap& base_;
  const Ticks elapsed_;
  const bool is_opened_;  // some edge
  IdVector<AgentId, Fate> fates_;
};

}  // namespace

void LemmaStore::put(const Situation& situation, Learned learned) {
  situation_ = situation;
  learned_ = std::move(learned);
  std::vector<LevelCore>& cores = learned_.cores;
  if (cores.size() > kMostCores)
    cores.erase(cores.begin(), cores.end() - static_cast<std::ptrdiff_t>(kMostCores));
}

Learned LemmaStore::learned(const Situation& now) const {
  const Passage passage(situation_, now, *base_);
  Learned learned{passage.lemmas(learned_.lemmas), {}};
  for (const LevelCore& core : learned_.cores)
    if (auto passed = passage.core(core)) learned.cores.push_back(*std::move(passed));
  return learned;
}

}  // namespace quadrille::continuous
