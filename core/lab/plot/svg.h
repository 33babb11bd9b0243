// SVG as text: elements one after another, coordinates in pixels with two decimals at most.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace flexcast {

struct SvgPoint {
  double x = 0.0, y = 0.0;
};

struct SvgBox {
  double left = 0.0, top = 0.0, right = 0.0, bottom = 0.0;

  bool overlaps(const SvgBox& other) const {
    return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
  }
};

struct SvgStroke {
  std::string_view color;
  double width = 1.0;
  bool dashed = false;
};

struct SvgFont {
  enum class Anchor { start, middle, end };
  double size = 12.0;
  std::string_view color = "#333333";
  Anchor anchor = Anchor::start;
  bool bold = false;
  bool halo = false;  // white around the letters, for text on top of lines
};

class Svg {
 public:
  // Begins the picture: white, with a name for those who cannot see it.
  Svg(double width, double height, std::string_view name);

  void line(SvgPoint from, SvgPoint to, const SvgStroke& stroke);
  void path(const std::vector<SvgPoint>& points, const SvgStroke& stroke);
  // `tip` is shown under the pointer.
  void circle(SvgPoint center, double radius, std::string_view fill, const SvgStroke& stroke, std::string_view tip);
  void cross(SvgPoint center, double radius, const SvgStroke& stroke, std::string_view tip);
  // `power` is raised behind the text.
  void text(SvgPoint at, const SvgFont& font, std::string_view text, std::string_view power = {});
  // What is drawn until end_clip is cut off at the box, and keeps its coordinates.
  void begin_clip(const SvgBox& box);
  void end_clip();

  // Ends the picture.
  std::string finish();

 private:
  std::string text_;
};

// Two decimals at most, no "-0"; never exponents.
std::string svg_number(double value);
// For text and attributes: what XML does not allow, and what is no UTF-8, becomes U+FFFD.
std::string escape_xml(std::string_view text);

}  // namespace flexcast
