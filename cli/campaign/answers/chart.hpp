// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace quadrille::cli::campaign {

/// Text as it has to stand in HTML and SVG: control characters are those of terminal_text.
[[nodiscard]] std::string escaped(const std::string& text);

/// One axis: its range, linear or logarithmic (then both ends are positive), and what it shows.
struct Axis {
  std::string label;
  double from = 0, to = 1;
  bool logarithmic = false;
};

/// A figure with two axes and curves, as SVG.
class Chart {
 public:
  using Point = std::pair<double, double>;

  Chart(std::string title, Axis x, Axis y) : title_(std::move(title)), x_(x), y_(y) {}

  /// A curve in the colour number `style`. Points outside the axes are moved to their ends.
  void add_curve(const std::string& name, std::size_t style, std::vector<Point> points,
                 bool markers);
  /// The element <svg>. The size in pixels is that of the axes and what belongs to them; a title of
  /// several lines and the legend, whose names are broken where they are too long, add to the
  /// height.
  [[nodiscard]] std::string svg(double width, double height) const;

 private:
  struct Curve {
    std::string name;
    std::size_t style;
    std::vector<Point> points;
    bool markers;
  };
  /// From `y` downwards, which is moved behind it.
  [[nodiscard]] std::string legend(double width, double& y) const;

  std::string title_;
  Axis x_, y_;
  std::vector<Curve> curves_;
};

}  // namespace quadrille::cli::campaign
