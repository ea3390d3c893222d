// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>

#include "rules/rules.hpp"

namespace quadrille_check {

constexpr int kLastLayer = std::numeric_limits<int>::max();

OneAgent::OneAgent(const Instance& instance, const Meanings& meanings, Distances& distances)
    : instance_(instance),
      meanings_(meanings),
      distances_(distances),
      bans_(1),
      ban_of_(static_cast<std::size_t>(instance.num_places()), 0),
      seen_(static_cast<std::size_t>(instance.num_places()), 0) {}

void OneAgent::clear() {
  for (const int place : banned_) ban_of_[static_cast<std::size_t>(place)] = 0;
  banned_.clear();
  bans_.resize(1);
}

void OneAgent::forbid(const Visit& visit) {
  int& ban = ban_of_[static_cast<std::size_t>(visit.place)];
  if (ban == 0) {
    ban = static_cast<int>(bans_.size());
    bans_.emplace_back();
    banned_.push_back(visit.place);
  }
  if (visit.first <= visit.last) bans_[static_cast<std::size_t>(ban)].visits.push_back(visit);
}

void OneAgent::forbid_move(int from, int to, int time) {
  forbid({from, 1, 0});  // makes room
  bans_[static_cast<std::size_t>(ban_of_[static_cast<std::size_t>(from)])].moves.push_back(
      {to, time});
}

bool OneAgent::is_forbidden(int place, int time) const {
  const Ban& ban = bans_[static_cast<std::size_t>(ban_of_[static_cast<std::size_t>(place)])];
  return std::any_of(ban.visits.begin(), ban.visits.end(),
                     [&](const Visit& visit) { return visit.first <= time && time <= visit.last; });
}

bool OneAgent::is_move_forbidden(int from, int to, int time) const {
  const Ban& ban = bans_[static_cast<std::size_t>(ban_of_[static_cast<std::size_t>(from)])];
  return std::any_of(ban.moves.begin(), ban.moves.end(),
                     [&](const Move& move) { return move.to == to && move.time == time; });
}

bool OneAgent::holds(int agent, Clause clause) {
  clear();
  Task task;
  return !collect(agent, clause, task) || !has_walk(agent, task);
}

// What the negated literals say of this agent. Whatever else they say is left out, and the clause
// is proved without that literal.
bool OneAgent::collect(int agent, Clause clause, Task& task) {
  task.must_be.emplace_back(0, instance_.agents()[static_cast<std::size_t>(agent)].start);
  for (const Int lit : clause) {
    const Variable& x = meanings_.variable(lit);
    const int number = static_cast<int>(x.number);
    if (x.kind == Variable::Kind::costs_at_most && x.agent == agent) {
      if (lit < 0)
        task.most = std::min(task.most, x.number);
      else
        task.more_than = std::max(task.more_than, x.number);
    } else if (x.kind == Variable::Kind::costs_at_most && lit < 0) {
      // The other one is at rest from then on.
      forbid({instance_.agents()[static_cast<std::size_t>(x.agent)].goal, number, kForever});
      task.horizon = std::max(task.horizon, number);
    } else if (x.kind == Variable::Kind::does_not && lit < 0 && x.agent == agent) {
      if (x.is_edge) {
        forbid_move(x.from, x.to, x.time);
        forbid_move(x.to, x.from, x.time);
        task.horizon = std::max(task.horizon, x.time + 1);
      }
      for (const Visit& visit : x.visits) {
        forbid(visit);
        task.horizon = std::max(task.horizon, visit.last == kForever ? visit.first : visit.last);
      }
    } else if (x.kind == Variable::Kind::is_there && x.agent == agent) {
      const Visit& visit = x.visits.front();
      task.horizon = std::max(task.horizon, visit.first);
      if (lit > 0)
        forbid(visit);
      else
        task.must_be.emplace_back(visit.first, visit.place);
    }
  }
  if (task.most <= task.more_than) return false;
  if (task.most < kEndOfTime) {
    // It is at rest at its goal from then on.
    const int goal = instance_.agents()[static_cast<std::size_t>(agent)].goal;
    const int most = static_cast<int>(task.most);
    task.must_be.emplace_back(most, goal);
    for (auto& [time, place] : task.must_be)
      if (time > most) {
        if (place != goal) return false;
        time = most;
      }
    const Ban& ban = bans_[static_cast<std::size_t>(ban_of_[static_cast<std::size_t>(goal)])];
    for (const Visit& visit : ban.visits)
      if (visit.last >= most) return false;
  }
  std::sort(task.must_be.begin(), task.must_be.end());
  task.must_be.erase(std::unique(task.must_be.begin(), task.must_be.end()), task.must_be.end());
  for (std::size_t k = 0; k < task.must_be.size(); ++k) {
    const auto [time, place] = task.must_be[k];
    if (k > 0 && task.must_be[k - 1].first == time) return false;  // in two places
    if (is_forbidden(place, time)) return false;
  }
  return true;
}

// A walk from place to place; there is none if one of the stretches cannot be done.
bool OneAgent::has_walk(int agent, Task& task) {
  const auto& [start, goal] = instance_.agents()[static_cast<std::size_t>(agent)];
  const auto& way = task.must_be;
  const bool is_bounded = task.most < kEndOfTime;
  const int most = static_cast<int>(task.most);
  const auto stop = [&](std::size_t k) { return std::make_pair(way[k].second, way[k].first); };
  if (!is_bounded &&
      !leads(stop(way.size() - 1), {-1, std::max(task.horizon, way.back().first) + 1},
             Direction::forwards, [](int, int) { return true; }))
    return false;
  for (std::size_t k = way.size() - 1; k > 0; --k) {
    const auto from = stop(k - 1), to = stop(k);
    bool is_possible = false;
    if (k == 1) {
      const Distances::Table from_start = distances_.from(start);
      is_possible = leads(from, to, Direction::backwards, [&](int place, int time) {
        return (*from_start)[static_cast<std::size_t>(place)] <= time;
      });
    } else if (is_bounded && k + 1 == way.size()) {
      const Distances::Table to_goal = distances_.from(goal);
      is_possible = leads(from, to, Direction::forwards, [&](int place, int time) {
        return time + (*to_goal)[static_cast<std::size_t>(place)] <= most;
      });
    } else {
      is_possible = leads(from, to, Direction::forwards, [&](int place, int time) {
        return time + instance_.least_distance(place, to.first) <= to.second;
      });
    }
    if (!is_possible) return false;
  }
  return true;
}

template <class MayBe>
bool OneAgent::leads(std::pair<int, int> from, std::pair<int, int> to, Direction direction,
                     const MayBe& may_be) {
  const bool is_back = direction == Direction::backwards;
  std::vector<int> here{is_back ? to.first : from.first}, next;
  const int end = is_back ? from.second : to.second, step = is_back ? -1 : 1;
  for (int time = is_back ? to.second : from.second; time != end; time += step) {
    if (++layer_ == kLastLayer) {
      std::fill(seen_.begin(), seen_.end(), 0);
      layer_ = 1;
    }
    next.clear();
    for (const int place : here) {
      const auto go = [&](int other) {
        int& seen = seen_[static_cast<std::size_t>(other)];
        if (seen == layer_ || !may_be(other, time + step)) return;
        if (other != place && is_move_forbidden(place, other, is_back ? time - 1 : time)) return;
        seen = layer_;
        if (!is_forbidden(other, time + step)) next.push_back(other);
      };
      go(place);
      for (const int other : instance_.neighbours(place)) go(other);
    }
    here.swap(next);
    if (here.empty()) return false;
  }
  const int target = is_back ? from.first : to.first;
  return target < 0 || std::find(here.begin(), here.end(), target) != here.end();
}

}  // namespace quadrille_check
