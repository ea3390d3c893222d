// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "pair_search.hpp"

namespace quadrille::continuous {

/// Says of two agents that collide again and again that one of them has to cost more.
class PairLemmas {
 public:
  explicit PairLemmas(Model& model) : model_(model), search_(model) {}

  using Party = PairSearch::Party;
  /// To be told of each collision of two agents with i.agent < j.agent, and of the caps of the
  /// moment. True: a clause was added that says that one of the caps is not kept.
  bool note_collision(Party i, Party j, FormulaWriter& writer);

 private:
  struct Record {
    int collisions = 0;
    int next_try = 3;
    std::vector<std::pair<Cost, Cost>> open;  // caps that no clause can be made for
  };
  [[nodiscard]] Cost max_raise(AgentId i) const;

  Model& model_;
  PairSearch search_;
  std::map<std::pair<AgentId, AgentId>, Record> records_;
};

}  // namespace quadrille::continuous
