// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "pairs/pair_search.hpp"
#include "quadrille/core/effort.hpp"
#include "theory/model.hpp"

namespace quadrille::continuous {

/// Says of two agents that collide again and again that one of them has to cost more. Decides when
/// a search of the two pays, and how long, in proportion to what the path searches take.
class PairLemmas {
 public:
  explicit PairLemmas(Model& model)
      : model_(model), settings_(model.scene().settings()), search_(model.scene()) {}

  struct Party {
    AgentId agent;
    Cost cap = 0;                             ///< kAnyCost: none.
    std::span<const ObstacleId> active = {};  ///< Obstacles whose literals are false.
  };
  /// Pairs that are searched: all, or those whose last search refuted something, or none.
  /// Collisions of others do not count.
  enum class Scope { all, proven, none };
  void set_scope(Scope scope) noexcept { scope_ = scope; }
  /// To be told of each collision of two agents with i.agent < j.agent. True: a clause was added
  /// that says that one of the caps is not kept, or that some active obstacle is allowed.
  bool note_collision(const Party& i, const Party& j, FormulaWriter& writer);
  /// To be told when obstacles, of which several are due to j, keep i from meeting its cap.
  /// `i.active`: only these. True as above.
  bool note_explanation(const Party& i, const Party& j, FormulaWriter& writer);

  /// To be told what all path searches have taken: searches of pairs that refute nothing take at
  /// most a part of that, besides some to begin with.
  void set_path_effort(Effort effort) noexcept { path_effort_ = effort; }
  /// Of all searches of pairs, their looks at geometry among them.
  [[nodiscard]] Effort effort() const noexcept {
    return search_effort() + search_.num_looks() * kStep / 4;
  }

 private:
  struct Record {
    std::int64_t count = 0;
    std::int64_t next_try = 0;
    bool is_proven = false;                        // the last search refuted something
    std::optional<std::pair<Cost, Cost>> refuted;  // caps, the last time
    Effort effort;                                 // of one search; none: it has not been tried
    std::vector<std::pair<Cost, Cost>> open;  // caps that other agents have to join in to refute
  };
  /// Of a search of a pair.
  static constexpr Effort kStep = Effort::nanoseconds(25);
  [[nodiscard]] Effort search_effort() const noexcept { return search_.effort() * kStep; }
  /// With a cap that is not after the deadline.
  [[nodiscard]] Party in_time(Party party) const;
  bool note(Record& record, const Party& i, const Party& j, FormulaWriter& writer);
  /// The searches know of one goal for each agent.
  [[nodiscard]] bool has_choice(AgentId i) const;
  bool try_pair(Record& record, const Party& i, const Party& j, FormulaWriter& writer);
  /// Within `most_`.
  [[nodiscard]] bool is_refuted(const Party& i, const Party& j);
  /// The same, with shorter and shorter intervals as long as that takes little.
  [[nodiscard]] bool refute(const Party& i, const Party& j);
  /// How long one of them, on some first move, is in the way of the other at the end of it; at
  /// least 1.
  [[nodiscard]] Ticks passing_time(AgentId i, AgentId j);
  /// What may be spent to make more of a refutation.
  [[nodiscard]] Effort effort_for_more() const;
  /// Makes obstacles that the two do not owe to each other slots of the search.
  void load(const Party& party, AgentId other, std::size_t side);
  /// Switches slots off as long as the caps are refuted, and it does not take too long.
  void reduce(const Party& i, const Party& j);
  void add_clauses(const Party& i, const Party& j, FormulaWriter& writer);
  void raise(PairSearch::Party& party, const PairSearch::Party& other, bool is_second);
  void add_clause(const PairSearch::Party& i, const PairSearch::Party& j, FormulaWriter& writer);
  [[nodiscard]] Ticks max_raise(AgentId i) const;

  Model& model_;
  const Settings& settings_;
  Scope scope_ = Scope::all;
  PairSearch search_;
  std::map<std::pair<AgentId, AgentId>, Record> collisions_, explanations_;
  Effort path_effort_;
  Effort wasted_;                      // for searches that refuted nothing
  Effort most_;                        // for the next search
  Effort refutation_;                  // of the last search that refuted
  std::vector<ObstacleId> loaded_[2];  // by side, slot
};

}  // namespace quadrille::continuous
