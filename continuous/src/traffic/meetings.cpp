// SPDX-License-Identifier: MIT
#include "traffic/meetings.hpp"

#include <algorithm>

namespace quadrille::continuous {

Meetings::Meetings(Scene& scene)
    : scene_(scene),
      grid_(scene.instance()),
      squares_(grid_.size()),
      entries_(scene.instance().num_agents()),
      met_(scene.instance().num_agents()) {}

void Meetings::take_out(AgentId agent) {
  for (const std::size_t square : entries_[agent].squares)
    std::erase_if(squares_[square], [&](const Passage& p) { return p.agent == agent; });
  entries_[agent].squares.clear();
  for (const AgentId other : met_[agent]) {
    found_.erase(std::minmax(agent, other));
    met_[other].erase(agent);
  }
  met_[agent].clear();
}

void Meetings::put(AgentId agent, const std::vector<Step>& steps, std::uint64_t version) {
  Entry& entry = entries_[agent];
  if (entry.steps != nullptr && entry.version == version) return;
  take_out(agent);
  entry.steps = &steps;
  entry.version = version;
  const ClassId c = scene_.instance().class_of(agent);
  for (const Step& step : steps)
    grid_.for_each(grid_.box_of(c, step), [&](std::size_t square) {
      auto& passages = squares_[square];
      // Its own passage is the last one, if there is one.
      if (!passages.empty() && passages.back().agent == agent) {
        passages.back().end = std::max(passages.back().end, step.end);
        return;
      }
      passages.push_back({agent, step.begin, step.end});
      entry.squares.push_back(square);
    });
  if (entry.is_changed) return;
  entry.is_changed = true;
  changed_.push_back(agent);
}

std::vector<Encounter> Meetings::encounters() {
  std::sort(changed_.begin(), changed_.end());
  for (const AgentId agent : changed_) {
    entries_[agent].is_changed = false;
    compare(agent);
  }
  changed_.clear();
  std::vector<Encounter> all;
  all.reserve(found_.size());
  for (const auto& [agents, encounter] : found_) all.push_back(encounter);
  return all;
}

void Meetings::compare(AgentId agent) {
  Entry& entry = entries_[agent];
  if (++query_ == 0) {  // all numbers have been used
    for (Entry& other : entries_) other.seen = 0;
    query_ = 1;
  }
  entry.seen = query_;
  for (const std::size_t square : entry.squares) {
    const auto& passages = squares_[square];
    const Passage own = *std::find_if(passages.begin(), passages.end(),
                                      [&](const Passage& p) { return p.agent == agent; });
    for (const Passage& other : passages) {
      Entry& its = entries_[other.agent];
      // Those that have changed, too, and come later see to it.
      if (its.is_changed || its.seen == query_) continue;
      if (other.begin >= own.end || own.begin >= other.end) continue;
      its.seen = query_;
      const auto [i, j] = std::minmax(agent, other.agent);
      ++num_comparisons_;
      const auto encounter = first_encounter(scene_, i, *entries_[i].steps, j, *entries_[j].steps);
      if (!encounter) continue;
      found_.insert_or_assign({i, j}, *encounter);
      met_[i].insert(j);
      met_[j].insert(i);
    }
  }
}

}  // namespace quadrille::continuous
