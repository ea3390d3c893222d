// SPDX-License-Identifier: MIT
#include "quadrille/continuous/generator.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/areas.hpp"
#include "quadrille/core/random.hpp"

namespace quadrille::continuous {
namespace {

/// Darts that are thrown for one vertex before the area counts as full.
constexpr int kMaxDarts = 1000;

Error out_of_range(const std::string& message) { return {ErrorCode::out_of_range, message, {}}; }

std::optional<Error> check(const RandomInstanceOptions& options) {
  if (options.num_vertices < 1 || options.num_vertices > kMaxRandomVertices)
    return out_of_range("the number of vertices is 1 .. " + std::to_string(kMaxRandomVertices));
  if (options.num_agents > options.num_vertices)
    return out_of_range(std::to_string(options.num_agents) + " agents need as many vertices");
  for (const Length side : {options.width, options.height})
    if (side < 1 || side > geometry::kMaxLength)
      return out_of_range("the area is 1 .. " + std::to_string(geometry::kMaxLength.value()) +
                          " length units wide and high");
  if (options.altitude < 0 || options.altitude > geometry::kMaxLength)
    return out_of_range("the altitude is 0 .. " + std::to_string(geometry::kMaxLength.value()) +
                        " length units");
  if (options.radius < 1 || options.radius > geometry::kMaxLength / 4)
    return out_of_range("the radius is 1 .. " + std::to_string((geometry::kMaxLength / 4).value()) +
                        " length units");
  if (options.reach && (*options.reach < 1 || *options.reach > geometry::kMaxLength))
    return out_of_range("the reach is 1 .. " + std::to_string(geometry::kMaxLength.value()) +
                        " length units");
  if (options.speed < 1 || options.speed > kMaxSpeed)
    return out_of_range("the speed is 1 .. " + std::to_string(kMaxSpeed.value()) +
                        " millionths of a length unit per tick");
  return std::nullopt;
}

/// Points by the squares of a grid that they are above or in: to find those that are near.
class Squares {
 public:
  /// For points of the area, and distances of about `distance`.
  Squares(Length width, Length height, Length distance)
      : side_(std::max(
            {distance.value(), width.value() / kMaxPerSide + 1, height.value() / kMaxPerSide + 1})),
        columns_(width.value() / side_ + 1),
        rows_(height.value() / side_ + 1),
        points_(static_cast<std::size_t>(columns_ * rows_)) {}

  void add(const Point& point, std::size_t index) {
    points_[place(column(point), row(point))].push_back(index);
  }
  /// Calls `visit` with all that are no further than `distance` from the point, and others.
  template <class Visit>
  void near(const Point& point, Length distance, const Visit& visit) const {
    const std::int64_t reach = distance.value() / side_ + 1;
    const std::int64_t last_column = std::min(column(point) + reach, columns_ - 1);
    const std::int64_t last_row = std::min(row(point) + reach, rows_ - 1);
    for (std::int64_t r = std::max<std::int64_t>(row(point) - reach, 0); r <= last_row; ++r)
      for (std::int64_t c = std::max<std::int64_t>(column(point) - reach, 0); c <= last_column; ++c)
        for (const std::size_t index : points_[place(c, r)]) visit(index);
  }

 private:
  static constexpr std::int64_t kMaxPerSide = 300;
  [[nodiscard]] std::int64_t column(const Point& point) const { return point.x.value() / side_; }
  [[nodiscard]] std::int64_t row(const Point& point) const { return point.y.value() / side_; }
  [[nodiscard]] std::size_t place(std::int64_t column, std::int64_t row) const {
    return static_cast<std::size_t>(row * columns_ + column);
  }

  const std::int64_t side_, columns_, rows_;
  std::vector<std::vector<std::size_t>> points_;
};

/// Random points that are 2 sqrt(2) radius apart, fewer than wanted if they do not fit.
std::vector<Point> draw_vertices(const RandomInstanceOptions& options, Random& random) {
  const Area spacing2 = 8 * square(options.radius);
  const auto coordinate = [&](Length side) {
    return Length(
        static_cast<std::int64_t>(random.below(static_cast<std::uint64_t>(side.value()) + 1)));
  };
  std::vector<Point> vertices;
  const Length spacing = 3 * options.radius;  // or less
  Squares squares(options.width, options.height, spacing);
  while (vertices.size() < options.num_vertices) {
    bool fits = false;
    for (int dart = 0; dart < kMaxDarts && !fits; ++dart) {
      const Length x = coordinate(options.width);
      const Length y = coordinate(options.height);
      const Point point{x, y, options.altitude > 0 ? coordinate(options.altitude) : Length{0}};
      fits = true;
      squares.near(point, spacing, [&](std::size_t other) {
        if (squared_distance(point, vertices[other]) < spacing2) fits = false;
      });
      if (!fits) continue;
      squares.add(point, vertices.size());
      vertices.push_back(point);
    }
    if (!fits) break;
  }
  return vertices;
}

std::vector<Edge> gabriel_edges(const std::vector<Point>& vertices) {
  std::vector<Edge> edges;
  std::vector<std::size_t> others(vertices.size());
  for (std::size_t u = 0; u < vertices.size(); ++u) {
    std::iota(others.begin(), others.end(), std::size_t{0});
    // The nearest first: most pairs are separated by a neighbour of u.
    std::sort(others.begin(), others.end(), [&](std::size_t a, std::size_t b) {
      return std::pair(squared_distance(vertices[u], vertices[a]), a) <
             std::pair(squared_distance(vertices[u], vertices[b]), b);
    });
    std::vector<std::size_t> neighbours;
    for (std::size_t rank = 1; rank < others.size(); ++rank) {
      const std::size_t v = others[rank];
      // A vertex in the disc is nearer to u than v is.
      const bool is_separated = std::any_of(
          others.begin() + 1, others.begin() + static_cast<std::ptrdiff_t>(rank),
          [&](std::size_t w) { return dot(vertices[u], vertices[v], vertices[w]) <= 0; });
      if (!is_separated) neighbours.push_back(v);
    }
    std::sort(neighbours.begin(), neighbours.end());
    for (const std::size_t v : neighbours)
      edges.push_back({VertexId(u), VertexId(v), std::nullopt});
  }
  return edges;
}

/// In both directions between all that are no further apart; nullopt if they are too many.
std::optional<std::vector<Edge>> edges_within(Length reach, const RandomInstanceOptions& options,
                                              const std::vector<Point>& vertices) {
  Squares squares(options.width, options.height, reach);
  for (std::size_t v = 0; v < vertices.size(); ++v) squares.add(vertices[v], v);
  const Area reach2 = square(reach);
  std::vector<Edge> edges;
  std::vector<std::size_t> neighbours;
  for (std::size_t u = 0; u < vertices.size(); ++u) {
    neighbours.clear();
    squares.near(vertices[u], reach, [&](std::size_t v) {
      if (v != u && squared_distance(vertices[u], vertices[v]) <= reach2) neighbours.push_back(v);
    });
    if (edges.size() + neighbours.size() > kMaxRandomEdges) return std::nullopt;
    std::sort(neighbours.begin(), neighbours.end());
    for (const std::size_t v : neighbours)
      edges.push_back({VertexId(u), VertexId(v), std::nullopt});
  }
  return edges;
}

/// A convex polygon with four to eight corners on the circle, one or two in each quadrant; a disc
/// if the circle is too small for the grid of whole units. In integers, hence the same everywhere:
/// for t in [0, 1), (1 - t^2, 2 t) / (1 + t^2) is a point of the circle's first quadrant.
Body draw_polygon(Length radius, Random& random) {
  constexpr std::int64_t kSteps = 1000;
  const auto corner = [&](std::int64_t t) {
    const std::int64_t whole = kSteps * kSteps + t * t;
    const auto part = [&](std::int64_t share) {
      return Length(static_cast<std::int64_t>(Area{radius.value()} * share / whole));
    };
    return Point{part(kSteps * kSteps - t * t), part(2 * kSteps * t)};
  };
  std::vector<Point> corners;
  for (int quadrant = 0; quadrant < 4; ++quadrant) {
    std::vector<std::int64_t> places{static_cast<std::int64_t>(random.below(kSteps / 3))};
    if (random.below(2) == 1)
      places.push_back(kSteps / 2 + static_cast<std::int64_t>(random.below(kSteps / 3)));
    for (const std::int64_t t : places) {
      Point p = corner(t);
      for (int turn = 0; turn < quadrant; ++turn) p = {-p.y, p.x};
      corners.push_back(p);
    }
  }
  auto polygon = ConvexPolygon::make(std::move(corners));
  if (polygon) return std::move(polygon).value();
  return Disc{radius};
}

std::vector<Agent> draw_agents(const RandomInstanceOptions& options, Random& random) {
  std::vector<std::size_t> starts(options.num_vertices), goals(options.num_vertices);
  std::iota(starts.begin(), starts.end(), std::size_t{0});
  std::iota(goals.begin(), goals.end(), std::size_t{0});
  random.shuffle_front(starts, options.num_agents);
  random.shuffle_front(goals, options.num_agents);
  const auto upper_half = [&](std::int64_t most) {
    const std::int64_t least = (most + 1) / 2;
    return least +
           static_cast<std::int64_t>(random.below(static_cast<std::uint64_t>(most - least) + 1));
  };
  std::vector<Agent> agents;
  for (std::size_t i = 0; i < options.num_agents; ++i) {
    Agent agent{VertexId(starts[i]), VertexId(goals[i]), Disc{options.radius}, options.speed};
    if (options.mixed) {
      const Length radius(upper_half(options.radius.value()));
      agent.speed = Speed(upper_half(options.speed.value()));
      const bool is_disc = options.altitude > 0 || random.below(2) == 0;
      agent.body = is_disc ? Body(Disc{radius}) : draw_polygon(radius, random);
    }
    agents.push_back(agent);
  }
  return agents;
}

}  // namespace

Result<Instance> random_instance(const RandomInstanceOptions& options, std::uint64_t seed) {
  if (auto error = check(options)) return *error;
  Random random(seed);
  std::vector<Point> vertices = draw_vertices(options, random);
  if (vertices.size() < options.num_vertices)
    return out_of_range(std::to_string(options.num_vertices) +
                        " vertices do not fit into the area at that radius; " +
                        std::to_string(vertices.size()) + " did");
  std::optional<std::vector<Edge>> edges =
      options.reach ? edges_within(*options.reach, options, vertices) : gabriel_edges(vertices);
  if (!edges)
    return out_of_range("more than " + std::to_string(kMaxRandomEdges) +
                        " edges are within that reach");
  auto roadmap = Roadmap::make(std::move(vertices), *std::move(edges));
  if (!roadmap) return roadmap.error();
  return Instance::make(std::make_shared<const Roadmap>(std::move(roadmap).value()),
                        draw_agents(options, random), options.resolution);
}

}  // namespace quadrille::continuous
