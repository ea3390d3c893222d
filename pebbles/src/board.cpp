// SPDX-License-Identifier: MIT
#include "quadrille/pebbles/board.hpp"

#include <algorithm>
#include <utility>

#include "quadrille/core/contract.hpp"

namespace quadrille::pebbles {

LocalGraph::LocalGraph(const std::vector<std::vector<Local>>& neighbours)
    : block_(neighbours.size(), kNoLocal), on_cycle_(neighbours.size(), false) {
  offsets_.reserve(neighbours.size() + 1);
  offsets_.push_back(0);
  for (const std::vector<Local>& near : neighbours) {
    neighbours_.insert(neighbours_.end(), near.begin(), near.end());
    offsets_.push_back(neighbours_.size());
  }
  find_blocks();
}

/// By depth-first search: no edge leads from below a bridge to a place before it. Not recursive: a
/// path of a million vertices would overflow the stack.
void LocalGraph::find_blocks() {
  std::vector<Local> parent(size(), kNoLocal), place(size(), kNoLocal), order;
  std::vector<std::size_t> next = offsets_;
  for (Local v = size() > 0 ? 0 : kNoLocal; v != kNoLocal;) {
    if (place[v] == kNoLocal) {
      place[v] = static_cast<Local>(order.size());
      order.push_back(v);
    }
    if (next[v] == offsets_[v + 1]) {
      v = parent[v];
      continue;
    }
    const Local w = neighbours_[next[v]++];
    if (place[w] != kNoLocal) continue;
    parent[w] = v;
    v = w;
  }
  QUADRILLE_REQUIRE(order.size() == size(), "the graph is connected");
  std::vector<Local> low = place;
  for (std::size_t k = order.size(); k-- > 1;) {
    const Local v = order[k];
    for (const Local w : neighbours(v))
      if (w != parent[v]) low[v] = std::min(low[v], place[w]);
    low[parent[v]] = std::min(low[parent[v]], low[v]);
  }
  std::vector<Local> top(size()), least(size(), kNoLocal);
  for (const Local v : order) {
    const bool is_top = parent[v] == kNoLocal || low[v] == place[v];
    top[v] = is_top ? v : top[parent[v]];
    on_cycle_[v] = !is_top;
    if (!is_top) on_cycle_[top[v]] = true;
    least[top[v]] = std::min(least[top[v]], v);
  }
  for (Local v = 0; v < size(); ++v) block_[v] = least[top[v]];
}

Board::Board(Local num_vertices, std::vector<Local> vertex_of)
    : vertex_of_(std::move(vertex_of)), agent_at_(num_vertices, kNoLocal) {
  for (Local agent = 0; agent < vertex_of_.size(); ++agent) agent_at_[vertex_of_[agent]] = agent;
}

void Board::apply(std::span<const Shift> together) {
  for (const Shift& shift : together) agent_at_[shift.from] = kNoLocal;
  for (const Shift& shift : together) {
    QUADRILLE_REQUIRE(is_free(shift.to), "nobody is in the way");
    agent_at_[shift.to] = shift.agent;
    vertex_of_[shift.agent] = shift.to;
  }
}

void Board::move(Local agent, Local to) {
  shifts_.push_back({agent, vertex_of_[agent], to, false});
  apply(std::span(shifts_).last(1));
}

void Board::rotate(std::span<const Local> cycle) {
  const std::size_t before = shifts_.size();
  for (std::size_t k = 0; k < cycle.size(); ++k)
    shifts_.push_back(
        {agent_at_[cycle[k]], cycle[k], cycle[(k + 1) % cycle.size()], k + 1 < cycle.size()});
  apply(std::span(shifts_).subspan(before));
}

void Board::step(std::span<const Local> to) {
  std::vector<bool> is_done(to.size(), false);
  std::vector<Local> row;  // Each goes where the next one is.
  for (Local first = 0; first < to.size(); ++first) {
    row.clear();
    bool is_cycle = false;
    for (Local agent = first; !is_done[agent] && to[agent] != vertex_of_[agent];) {
      is_done[agent] = true;
      row.push_back(agent);
      const Local ahead = agent_at_[to[agent]];
      is_cycle = ahead == first;
      if (ahead == kNoLocal || is_cycle) break;
      agent = ahead;
    }
    if (is_cycle) {
      for (Local& agent : row) agent = vertex_of_[agent];
      rotate(row);
    } else {
      for (; !row.empty(); row.pop_back()) move(row.back(), to[row.back()]);
    }
  }
}

void Board::append_backwards(std::span<const Shift> shifts, Local a, Local b) {
  const auto renamed = [&](Local agent) { return agent == a ? b : agent == b ? a : agent; };
  for (std::size_t end = shifts.size(); end > 0;) {
    std::size_t begin = end - 1;
    while (begin > 0 && shifts[begin - 1].with_next) --begin;
    const std::size_t before = shifts_.size();
    for (std::size_t k = end; k-- > begin;)
      shifts_.push_back({renamed(shifts[k].agent), shifts[k].to, shifts[k].from, k > begin});
    apply(std::span(shifts_).subspan(before));
    end = begin;
  }
}

void Board::undo_to(std::size_t count) {
  const std::vector<Shift> undone(shifts_.begin() + static_cast<std::ptrdiff_t>(count),
                                  shifts_.end());
  append_backwards(undone, kNoLocal, kNoLocal);
  shifts_.resize(count);
}

void Board::retrace(std::size_t first, std::size_t last, Local a, Local b) {
  const std::vector<Shift> gone(shifts_.begin() + static_cast<std::ptrdiff_t>(first),
                                shifts_.begin() + static_cast<std::ptrdiff_t>(last));
  append_backwards(gone, a, b);
}

void Board::retrace(const Board& other) { append_backwards(other.shifts_, kNoLocal, kNoLocal); }

}  // namespace quadrille::pebbles
