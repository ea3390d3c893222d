// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>

#include "timed/rules.hpp"

namespace quadrille_check {
namespace {

constexpr Int kBans = 4;

}  // namespace

int TimedMeanings::agent(Int number) const {
  require(number >= 0 && number < static_cast<Int>(road_.agents.size()), "no such agent");
  return static_cast<int>(number);
}

// f variable agent 4 bans, of four numbers each; c variable agent cost
void TimedMeanings::add(const Record& record) {
  const auto& values = record.values;
  require(values.size() >= 3, "the record is too short");
  TimedVariable made;
  made.agent = agent(values[1]);
  if (record.tag == 'c') {
    require(values.size() == 3 && values[2] >= 0 && values[2] < kNever,
            "a cost has an agent and a number");
    made.kind = TimedVariable::Kind::costs_at_most;
    made.number = values[2];
  } else {
    require(values[2] == kBans && values.size() % 4 == 3, "a ban has four numbers");
    made.kind = TimedVariable::Kind::does_not;
    for (std::size_t k = 3; k < values.size(); k += 4) {
      made.bans.push_back(read_ban(road_, values[k], values[k + 1], values[k + 2],
                                   values[k + 3] == -1 ? kNever : values[k + 3]));
      TimedBan& ban = made.bans.back();
      if (!ban.is_stay) ban.begin = std::max<Int>(ban.begin, 0);
    }
  }
  variables_.add(values[0], std::move(made));
}

std::optional<std::pair<int, Int>> TimedMeanings::at_least(Int lit) const {
  const TimedVariable& x = variable(lit);
  if (lit > 0 || x.kind != TimedVariable::Kind::costs_at_most) return std::nullopt;
  return std::pair(x.agent, x.number + 1);
}

}  // namespace quadrille_check
