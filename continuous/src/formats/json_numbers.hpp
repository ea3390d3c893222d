// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "quadrille/continuous/quantise.hpp"
#include "quadrille/continuous/resolution.hpp"
#include "quadrille/core/decimal.hpp"
#include "quadrille/text/document.hpp"

namespace quadrille::continuous {

/// The shortest decimal number that is read as the same double, which has to be finite.
[[nodiscard]] inline std::string json_number(double value) { return decimal(value); }

/// A number, or an object with one number for each of length and time.
[[nodiscard]] inline std::string resolution_json(const Resolution& resolution) {
  if (resolution.is_uniform()) return json_number(resolution.length);
  return "{\"length\": " + json_number(resolution.length) +
         ", \"time\": " + json_number(resolution.time) + "}";
}

/// [x, y], or [x, y, z] where not all is in the plane.
[[nodiscard]] inline std::string point_json(const Point& point, bool is_flat,
                                            const Resolution& resolution) {
  const auto number = [&](Length length) {
    return json_number(in_input_units(length, resolution));
  };
  return "[" + number(point.x) + ", " + number(point.y) +
         (is_flat ? "]" : ", " + number(point.z) + "]");
}

/// Reads what `resolution_json` writes.
inline bool read_resolution(const text::Document& document, text::Checker& check,
                            text::Document::Node node, Resolution& resolution) {
  const auto number = [&](text::Document::Node value, double& size) {
    if (!check.number(value, size)) return false;
    return size > 0 || check.fail(value, ErrorCode::out_of_range, "a resolution is positive");
  };
  if (document.kind(node) != text::Document::Kind::object) {
    double both = 0;
    if (!number(node, both)) return false;
    resolution = both;
    return true;
  }
  std::optional<text::Document::Node> length, time;
  return check.members(node, {{"length", &length}, {"time", &time}}) &&
         number(*length, resolution.length) && number(*time, resolution.time);
}

}  // namespace quadrille::continuous
