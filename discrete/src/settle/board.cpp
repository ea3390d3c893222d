// SPDX-License-Identifier: MIT
#include "settle/board.hpp"

#include <algorithm>
#include <utility>

#include "quadrille/core/contract.hpp"

namespace quadrille::discrete {

LocalGraph::LocalGraph(const Component& component, const ComponentNumbering& numbering)
    : block_(component.block), on_cycle_(component.on_cycle) {
  offsets_.reserve(component.size() + 1);
  offsets_.push_back(0);
  for (const VertexId v : component.vertices) {
    for (const VertexId w : component.graph->neighbours(v))
      neighbours_.push_back(numbering.number(w));
    offsets_.push_back(neighbours_.size());
  }
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

}  // namespace quadrille::discrete
