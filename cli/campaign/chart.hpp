// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace quadrille::cli::campaign {

/// Text as it has to stand in HTML and SVG.
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
  /// The element <svg>, of the given size in pixels.
  [[nodiscard]] std::string svg(double width, double height) const;

 private:
  struct Curve {
    std::string name;
    std::size_t style;
    std::vector<Point> points;
    bool markers;
  };
  std::string title_;
  Axis x_, y_;
  std::vector<Curve> curves_;
};

}  // namespace quadrille::cli::campaign
