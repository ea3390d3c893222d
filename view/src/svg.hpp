// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "scene.hpp"

namespace quadrille::view {

/// The text of HTML and XML. Control characters and bytes that are no UTF-8 are replaced: files may
/// have such names.
[[nodiscard]] std::string escaped(std::string_view text);

/// Okabe and Ito's colours, as in view/page/palette.js.
[[nodiscard]] std::string_view agent_colour(std::size_t index);

inline constexpr std::string_view kInk = "#1b1f24", kFaint = "#59636e", kLine = "#c6ccd2";
inline constexpr std::string_view kWaits = "#d55e00", kMoves = "#56b4e9";

/// With at most two digits after the point: a hundredth of a pixel.
[[nodiscard]] std::string pixels(double value);

/// An SVG picture that is written from top to bottom. Sizes are in pixels, y goes down.
class Svg {
 public:
  /// `title` may be empty; it is what those hear who do not see the picture.
  Svg(double width, double height, std::string_view title);

  /// `style`: attributes, such as `fill="none"`.
  void rectangle(double x, double y, double width, double height, std::string_view style);
  void circle(Position centre, double radius, std::string_view style);
  /// A line through the points, or a polygon around them.
  void line(const std::vector<Position>& points, std::string_view style);
  void polygon(const std::vector<Position>& points, std::string_view style);
  void path(std::string_view steps, std::string_view style);
  /// `anchor`: start, middle or end.
  void text(Position at, std::string_view anchor, double size, std::string_view text,
            std::string_view style = "");
  [[nodiscard]] std::string finish() &&;

 private:
  std::string out_;
};

/// The agents of a picture; each has a path or not.
using Chosen = std::vector<std::size_t>;
[[nodiscard]] std::string draw_map(const Scene& scene, const Chosen& chosen,
                                   std::string_view title);
[[nodiscard]] std::string draw_space_time(const Scene& scene, const Chosen& chosen,
                                          std::string_view title);
[[nodiscard]] std::string draw_waits(const Scene& scene, const Chosen& chosen,
                                     std::string_view title);

}  // namespace quadrille::view
