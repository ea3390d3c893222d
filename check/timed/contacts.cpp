// SPDX-License-Identifier: MIT
#include "timed/contacts.hpp"

#include <algorithm>
#include <tuple>

namespace quadrille_check {
namespace {

/// Longer than all moves.
constexpr Int kMostTicks = Int{1} << 42;

}  // namespace

TimedContacts::TimedContacts(const Road& road) : road_(road) {
  std::map<std::tuple<std::size_t, Int, std::vector<Point>>, int> first;
  for (const Road::Agent& agent : road.agents) {
    const auto corners = agent.body.corners ? *agent.body.corners : std::vector<Point>();
    likes_.push_back(first
                         .try_emplace({agent.durations, agent.body.radius, corners},
                                      static_cast<int>(likes_.size()))
                         .first->second);
  }
}

void TimedContacts::add(const Record& record) {
  const auto& values = record.values;
  require(values.size() == 7, "a contact has seven numbers");
  const auto agent = [&](Int number) {
    require(number >= 0 && number < static_cast<Int>(likes_.size()), "no such agent");
    return static_cast<int>(number);
  };
  const int mover = agent(values[0]), other = agent(values[2]);
  require(values[1] >= 0 && values[1] < static_cast<Int>(road_.edges.size()), "no such place");
  const int edge = static_cast<int>(values[1]);
  const TimedBan ban = read_ban(road_, values[3], values[4], values[5], values[6]);
  require(-kMostTicks < ban.begin && ban.end < kMostTicks, "a contact lasts too long");
  require(is_in_the_way(road_, move_along(road_, mover, edge, 0), other, ban),
          "the two do not always meet");
  known_[{like(mover), like(other)}][key(edge, ban.is_stay)][ban.place] = {ban.begin, ban.end};
  if (!ban.is_stay)
    known_[{like(other), like(mover)}][key(ban.place, false)][edge] = {1 - ban.end, 1 - ban.begin};
}

const TimedContacts::Places* TimedContacts::of(int agent, int edge, int other, bool is_stay) const {
  const auto both = known_.find({like(agent), like(other)});
  if (both == known_.end()) return nullptr;
  const auto places = both->second.find(key(edge, is_stay));
  return places == both->second.end() ? nullptr : &places->second;
}

std::optional<TimedContacts::Stretch> TimedContacts::find(int agent, int edge, int other,
                                                          bool is_stay, int place) const {
  const Places* const places = of(agent, edge, other, is_stay);
  if (places == nullptr) return std::nullopt;
  const auto at = places->find(place);
  return at == places->end() ? std::nullopt : std::optional(at->second);
}

}  // namespace quadrille_check
