// SPDX-License-Identifier: MIT
#include "campaign/answers/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "quadrille/core/terminal_text.hpp"

namespace quadrille::cli::campaign {
namespace {

/// Colours that people who see colours differently can tell apart, and dashes for the second round.
constexpr std::array kColours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                 "#e69f00", "#56b4e9", "#555555"};
constexpr std::array kDashes = {"", "6 3", "2 2"};
constexpr double kLeft = 52, kRight = 12, kTop = 28, kBottom = 42, kLegendLine = 16;
constexpr double kLegendText = kLeft + 30;  // where the names begin

struct Scale {
  Axis axis;
  double from, to;  // pixels

  [[nodiscard]] double operator()(double value) const {
    const double inside = std::clamp(value, axis.from, axis.to);
    const double share = axis.logarithmic
                             ? std::log(inside / axis.from) / std::log(axis.to / axis.from)
                             : (inside - axis.from) / (axis.to - axis.from);
    return from + share * (to - from);
  }
};

/// Round values inside the axis, not many.
std::vector<double> ticks(const Axis& axis) {
  std::vector<double> values;
  if (axis.logarithmic) {
    for (double power = std::pow(10, std::ceil(std::log10(axis.from) - 1e-9));
         power <= axis.to * (1 + 1e-9); power *= 10)
      values.push_back(power);
    if (values.size() > 1) return values;
    values = {axis.from, axis.to};
    return values;
  }
  const double raw = (axis.to - axis.from) / 5;
  const double power = std::pow(10, std::floor(std::log10(raw)));
  double step = 10 * power;
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= raw) {
      step = factor * power;
      break;
    }
  for (double value = std::ceil(axis.from / step) * step; value <= axis.to + step * 1e-6;
       value += step)
    values.push_back(value);
  return values;
}

std::string number(double value) { return fmt::format("{:.6g}", value); }

/// An upper bound on the pixels that a byte takes, in 11 pixels of a sans-serif type (a bold one at
/// that). Of a character of several bytes the first one counts.
double width_of(char c) {
  const auto byte = static_cast<unsigned char>(c);
  if (byte >= 0x80) return (byte & 0xc0U) == 0x80 ? 0 : 13;
  if ((c >= 'A' && c <= 'Z') || std::string_view("mw@%&").find(c) != std::string_view::npos)
    return 11;
  return 7.5;
}

/// The text in lines that are no wider: broken behind blanks, commas and hyphens where there are
/// any.
std::vector<std::string> broken(const std::string& text, double width) {
  std::vector<std::string> lines(1);
  double used = 0;
  std::size_t brk = 0;  // of the last line: where it may be broken; 0: nowhere
  for (const char c : text) {
    std::string& line = lines.back();
    if (used + width_of(c) > width && !line.empty()) {
      const std::string rest = brk > 0 ? line.substr(brk) : "";
      line.resize(line.size() - rest.size());
      lines.push_back(rest);
      brk = 0;
      used = 0;
      for (const char kept : rest) used += width_of(kept);
    }
    lines.back() += c;
    used += width_of(c);
    if (c == ' ' || c == ',' || c == '-' || c == '_') brk = lines.back().size();
  }
  return lines;
}

std::string dash(std::size_t style) {
  const char* pattern = kDashes[(style / kColours.size()) % kDashes.size()];
  return *pattern == 0 ? "" : fmt::format(" stroke-dasharray=\"{}\"", pattern);
}

const char* colour(std::size_t style) { return kColours[style % kColours.size()]; }

std::string draw_axes(const Scale& x, const Scale& y) {
  std::string text;
  for (const double value : ticks(x.axis))
    text += fmt::format(
        "<line class=\"grid\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1:.1f}\" y2=\"{2:.1f}\"/>"
        "<text x=\"{0:.1f}\" y=\"{3:.1f}\" text-anchor=\"middle\">{4}</text>\n",
        x(value), y.from, y.to, y.from + 14, number(value));
  for (const double value : ticks(y.axis))
    text += fmt::format(
        "<line class=\"grid\" x1=\"{0:.1f}\" x2=\"{1:.1f}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\"/>"
        "<text x=\"{3:.1f}\" y=\"{4:.1f}\" text-anchor=\"end\">{5}</text>\n",
        x.from, x.to, y(value), x.from - 5, y(value) + 4, number(value));
  text += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n",
                      (x.from + x.to) / 2, y.from + 30, escaped(x.axis.label));
  text += fmt::format(
      "<text transform=\"translate(12 {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
      (y.from + y.to) / 2, escaped(y.axis.label));
  return text;
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : terminal_line(text)) switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  return result;
}

void Chart::add_curve(const std::string& name, std::size_t style, std::vector<Point> points,
                      bool markers) {
  curves_.push_back({name, style, std::move(points), markers});
}

std::string Chart::legend(double width, double& y) const {
  std::string text;
  for (const Curve& curve : curves_) {
    text += fmt::format(
        "<line x1=\"{0}\" x2=\"{1}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\" stroke=\"{3}\" "
        "stroke-width=\"1.6\"{4}/>",
        kLeft, kLeft + 24, y, colour(curve.style), dash(curve.style));
    for (const std::string& line : broken(curve.name, width - kRight - kLegendText)) {
      text +=
          fmt::format("<text x=\"{}\" y=\"{:.1f}\">{}</text>\n", kLegendText, y + 4, escaped(line));
      y += kLegendLine;
    }
  }
  return text;
}

std::string Chart::svg(double width, double height) const {
  const std::vector<std::string> title = broken(title_, width - 2 * kRight);
  const double top = kTop + kLegendLine * static_cast<double>(title.size() - 1);
  const double bottom = top + height - kTop;
  const Scale x{x_, kLeft, width - kRight};
  const Scale y{y_, bottom - kBottom, top};
  std::string text;
  for (std::size_t i = 0; i < title.size(); ++i)
    text += fmt::format(
        "<text class=\"title\" x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n", width / 2,
        16 + kLegendLine * static_cast<double>(i), escaped(title[i]));
  text += draw_axes(x, y);
  for (const Curve& curve : curves_) {
    std::string points, markers;
    for (const auto& [px, py] : curve.points) {
      points += fmt::format("{:.1f},{:.1f} ", x(px), y(py));
      if (curve.markers)
        markers += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.5\" fill=\"{}\"/>", x(px),
                               y(py), colour(curve.style));
    }
    text += fmt::format(
        "<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\"{} points=\"{}\"/>{}\n",
        colour(curve.style), dash(curve.style), points, markers);
  }
  double end = bottom;
  text += legend(width, end);
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
             "viewBox=\"0 0 {0} {1}\" role=\"img\">\n<title>{2}</title>\n",
             width, end, escaped(title_)) +
         text + "</svg>\n";
}

}  // namespace quadrille::cli::campaign
