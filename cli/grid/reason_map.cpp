// SPDX-License-Identifier: MIT
#include "grid/reason_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace quadrille::cli {
namespace {

using discrete::Cell;
using discrete::Graph;
using discrete::GridLayout;
using discrete::Instance;

constexpr std::int32_t kMaxWidth = 80, kMaxHeight = 50;

/// A grid of letters: # blocked, . free.
class Sheet {
 public:
  explicit Sheet(const GridLayout& layout)
      : layout_(layout),
        rows_(static_cast<std::size_t>(layout.height()),
              std::string(static_cast<std::size_t>(layout.width()), '#')) {
    for (const VertexId v : IdRange<VertexId>(layout.num_vertices())) at(v) = '.';
  }
  [[nodiscard]] static bool is_small(const Graph& graph) {
    return graph.layout() && graph.layout()->width() <= kMaxWidth &&
           graph.layout()->height() <= kMaxHeight;
  }
  char& at(VertexId v) {
    const Cell cell = layout_.cell_of(v);
    return rows_[static_cast<std::size_t>(cell.y)][static_cast<std::size_t>(cell.x)];
  }
  void mark_free(VertexId v, char letter) {
    if (at(v) == '.') at(v) = letter;
  }
  [[nodiscard]] std::string text() const {
    std::string text = "\n";
    for (const std::string& row : rows_) text += row + "\n";
    return text;
  }

 private:
  const GridLayout& layout_;
  std::vector<std::string> rows_;
};

/// A shortest way between two vertices, both included; only the two if there is none.
std::vector<VertexId> way_between(const Graph& graph, VertexId from, VertexId to) {
  IdVector<VertexId, std::int64_t> before(graph.num_vertices(), -1);
  std::vector<VertexId> queue{to};
  before[to] = static_cast<std::int64_t>(to.index());
  for (std::size_t at = 0; at < queue.size() && before[from] < 0; ++at)
    for (const VertexId w : graph.neighbours(queue[at]))
      if (before[w] < 0) {
        before[w] = static_cast<std::int64_t>(queue[at].index());
        queue.push_back(w);
      }
  if (before[from] < 0) return {from, to};
  std::vector<VertexId> way{from};
  while (way.back() != to) way.emplace_back(static_cast<std::size_t>(before[way.back()]));
  return way;
}

std::vector<VertexId> vertices_of(const Graph& graph, const Place& place) {
  const GridLayout& layout = *graph.layout();
  switch (place.kind) {
    case Place::Kind::corridor:
      return way_between(graph, place.from, place.to);
    case Place::Kind::rectangle: {
      const Cell a = layout.cell_of(place.from), b = layout.cell_of(place.to);
      std::vector<VertexId> vertices;
      for (std::int32_t y = std::min(a.y, b.y); y <= std::max(a.y, b.y); ++y)
        for (std::int32_t x = std::min(a.x, b.x); x <= std::max(a.x, b.x); ++x)
          if (const auto v = layout.vertex_at({x, y})) vertices.push_back(*v);
      return vertices;
    }
    default:
      return {place.from, place.to};
  }
}

/// Of the k-th, from 0 on; nothing after 9 digits and 26 letters.
char number_of(std::size_t k) {
  if (k < 9) return static_cast<char>('1' + k);
  return k < 35 ? static_cast<char>('a' + (k - 9)) : '.';
}

}  // namespace

std::string draw_reasons(const Instance& instance, const Attribution& attribution,
                         const std::vector<Reason>& reasons, std::size_t max_sites) {
  const Graph& graph = instance.graph();
  if (!Sheet::is_small(graph)) return "";
  Sheet sheet(*graph.layout());
  bool is_empty = true;
  for (std::size_t k = 0; k < reasons.size(); ++k)
    for (std::size_t s = 0; s < std::min(max_sites, reasons[k].sites.size()); ++s)
      for (const VertexId v : vertices_of(graph, attribution.sites[reasons[k].sites[s]].place)) {
        sheet.mark_free(v, number_of(k));
        is_empty = false;
      }
  if (is_empty) return "";
  return sheet.text() + "(# blocked, . free, a number or letter: where that reason is)\n";
}

std::string draw_obstruction(const Instance& instance, const discrete::Feasibility& feasibility) {
  const Graph& graph = instance.graph();
  if (!Sheet::is_small(graph) || feasibility.vertices.empty()) return "";
  Sheet sheet(*graph.layout());
  for (std::size_t k = 0; k < std::min<std::size_t>(26, feasibility.agents.size()); ++k) {
    const auto& agent = instance.agents()[feasibility.agents[k]];
    sheet.at(agent.start) = static_cast<char>('a' + k);
    for (const VertexId goal : agent.goals.vertices())
      sheet.mark_free(goal, static_cast<char>('A' + k));
  }
  for (const VertexId v : feasibility.vertices) sheet.mark_free(v, '*');
  std::string names;
  for (std::size_t k = 0; k < std::min<std::size_t>(26, feasibility.agents.size()); ++k)
    names += fmt::format(", {} to {} agent {}", static_cast<char>('a' + k),
                         static_cast<char>('A' + k), feasibility.agents[k].index());
  return sheet.text() + "(# blocked, . free, * the place" + names + ")\n";
}

}  // namespace quadrille::cli
