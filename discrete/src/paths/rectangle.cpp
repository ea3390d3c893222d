// SPDX-License-Identifier: MIT
#include "paths/rectangle.hpp"

#include <utility>

namespace quadrille::discrete {
namespace {

/// One agent on its way through the rectangle.
struct Crossing {
  AgentId agent;
  const AgentDistances* distances;
  const Path* path;
  Timestep begin, end;  // of the part that only moves in the two directions
};

class RectangleFinder {
 public:
  RectangleFinder(const GridLayout& layout, Timestep t) : layout_(layout), t_(t) {}

  std::optional<Rectangle> find(Crossing a, Crossing b) {
    if (t_ == 0 || t_ >= length(a) || t_ >= length(b)) return std::nullopt;
    const Cell step_a = move(a, t_ - 1), step_b = move(b, t_ - 1);
    dx_ = step_a.x + step_b.x;
    dy_ = step_a.y + step_b.y;
    const bool a_moves = step_a != Cell{}, b_moves = step_b != Cell{};
    if (!a_moves || !b_moves || dx_ == 0 || dy_ == 0) return std::nullopt;  // not at right angles
    if (step_a.x == 0) std::swap(a, b);
    extend(a);
    extend(b);
    shrink(a, b);
    return build(a, b);
  }

 private:
  static Timestep length(const Crossing& c) { return static_cast<Timestep>(c.path->size()); }
  Cell cell(const Crossing& c, Timestep t) const {
    return layout_.cell_of((*c.path)[static_cast<std::size_t>(t)]);
  }
  Cell move(const Crossing& c, Timestep t) const {
    const Cell from = cell(c, t), to = cell(c, t + 1);
    return {to.x - from.x, to.y - from.y};
  }
  bool forward(const Crossing& c, Timestep t) const {
    const Cell step = move(c, t);
    return step == Cell{dx_, 0} || step == Cell{0, dy_};
  }
  void extend(Crossing& c) const {
    c.begin = c.end = t_;
    while (c.begin > 0 && forward(c, c.begin - 1)) --c.begin;
    while (c.end + 1 < length(c) && forward(c, c.end)) ++c.end;
  }
  // The horizontal agent enters through the column in which it begins and has to begin below the
  // row in which the vertical agent begins ("below" along dy), and so on. The vertex of the
  // conflict satisfies all of that.
  void shrink(Crossing& horizontal, Crossing& vertical) const {
    while (true) {
      const Cell h = cell(horizontal, horizontal.begin), v = cell(vertical, vertical.begin);
      if (dx_ * (v.x - h.x) < 0)
        ++vertical.begin;
      else if (dy_ * (h.y - v.y) < 0)
        ++horizontal.begin;
      else
        break;
    }
    while (true) {
      const Cell h = cell(horizontal, horizontal.end), v = cell(vertical, vertical.end);
      if (dx_ * (h.x - v.x) < 0)
        --vertical.end;
      else if (dy_ * (v.y - h.y) < 0)
        --horizontal.end;
      else
        break;
    }
  }

  std::optional<Rectangle> build(const Crossing& horizontal, const Crossing& vertical) const {
    const Cell from{cell(horizontal, horizontal.begin).x, cell(vertical, vertical.begin).y};
    const Cell to{cell(horizontal, horizontal.end).x, cell(vertical, vertical.end).y};
    const std::int32_t width = dx_ * (to.x - from.x), height = dy_ * (to.y - from.y);
    if (width == 0 && height == 0) return std::nullopt;
    const Cell meeting = cell(horizontal, t_);
    const Timestep start = t_ - dx_ * (meeting.x - from.x) - dy_ * (meeting.y - from.y);
    Rectangle rectangle{{side(horizontal, from, start, {0, dy_}, height),
                         side(horizontal, {to.x, from.y}, start + width, {0, dy_}, height),
                         side(vertical, from, start, {dx_, 0}, width),
                         side(vertical, {from.x, to.y}, start + height, {dx_, 0}, width)},
                        {horizontal.agent, vertical.agent, from.x, from.y, to.x, to.y, start}};
    for (const Rectangle::Side& s : rectangle.sides)
      if (s.visits.empty()) return std::nullopt;
    return rectangle;
  }

  Rectangle::Side side(const Crossing& c, Cell from, Timestep start, Cell step,
                       std::int32_t count) const {
    Rectangle::Side side{c.agent, {}, false};
    for (std::int32_t k = 0; k <= count; ++k) {
      const auto v = layout_.vertex_at({from.x + k * step.x, from.y + k * step.y});
      const Timestep t = start + k;
      if (!v || t < 0 || c.distances->from_start(*v) > t) continue;
      side.visits.push_back({*v, t});
      if (t == 0) side.inevitable = true;
    }
    return side;
  }

  const GridLayout& layout_;
  const Timestep t_;
  std::int32_t dx_ = 0, dy_ = 0;
};

}  // namespace

std::optional<Rectangle> find_rectangle(const GridLayout& layout, const AgentDistances& first,
                                        const AgentDistances& second, const PathIndex& paths,
                                        const Encounter& conflict) {
  const Crossing a{conflict.first, &first, &paths.path(conflict.first), 0, 0};
  const Crossing b{conflict.second, &second, &paths.path(conflict.second), 0, 0};
  return RectangleFinder(layout, conflict.timestep).find(a, b);
}

}  // namespace quadrille::discrete
