// SPDX-License-Identifier: MIT
#include "svg.hpp"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

namespace quadrille::view {

namespace {

bool is_control(char c) {
  const auto code = static_cast<unsigned char>(c);
  return (code < 0x20 && c != '\t' && c != '\n' && c != '\r') || code == 0x7f;
}

/// With a sign of replacement for each byte that is no UTF-8.
std::string as_utf8(std::string_view text) {
  using Json = nlohmann::json;
  return Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace))
      .get<std::string>();
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : as_utf8(text)) {
    if (is_control(c)) {  // XML has no such characters, however they are written
      result += "\xef\xbf\xbd";
      continue;
    }
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string_view agent_colour(std::size_t index) {
  static constexpr std::array<std::string_view, 8> kColours = {
      "#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#f0e442", "#8c8c8c"};
  return kColours[index % kColours.size()];
}

std::string pixels(double value) {
  const auto hundredths = std::llround(value * 100);
  const auto whole = std::abs(hundredths) / 100, rest = std::abs(hundredths) % 100;
  std::string text = (hundredths < 0 ? "-" : "") + std::to_string(whole);
  if (rest == 0) return text;
  text += '.';
  text += static_cast<char>('0' + rest / 10);
  if (rest % 10 != 0) text += static_cast<char>('0' + rest % 10);
  return text;
}

Svg::Svg(double width, double height, std::string_view title) {
  out_ = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + pixels(width) + "\" height=\"" +
         pixels(height) + "\" viewBox=\"0 0 " + pixels(width) + " " + pixels(height) +
         "\" role=\"img\" font-family=\"sans-serif\">\n";
  if (!title.empty()) out_ += "<title>" + escaped(title) + "</title>\n";
  rectangle(0, 0, width, height, "fill=\"#ffffff\"");
}

void Svg::rectangle(double x, double y, double width, double height, std::string_view style) {
  out_ += "<rect x=\"" + pixels(x) + "\" y=\"" + pixels(y) + "\" width=\"" + pixels(width) +
          "\" height=\"" + pixels(height) + "\" ";
  out_.append(style).append("/>\n");
}

void Svg::circle(Position centre, double radius, std::string_view style) {
  out_ += "<circle cx=\"" + pixels(centre.x) + "\" cy=\"" + pixels(centre.y) + "\" r=\"" +
          pixels(radius) + "\" ";
  out_.append(style).append("/>\n");
}

namespace {

std::string list(const std::vector<Position>& points) {
  std::string text;
  for (const Position& point : points) {
    if (!text.empty()) text += ' ';
    text += pixels(point.x) + "," + pixels(point.y);
  }
  return text;
}

}  // namespace

void Svg::line(const std::vector<Position>& points, std::string_view style) {
  out_ += "<polyline points=\"" + list(points) + "\" fill=\"none\" ";
  out_.append(style).append("/>\n");
}

void Svg::polygon(const std::vector<Position>& points, std::string_view style) {
  out_ += "<polygon points=\"" + list(points) + "\" ";
  out_.append(style).append("/>\n");
}

void Svg::path(std::string_view steps, std::string_view style) {
  out_.append("<path d=\"").append(steps).append("\" ").append(style).append("/>\n");
}

void Svg::text(Position at, std::string_view anchor, double size, std::string_view text,
               std::string_view style) {
  out_ += "<text x=\"" + pixels(at.x) + "\" y=\"" + pixels(at.y) + "\" font-size=\"" +
          pixels(size) + "\" text-anchor=\"";
  out_.append(anchor).append("\" ").append(style).append(">");
  out_ += escaped(text) + "</text>\n";
}

std::string Svg::finish() && { return std::move(out_) + "</svg>\n"; }

}  // namespace quadrille::view
