// SPDX-License-Identifier: MIT
//
// Pivot MDS (Brandes and Pich, Eigensolver methods for progressive multidimensional scaling of
// large data, 2007), and for small graphs stress majorisation from there (Gansner, Koren and North,
// Graph drawing by stress majorization, 2004).
#include <algorithm>
#include <array>
#include <cmath>

#include "scene.hpp"

namespace quadrille::view {
namespace {

constexpr std::size_t kMostPivots = 24;
/// Up to this many vertices all distances are looked at.
constexpr std::size_t kSmall = 400;
constexpr int kRounds = 80;

using Distances = std::vector<std::vector<double>>;  // of some vertices to all
using Vector = std::vector<double>;

/// What cannot be reached lies somewhat beyond what can.
Vector distances(const discrete::Graph& graph, VertexId source) {
  const auto moves = distances_from(graph, source);
  Timestep furthest = 0;
  for (const Timestep d : moves)
    if (d != discrete::kUnreachable) furthest = std::max(furthest, d);
  Vector result;
  for (const Timestep d : moves) result.push_back(d == discrete::kUnreachable ? furthest + 2 : d);
  return result;
}

/// Each pivot is as far as possible from those before it.
Distances pivot_distances(const discrete::Graph& graph, std::size_t count) {
  Distances result;
  Vector nearest(graph.num_vertices(), 1e9);
  std::size_t pivot = 0;
  while (result.size() < count) {
    result.push_back(distances(graph, VertexId(pivot)));
    for (std::size_t v = 0; v < nearest.size(); ++v)
      nearest[v] = std::min(nearest[v], result.back()[v]);
    pivot = static_cast<std::size_t>(std::max_element(nearest.begin(), nearest.end()) -
                                     nearest.begin());
  }
  return result;
}

/// Squared distances without their means by row and by column.
void centre(Distances& table) {
  const std::size_t n = table.front().size();
  Vector mean(n, 0);
  double all = 0;
  for (Vector& row : table)
    for (std::size_t v = 0; v < n; ++v) {
      row[v] *= row[v];
      mean[v] += row[v] / static_cast<double>(table.size());
    }
  for (const double m : mean) all += m / static_cast<double>(n);
  for (Vector& row : table) {
    double own = 0;
    for (const double value : row) own += value / static_cast<double>(n);
    for (std::size_t v = 0; v < n; ++v) row[v] = -0.5 * (row[v] - own - mean[v] + all);
  }
}

double dot(const Vector& a, const Vector& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// The two main directions of the rows, by power iteration; orthogonal.
std::array<Vector, 2> main_directions(const Distances& table) {
  const std::size_t k = table.size();
  Distances products(k, Vector(k));
  for (std::size_t a = 0; a < k; ++a)
    for (std::size_t b = 0; b < k; ++b) products[a][b] = dot(table[a], table[b]);
  std::array<Vector, 2> result;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    Vector v(k);
    for (std::size_t a = 0; a < k; ++a) v[a] = 1 + static_cast<double>((a * 7 + axis * 3) % 5);
    for (int round = 0; round < 100; ++round) {
      if (axis == 1) {
        const double along = dot(v, result[0]);
        for (std::size_t a = 0; a < k; ++a) v[a] -= along * result[0][a];
      }
      Vector next(k);
      for (std::size_t a = 0; a < k; ++a) next[a] = dot(products[a], v);
      const double length = std::sqrt(dot(next, next));
      if (length < 1e-12) break;
      for (std::size_t a = 0; a < k; ++a) v[a] = next[a] / length;
    }
    result[axis] = v;
  }
  return result;
}

std::vector<Position> project(const Distances& table, const std::array<Vector, 2>& directions) {
  std::vector<Position> result(table.front().size());
  for (std::size_t a = 0; a < table.size(); ++a)
    for (std::size_t v = 0; v < result.size(); ++v) {
      result[v].x += directions[0][a] * table[a][v];
      result[v].y += directions[1][a] * table[a][v];
    }
  return result;
}

/// Edges about one unit long.
void scale(const discrete::Graph& graph, std::vector<Position>& at) {
  double total = 0;
  std::size_t edges = 0;
  for (std::size_t v = 0; v < at.size(); ++v)
    for (const VertexId w : graph.neighbours(VertexId(v))) {
      total += std::hypot(at[v].x - at[w.index()].x, at[v].y - at[w.index()].y);
      ++edges;
    }
  const double factor = total > 1e-9 ? static_cast<double>(edges) / total : 1;
  for (Position& position : at) position = {position.x * factor, position.y * factor};
}

/// Moves each vertex to where its distances to all others want it, again and again.
void relax(const discrete::Graph& graph, std::vector<Position>& at) {
  const std::size_t n = at.size();
  Distances wanted;
  for (std::size_t v = 0; v < n; ++v) wanted.push_back(distances(graph, VertexId(v)));
  for (int round = 0; round < kRounds; ++round)
    for (std::size_t v = 0; v < n; ++v) {
      double x = 0, y = 0, weights = 0;
      for (std::size_t w = 0; w < n; ++w) {
        if (v == w) continue;
        double dx = at[v].x - at[w].x, dy = at[v].y - at[w].y;
        double length = std::hypot(dx, dy);
        if (length < 1e-6) {
          // Two in one place: apart, in a direction that depends on which they are.
          dx = std::cos(static_cast<double>(v));
          dy = std::sin(static_cast<double>(v));
          length = 1;
        }
        const double weight = 1 / (wanted[v][w] * wanted[v][w]);
        x += weight * (at[w].x + wanted[v][w] * dx / length);
        y += weight * (at[w].y + wanted[v][w] * dy / length);
        weights += weight;
      }
      if (weights > 0) at[v] = {x / weights, y / weights};
    }
}

}  // namespace

std::vector<Position> lay_out(const discrete::Graph& graph) {
  const std::size_t n = graph.num_vertices();
  if (n < 2) return std::vector<Position>(n);
  Distances table = pivot_distances(graph, std::min(n, kMostPivots));
  centre(table);
  std::vector<Position> at = project(table, main_directions(table));
  scale(graph, at);
  if (n <= kSmall) relax(graph, at);
  return at;
}

}  // namespace quadrille::view
