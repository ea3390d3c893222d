// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <variant>

#include "svg.hpp"

namespace quadrille::view {
namespace {

constexpr double kSide = 760;   // of the longer side of the map
constexpr double kMargin = 12;  // around the map
constexpr double kLargestCell = 48;
constexpr double kCellRadius = 0.36;  // of an agent, in cells

std::string fill(std::string_view colour) { return "fill=\"" + std::string(colour) + "\""; }
std::string stroke(std::string_view colour, double width) {
  return "stroke=\"" + std::string(colour) + "\" stroke-width=\"" + pixels(width) + "\"";
}

class MapPicture {
 public:
  MapPicture(const Scene& scene, const Chosen& chosen) : scene_(scene), chosen_(chosen) {
    measure();
  }

  [[nodiscard]] std::string draw(std::string_view title) const {
    Svg svg((right_ - left_) * scale_ + 2 * kMargin, (bottom_ - top_) * scale_ + 2 * kMargin,
            title);
    if (scene_.cells)
      draw_cells(svg, *scene_.cells);
    else
      draw_links(svg);
    for (const std::size_t i : chosen_) draw_path(svg, i);
    for (const std::size_t i : chosen_) draw_goal(svg, i);
    for (const std::size_t i : chosen_) draw_start(svg, i);
    return std::move(svg).finish();
  }

 private:
  void include(Position p, double margin) {
    left_ = std::min(left_, p.x - margin);
    right_ = std::max(right_, p.x + margin);
    top_ = std::min(top_, p.y - margin);
    bottom_ = std::max(bottom_, p.y + margin);
  }

  void measure() {
    double cell = 1;
    if (scene_.cells) {
      cell = scene_.cells->pitch;
      include({0, 0}, 0.5 * cell);
      include({(scene_.cells->width - 1) * cell, (scene_.cells->height - 1) * cell}, 0.5 * cell);
    }
    for (const Position& place : scene_.places) include(place, 0);
    for (const SceneAgent& agent : scene_.agents)
      for (const std::size_t place : {agent.start, agent.goal})
        include(scene_.places[place], scene_.cells ? 0 : reach(agent));
    if (left_ > right_) left_ = top_ = 0, right_ = bottom_ = 1;
    const double side = std::max({right_ - left_, bottom_ - top_, 1e-9});
    scale_ = kSide / side;
    if (scene_.cells) scale_ = std::min(scale_, kLargestCell / cell);
  }

  [[nodiscard]] double reach(const SceneAgent& agent) const {
    if (scene_.bodies.empty()) return kCellRadius;
    return static_cast<double>(geometry::enclosing_radius(scene_.bodies[agent.body]).value());
  }

  [[nodiscard]] Position on_page(Position p) const {
    const double y = scene_.y_up ? bottom_ - p.y : p.y - top_;
    return {(p.x - left_) * scale_ + kMargin, y * scale_ + kMargin};
  }

  void draw_cells(Svg& svg, const Cells& cells) const {
    const double size = cells.pitch * scale_;
    std::string blocked;
    for (std::int32_t y = 0; y < cells.height; ++y) {
      const auto is_blocked = [&](std::int32_t x) {
        return !cells.passable[static_cast<std::size_t>(y) * static_cast<std::size_t>(cells.width) +
                               static_cast<std::size_t>(x)];
      };
      for (std::int32_t x = 0; x < cells.width; ++x) {
        if (!is_blocked(x)) continue;
        const std::int32_t from = x;
        while (x + 1 < cells.width && is_blocked(x + 1)) ++x;
        const Position corner = on_page({(from - 0.5) * cells.pitch, (y - 0.5) * cells.pitch});
        const std::string width = pixels((x + 1 - from) * size);
        blocked += "M" + pixels(corner.x) + " " + pixels(corner.y) + "h" + width + "v" +
                   pixels(size) + "h-" + width + "z";
      }
    }
    draw_grid(svg, cells);
    if (!blocked.empty()) svg.path(blocked, fill(kFaint));
  }

  void draw_grid(Svg& svg, const Cells& cells) const {
    const Position a = on_page({-0.5 * cells.pitch, -0.5 * cells.pitch});
    const Position b =
        on_page({(cells.width - 0.5) * cells.pitch, (cells.height - 0.5) * cells.pitch});
    svg.rectangle(a.x, a.y, b.x - a.x, b.y - a.y, fill("none") + " " + stroke(kFaint, 1));
    const double size = cells.pitch * scale_;
    if (size < 8) return;
    std::string lines;
    for (std::int32_t x = 1; x < cells.width; ++x)
      lines += "M" + pixels(a.x + x * size) + " " + pixels(a.y) + "V" + pixels(b.y);
    for (std::int32_t y = 1; y < cells.height; ++y)
      lines += "M" + pixels(a.x) + " " + pixels(a.y + y * size) + "H" + pixels(b.x);
    if (!lines.empty()) svg.path(lines, stroke(kLine, 0.5));
  }

  void draw_links(Svg& svg) const {
    std::string lines;
    for (const Link& link : scene_.links) {
      const Position a = on_page(scene_.places[link.from]), b = on_page(scene_.places[link.to]);
      lines += "M" + pixels(a.x) + " " + pixels(a.y) + "L" + pixels(b.x) + " " + pixels(b.y);
    }
    if (!lines.empty()) svg.path(lines, stroke(kLine, 1));
    for (const Position& place : scene_.places) svg.circle(on_page(place), 1.5, fill(kFaint));
  }

  /// Paths that share a way lie beside each other.
  [[nodiscard]] Position beside(Position p, std::size_t i) const {
    const double shift =
        (static_cast<double>(i % 5) - 2) * 0.12 * std::min(reach(scene_.agents[i]) * scale_, 16.0);
    const Position at = on_page(p);
    return {at.x + shift, at.y + shift};
  }

  void draw_path(Svg& svg, std::size_t i) const {
    const SceneAgent& agent = scene_.agents[i];
    std::vector<Position> points;
    for (std::size_t k = 0; k < agent.stops.size(); ++k) {
      const Position at = scene_.places[agent.stops[k].place];
      if (k > 0 && k + 1 < agent.stops.size() &&
          is_between(scene_.places[agent.stops[k - 1].place], at,
                     scene_.places[agent.stops[k + 1].place]))
        continue;
      points.push_back(beside(at, i));
    }
    const double width = std::clamp(0.25 * reach(agent) * scale_, 1.0, 3.0);
    if (points.size() > 1)
      svg.line(points, stroke(agent_colour(i), width) + " stroke-linejoin=\"round\"");
    for (const SceneStop& stop : agent.stops)
      if (stop.depart > stop.arrive)
        svg.circle(beside(scene_.places[stop.place], i), 1.6 * width, fill(agent_colour(i)));
  }

  static bool is_between(Position a, Position b, Position c) {
    const double cross = (b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x);
    const double along = (b.x - a.x) * (c.x - b.x) + (b.y - a.y) * (c.y - b.y);
    return cross == 0 && along > 0;
  }

  /// The body, one of the scene's, or a disc where bodies have no size.
  void draw_body(Svg& svg, std::size_t i, std::size_t place, std::size_t body, double share,
                 const std::string& style) const {
    const SceneAgent& agent = scene_.agents[i];
    const Position at = scene_.places[place];
    if (!scene_.bodies.empty()) {
      if (const auto* shape = std::get_if<continuous::ConvexPolygon>(&scene_.bodies[body])) {
        std::vector<Position> corners;
        for (const continuous::Point& corner : shape->vertices())
          corners.push_back(on_page({at.x + share * static_cast<double>(corner.x.value()),
                                     at.y + share * static_cast<double>(corner.y.value())}));
        svg.polygon(corners, style);
        return;
      }
    }
    const double pitch = scene_.cells && scene_.bodies.empty() ? scene_.cells->pitch : 1;
    svg.circle(on_page(at), std::max(1.5, share * reach(agent) * pitch * scale_), style);
  }

  void draw_goal(Svg& svg, std::size_t i) const {
    draw_body(svg, i, scene_.agents[i].goal, scene_.agents[i].goal_body, 1,
              "fill=\"#ffffff\" fill-opacity=\"0.75\" stroke-dasharray=\"4 2\" " +
                  stroke(agent_colour(i), 2));
    draw_heading(svg, i, scene_.agents[i].goal, agent_colour(i));
    label(svg, i, scene_.agents[i].goal, kInk);
  }

  /// An arrow head at the front.
  void draw_heading(Svg& svg, std::size_t i, std::size_t place, std::string_view colour) const {
    if (scene_.headings.empty()) return;
    const double angle = scene_.headings[place] * std::numbers::pi / 180;
    const double ahead = std::cos(angle), aside = std::sin(angle);
    const double radius = reach(scene_.agents[i]);
    const Position at = scene_.places[place];
    std::vector<Position> corners;
    for (const auto& [far, left] : {std::pair(0.95, 0.0), {0.6, 0.35}, {0.6, -0.35}})
      corners.push_back(on_page({at.x + radius * (far * ahead - left * aside),
                                 at.y + radius * (far * aside + left * ahead)}));
    svg.polygon(corners, fill(colour));
  }

  void draw_start(Svg& svg, std::size_t i) const {
    draw_body(svg, i, scene_.agents[i].start, scene_.agents[i].body, 1, fill(agent_colour(i)));
    const std::string_view colour = agent_colour(i);
    const bool is_dark = colour == "#0072b2" || colour == "#009e73" || colour == "#d55e00";
    draw_heading(svg, i, scene_.agents[i].start, is_dark ? "#ffffff" : kInk);
    label(svg, i, scene_.agents[i].start, is_dark ? "#ffffff" : kInk);
  }

  void label(Svg& svg, std::size_t i, std::size_t place, std::string_view colour) const {
    const double size = std::min(reach(scene_.agents[i]) * scale_, 15.0);
    if (size < 7) return;
    const Position at = on_page(scene_.places[place]);
    svg.text({at.x, at.y + 0.36 * size}, "middle", size, std::to_string(i), fill(colour));
  }

  const Scene& scene_;
  const Chosen& chosen_;
  double left_ = std::numeric_limits<double>::infinity(), right_ = -left_;
  double top_ = left_, bottom_ = -left_;
  double scale_ = 1;
};

}  // namespace

std::string draw_map(const Scene& scene, const Chosen& chosen, std::string_view title) {
  return MapPicture(scene, chosen).draw(title);
}

}  // namespace quadrille::view
