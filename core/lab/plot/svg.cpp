#include "core/lab/plot/svg.h"

#include <algorithm>
#include <cstdio>

namespace flexcast {
namespace {

constexpr double most_pixels = 1e6;  // renderers compute in single precision

std::string at(const char* x, const char* y, SvgPoint point) {
  return std::string(" ") + x + "=\"" + svg_number(point.x) + "\" " + y + "=\"" + svg_number(point.y) + "\"";
}

std::string attributes(const SvgStroke& stroke) {
  std::string text = " stroke=\"" + std::string(stroke.color) + "\" stroke-width=\"" + svg_number(stroke.width) + "\"";
  if (stroke.dashed) text += " stroke-dasharray=\"6 4\"";
  return text;
}

// Number of bytes of the UTF-8 sequence that begins here; 0: it is none.
std::size_t calc_sequence(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  const std::size_t length = first < 0x80 ? 1 : first < 0xC2 ? 0 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
  if (length == 0 || first > 0xF4 || length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xC0) != 0x80) return 0;
  const bool too_long = (first == 0xE0 && byte(1) < 0xA0) || (first == 0xF0 && byte(1) < 0x90);
  const bool no_character = (first == 0xED && byte(1) > 0x9F) || (first == 0xF4 && byte(1) > 0x8F) ||
                            (first == 0xEF && byte(1) == 0xBF && byte(2) >= 0xBE);
  return too_long || no_character ? 0 : length;
}

void add_tip(std::string& text, std::string_view tip, const char* element) {
  if (tip.empty()) {
    text += "/>\n";
  } else {
    text += "><title>" + escape_xml(tip) + "</title></" + element + ">\n";
  }
}

std::string make_path(const std::vector<SvgPoint>& points) {
  std::string text;
  for (std::size_t i = 0; i < points.size(); ++i) {
    text += i == 0 ? 'M' : i == 1 ? 'L' : ' ';
    text += svg_number(points[i].x) + ',' + svg_number(points[i].y);
  }
  return text;
}

}  // namespace

Svg::Svg(double width, double height, std::string_view name) {
  const std::string w = svg_number(width), h = svg_number(height);
  text_ = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + w + " " + h + "\" width=\"" + w +
          "\" height=\"" + h + "\" role=\"img\" aria-label=\"" + escape_xml(name) +
          "\" font-family=\"system-ui, -apple-system, 'Segoe UI', Roboto, 'Helvetica Neue', Arial, sans-serif\">\n" +
          "<rect width=\"" + w + "\" height=\"" + h + "\" fill=\"#ffffff\"/>\n";
}

void Svg::line(SvgPoint from, SvgPoint to, const SvgStroke& stroke) {
  text_ += "<line" + at("x1", "y1", from) + at("x2", "y2", to) + attributes(stroke) + "/>\n";
}

void Svg::path(const std::vector<SvgPoint>& points, const SvgStroke& stroke) {
  if (points.size() < 2) return;
  text_ += "<path d=\"" + make_path(points) + "\" fill=\"none\"" + attributes(stroke) +
           " stroke-linejoin=\"round\" stroke-linecap=\"" + (stroke.dashed ? "butt" : "round") + "\"/>\n";
}

void Svg::circle(SvgPoint center, double radius, std::string_view fill, const SvgStroke& stroke, std::string_view tip) {
  text_ += "<circle" + at("cx", "cy", center) + " r=\"" + svg_number(radius) + "\" fill=\"" + std::string(fill) + "\"" +
           attributes(stroke);
  add_tip(text_, tip, "circle");
}

void Svg::cross(SvgPoint center, double radius, const SvgStroke& stroke, std::string_view tip) {
  const auto [x, y] = center;
  text_ += "<path d=\"" + make_path({{x - radius, y - radius}, {x + radius, y + radius}}) +
           make_path({{x - radius, y + radius}, {x + radius, y - radius}}) + "\" fill=\"none\"" + attributes(stroke);
  add_tip(text_, tip, "path");
}

void Svg::text(SvgPoint place, const SvgFont& font, std::string_view text, std::string_view power) {
  text_ += "<text" + at("x", "y", place) + " font-size=\"" + svg_number(font.size) + "\" fill=\"" +
           std::string(font.color) + "\"";
  if (font.anchor != SvgFont::Anchor::start)
    text_ += std::string(" text-anchor=\"") + (font.anchor == SvgFont::Anchor::end ? "end" : "middle") + "\"";
  if (font.bold) text_ += " font-weight=\"600\"";
  if (font.halo) text_ += " stroke=\"#ffffff\" stroke-width=\"3\" stroke-linejoin=\"round\" paint-order=\"stroke\"";
  text_ += ">" + escape_xml(text);
  if (!power.empty()) {
    text_ += "<tspan dy=\"" + svg_number(-0.4 * font.size) + "\" font-size=\"" + svg_number(0.75 * font.size) + "\">" +
             escape_xml(power) + "</tspan>";
  }
  text_ += "</text>\n";
}

// A nested picture clips without an id, which could be another picture's on the same page.
void Svg::begin_clip(const SvgBox& box) {
  const std::string width = svg_number(box.right - box.left), height = svg_number(box.bottom - box.top);
  text_ += "<svg" + at("x", "y", {box.left, box.top}) + " width=\"" + width + "\" height=\"" + height +
           "\" viewBox=\"" + svg_number(box.left) + " " + svg_number(box.top) + " " + width + " " + height + "\">\n";
}

void Svg::end_clip() {
  text_ += "</svg>\n";
}

std::string Svg::finish() {
  return text_ + "</svg>\n";
}

std::string svg_number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.2f", std::clamp(value, -most_pixels, most_pixels));
  std::string number = text;
  while (number.back() == '0') number.pop_back();
  if (number.back() == '.') number.pop_back();
  return number == "-0" ? "0" : number;
}

std::string escape_xml(std::string_view text) {
  std::string escaped;
  while (!text.empty()) {
    const std::size_t length = calc_sequence(text);
    const auto c = static_cast<unsigned char>(text.front());
    if (length == 0 || (c < 0x20 && c != '\t' && c != '\n' && c != '\r') || c == 0x7F) {
      escaped += "\xEF\xBF\xBD";
    } else if (c == '&') {
      escaped += "&amp;";
    } else if (c == '<') {
      escaped += "&lt;";
    } else if (c == '>') {
      escaped += "&gt;";
    } else if (c == '"') {
      escaped += "&quot;";
    } else {
      escaped += text.substr(0, length);
    }
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return escaped;
}

}  // namespace flexcast
