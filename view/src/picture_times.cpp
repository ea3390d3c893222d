// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "svg.hpp"

namespace quadrille::view {
namespace {

constexpr double kWidth = 760, kLeft = 54, kRight = 34, kTop = 14, kBottom = 40;

std::string fill(std::string_view colour) { return "fill=\"" + std::string(colour) + "\""; }
std::string stroke(std::string_view colour, double width) {
  return "stroke=\"" + std::string(colour) + "\" stroke-width=\"" + pixels(width) + "\"";
}

/// A number that people like to read, about a tenth of the span.
double tick_step(double span) {
  const double power = std::pow(10, std::floor(std::log10(std::max(span, 1e-9) / 8)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power * 8 >= span) return factor * power;
  return 10 * power;
}

std::string short_number(double value) {
  std::string text = std::to_string(value);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text;
}

/// The axis of time below a picture of this height, and what it needs.
class TimeAxis {
 public:
  TimeAxis(const Scene& scene, double height) : scene_(scene), height_(height) {
    for (const SceneAgent& agent : scene.agents)
      if (agent.cost) end_ = std::max(end_, static_cast<double>(*agent.cost));
  }
  [[nodiscard]] double x(double time) const {
    return kLeft + time / end_ * (kWidth - kLeft - kRight);
  }
  [[nodiscard]] double end() const { return end_; }
  void draw(Svg& svg) const {
    const double bottom = kTop + height_;
    const double step = tick_step(end_ * scene_.time_unit);
    const double now = static_cast<double>(scene_.now) * scene_.time_unit;
    for (int k = 0; k * step <= end_ * scene_.time_unit * (1 + 1e-9); ++k) {
      const double at = x(k * step / scene_.time_unit);
      svg.line({{at, kTop}, {at, bottom + 4}}, stroke(kLine, 0.75));
      svg.text({at, bottom + 17}, "middle", 12, short_number(now + k * step), fill(kInk));
    }
    svg.text({(kLeft + kWidth - kRight) / 2, bottom + 34}, "middle", 12,
             scene_.is_continuous ? "time" : "timestep", fill(kFaint));
  }

 private:
  const Scene& scene_;
  double height_;
  double end_ = 1;
};

/// How far along the path each place of it is, first time round; and the whole length.
struct Along {
  std::map<std::size_t, double> at;
  double length = 0;

  Along(const Scene& scene, const SceneAgent& agent) {
    for (std::size_t k = 0; k < agent.stops.size(); ++k) {
      if (k > 0) {
        const Position a = scene.places[agent.stops[k - 1].place];
        const Position b = scene.places[agent.stops[k].place];
        length += std::hypot(b.x - a.x, b.y - a.y, b.z - a.z);
      }
      at.emplace(agent.stops[k].place, length);
    }
    if (length == 0) length = 1;
  }
};

/// The stretches of an agent's path that lie on another one: points of time and way.
std::vector<std::vector<Position>> stretches(const SceneAgent& agent, const Along& along,
                                             double end) {
  std::vector<std::vector<Position>> result(1);
  for (std::size_t k = 0; k < agent.stops.size(); ++k) {
    const SceneStop& stop = agent.stops[k];
    const auto found = along.at.find(stop.place);
    if (found == along.at.end()) {
      result.emplace_back();
      continue;
    }
    const bool is_last = k + 1 == agent.stops.size();
    const double depart = is_last ? end : static_cast<double>(stop.depart);
    result.back().push_back({static_cast<double>(stop.arrive), found->second});
    if (depart > static_cast<double>(stop.arrive)) result.back().push_back({depart, found->second});
  }
  return result;
}

}  // namespace

std::string draw_space_time(const Scene& scene, const Chosen& chosen, std::string_view title) {
  constexpr double kHeight = 340;
  Svg svg(kWidth, kTop + kHeight + kBottom, title);
  const TimeAxis axis(scene, kHeight);
  axis.draw(svg);
  if (chosen.empty()) return std::move(svg).finish();
  const Along along(scene, scene.agents[chosen.front()]);
  const double unit = scene.length_unit;
  const auto y = [&](double way) { return kTop + kHeight * (1 - way / along.length); };
  const double step = tick_step(along.length * unit);
  for (int k = 0; k * step <= along.length * unit * (1 + 1e-9); ++k) {
    const double at = y(k * step / unit);
    svg.line({{kLeft - 4, at}, {kWidth - kRight, at}}, stroke(kLine, 0.75));
    svg.text({kLeft - 8, at + 4}, "end", 12, short_number(k * step), fill(kInk));
  }
  const double middle = kTop + kHeight / 2;
  svg.text({14, middle}, "middle", 12,
           "way along the path of agent " + std::to_string(chosen.front()),
           fill(kFaint) + " transform=\"rotate(-90 14 " + pixels(middle) + ")\"");
  for (auto it = chosen.rbegin(); it != chosen.rend(); ++it) {
    const bool is_first = it + 1 == chosen.rend();
    for (const auto& stretch : stretches(scene.agents[*it], along, axis.end())) {
      if (stretch.empty()) continue;
      std::vector<Position> points;
      for (const Position& p : stretch) points.push_back({axis.x(p.x), y(p.y)});
      if (points.size() == 1) {
        svg.circle(points[0], 2.5, fill(agent_colour(*it)));
        continue;
      }
      svg.line(points, stroke(agent_colour(*it), is_first ? 3.5 : 2) +
                           " stroke-linejoin=\"round\" stroke-linecap=\"round\"");
      svg.text({points.back().x + 4, points.back().y - 4}, "start", 12, std::to_string(*it),
               fill(kInk));
    }
  }
  return std::move(svg).finish();
}

std::string draw_waits(const Scene& scene, const Chosen& chosen, std::string_view title) {
  constexpr double kMostHeight = 2000;
  const double row =
      std::clamp(kMostHeight / std::max<double>(1, static_cast<double>(chosen.size())), 2.0, 18.0);
  const double height = row * static_cast<double>(chosen.size());
  constexpr double kLegend = 22;
  Svg svg(kWidth, kTop + height + kBottom + kLegend, title);
  const TimeAxis axis(scene, height);
  axis.draw(svg);
  double top = kTop;
  for (const std::size_t i : chosen) {
    const SceneAgent& agent = scene.agents[i];
    const double inset = row >= 6 ? 2 : 0;
    const auto bar = [&](std::int64_t from, std::int64_t to, std::string_view colour) {
      if (to <= from) return;
      const double x = axis.x(static_cast<double>(from));
      svg.rectangle(x, top + inset, axis.x(static_cast<double>(to)) - x, row - 2 * inset,
                    fill(colour));
    };
    if (agent.cost) bar(0, *agent.cost, kMoves);
    for (std::size_t k = 0; k + 1 < agent.stops.size(); ++k)
      bar(agent.stops[k].arrive, agent.stops[k].depart, kWaits);
    if (row >= 10)
      svg.text({kLeft - 8, top + 0.72 * row}, "end", std::min(12.0, 0.8 * row), std::to_string(i),
               fill(kInk));
    top += row;
  }
  const double legend = top + kBottom + 4;
  svg.rectangle(kLeft, legend, 14, 10, fill(kMoves));
  svg.text({kLeft + 20, legend + 9}, "start", 12, "moves", fill(kInk));
  svg.rectangle(kLeft + 80, legend, 14, 10, fill(kWaits));
  svg.text({kLeft + 100, legend + 9}, "start", 12, "waits", fill(kInk));
  return std::move(svg).finish();
}

}  // namespace quadrille::view
