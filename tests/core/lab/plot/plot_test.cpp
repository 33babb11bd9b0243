// Pictures: what is drawn where, and that it is a picture at all.
#include "core/lab/plot/plot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <regex>
#include <string>

#include "core/lab/plot/plot_axis.h"
#include "core/lab/plot/plot_labels.h"
#include "core/lab/plot/plot_path.h"
#include "core/lab/plot/plot_text.h"
#include "core/lab/plot/svg.h"

namespace flexcast::test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

// "" or what is wrong: tags nest, attributes are quoted and appear once, references are known, nothing is left over.
std::string check_xml(const std::string& text) {
  static const std::regex tag(R"(^<(/?)([a-z]+)((?:\s[A-Za-z:0-9-]+="[^"<]*")*)(/?)>)");
  static const std::regex reference(R"(&(?!(amp|lt|gt|quot);))");
  if (std::regex_search(text, reference)) return "an & that begins nothing";
  std::vector<std::string> open;
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] != '<') {
      if (open.empty() && text[i] != '\n') return "text outside of the picture";
      ++i;
      continue;
    }
    std::smatch match;
    const std::string rest = text.substr(i, 4000);
    if (!std::regex_search(rest, match, tag)) return "no tag: " + rest.substr(0, 60);
    if (match[1].length() > 0) {
      if (open.empty() || open.back() != match[2]) return "</" + match[2].str() + "> ends nothing";
      open.pop_back();
    } else if (match[4].length() == 0) {
      open.push_back(match[2]);
    }
    i += static_cast<std::size_t>(match.length());
  }
  return open.empty() ? "" : "<" + open.back() + "> does not end";
}

std::vector<std::smatch> find_all(const std::string& text, const std::string& pattern) {
  const std::regex expression(pattern);
  return {std::sregex_iterator(text.begin(), text.end(), expression), std::sregex_iterator()};
}

struct PlacedTexts {
  std::vector<SvgBox> boxes;
  std::vector<std::string> texts;
};

// All texts of the picture with the room they take.
PlacedTexts find_texts(const std::string& svg) {
  PlacedTexts found;
  for (
      const auto& match : find_all(
          svg,
          R"re(<text x="([0-9.-]+)" y="([0-9.-]+)" font-size="([0-9.]+)"[^>]*?( text-anchor="(\w+)")?[^>]*>([^<]*))re")) {
    const double x = std::stod(match[1]), y = std::stod(match[2]), size = std::stod(match[3]);
    const double width = estimate_text_width(match[6].str(), size);
    const std::string anchor = match[0].str().find("\"end\"") != std::string::npos      ? "end"
                               : match[0].str().find("\"middle\"") != std::string::npos ? "middle"
                                                                                        : "start";
    const double left = anchor == "end" ? x - width : anchor == "middle" ? x - 0.5 * width : x;
    found.boxes.push_back({left, y - 0.8 * size, left + width, y + 0.2 * size});
    found.texts.push_back(match[6]);
  }
  return found;
}

std::vector<SvgPoint> find_dots(const std::string& svg) {
  std::vector<SvgPoint> dots;
  for (const auto& match : find_all(svg, R"re(<circle cx="([0-9.-]+)" cy="([0-9.-]+)")re"))
    dots.push_back({std::stod(match[1]), std::stod(match[2])});
  return dots;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t number = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++number;
  return number;
}

Plot make_plot(std::vector<PlotSeries> series, bool logarithmic = false) {
  return {"Title", "what it is", {{"Panel", {"h (s)", logarithmic}, {"error (m)", logarithmic}, std::move(series)}}};
}

PlotSeries make_series(std::string label, std::vector<std::array<double, 2>> points) {
  return {std::move(label), std::move(points)};
}

// Whatever the data: well-formed, and every number finite.
void expect_picture(const Plot& plot) {
  const std::string svg = make_svg(plot);
  EXPECT_EQ(check_xml(svg), "");
  for (const auto& match : find_all(svg, R"re( (?:d|x|y|cx|cy|x1|x2|y1|y2|width|height)="([^"]*)")re"))
    EXPECT_EQ(match[1].str().find_first_not_of("0123456789.,ML -"), std::string::npos) << match[0];
}

TEST(Plot, TheCheckerOfTheseTestsSeesWhatIsWrong) {
  EXPECT_EQ(check_xml("<svg a=\"1\"><g/>text &amp;</svg>\n"), "");
  for (const char* wrong :
       {"<svg>", "<svg></g>", "<svg a=1/>", "<svg>&nbsp;</svg>", "<svg/>text", "<svg><b <c/></svg>"})
    EXPECT_NE(check_xml(wrong), "") << wrong;
}

TEST(Plot, IsAPictureWhateverTheDataAre) {
  const double tiny = std::numeric_limits<double>::denorm_min(), huge = std::numeric_limits<double>::max();
  const std::vector<std::vector<std::array<double, 2>>> cases = {
      {},
      {{1.0, 2.0}},
      {{0.0, 0.0}, {0.0, 0.0}},
      {{1.0, 5.0}, {2.0, 5.0}, {3.0, 5.0}},
      {{1.0, not_a_number}, {infinity, 2.0}, {-infinity, 3.0}},
      {{tiny, tiny}, {huge, huge}},
      {{-huge, -huge}, {huge, huge}},
      {{tiny, 1e-320}, {3.0 * tiny, 1e-300}},
      {{1.0, 1.0}, {1.0 + 1e-15, 1.0 + 1e-16}},
      {{-1.0, -2.0}, {-3.0, 1e-12}}};
  for (const auto& points : cases) {
    for (const bool logarithmic : {false, true}) {
      Plot plot = make_plot({make_series("a", points), make_series("b", points)}, logarithmic);
      plot.panels[0].slopes = {{1.0, "first order"}, {-2.0, "falls"}};
      expect_picture(plot);
      plot.panels[0].x.lo = 7.0;
      plot.panels[0].x.hi = 7.0;
      plot.panels[0].y.lo = -1.0;
      plot.panels[0].y.hi = not_a_number;
      expect_picture(plot);
    }
  }
  expect_picture({});
  expect_picture({"", "", {{}, {}, {}}, 2});
  expect_picture({"", "", {{}}, -3});
}

TEST(Plot, TheSamePlotGivesTheSameBytes) {
  const Plot plot = make_plot({make_series("a", {{1e-3, 0.1}, {2e-3, 0.3}}), make_series("b", {{1e-3, 0.2}})});
  EXPECT_EQ(make_svg(plot), make_svg(plot));
}

TEST(Plot, SaysWhatItShows) {
  const std::string svg = make_svg(make_plot({}));
  for (const char* text : {"Title", "what it is", "Panel", "h (s)", "error (m)"})
    EXPECT_EQ(count(svg, ">" + std::string(text) + "</text>"), 1U) << text;
}

TEST(Plot, TextIsEscaped) {
  Plot plot = make_plot({make_series("a<b & \"c\"", {{1.0, 1.0}, {2.0, 2.0}})});
  plot.title = "x > y \x01 \xff é";
  const std::string svg = make_svg(plot);
  EXPECT_EQ(check_xml(svg), "");
  EXPECT_NE(svg.find(">a&lt;b &amp; &quot;c&quot;</text>"), std::string::npos);
  EXPECT_NE(svg.find(">x &gt; y \xEF\xBF\xBD \xEF\xBF\xBD é</text>"), std::string::npos);
}

TEST(Plot, OnALogarithmicAxisEqualFactorsAreEqualWays) {
  const auto dots =
      find_dots(make_svg(make_plot({make_series("", {{1e-4, 1e-6}, {1e-3, 1e-4}, {1e-2, 1e-2}, {2e-2, 4e-2}})}, true)));
  ASSERT_EQ(dots.size(), 4U);
  EXPECT_NEAR(dots[1].x - dots[0].x, dots[2].x - dots[1].x, 0.02);
  EXPECT_NEAR(dots[0].y - dots[1].y, dots[1].y - dots[2].y, 0.02);
  EXPECT_NEAR((dots[3].x - dots[2].x) / (dots[1].x - dots[0].x), std::log10(2.0), 1e-3);
  EXPECT_NEAR((dots[2].y - dots[3].y) / (dots[0].y - dots[1].y), 0.5 * std::log10(4.0), 1e-3);
}

TEST(Plot, WhatCannotBeShownIsAGapInTheLine) {
  const std::string svg = make_svg(
      make_plot({make_series("", {{1, 1}, {2, 2}, {3, not_a_number}, {4, 4}, {5, 5}, {6, -1}, {7, 7}})}, true));
  EXPECT_EQ(count(svg, "<path"), 2U);
  EXPECT_EQ(find_dots(svg).size(), 5U);
}

TEST(Plot, ASinglePointIsSeenWithoutMarks) {
  PlotSeries series = make_series("", {{1, 1}, {2, not_a_number}, {3, 3}, {4, 4}});
  series.marks = PlotSeries::Marks::none;
  EXPECT_EQ(find_dots(make_svg(make_plot({series}))).size(), 1U);
}

TEST(Plot, LabelsOfLinesThatEndTogetherAreMovedApart) {
  std::vector<PlotSeries> series;
  for (int i = 0; i < 9; ++i) series.push_back(make_series("series " + std::to_string(i), {{1, 1}, {2, 2 + 1e-4 * i}}));
  const std::string svg = make_svg(make_plot(series));
  const PlacedTexts found = find_texts(svg);
  EXPECT_GE(found.boxes.size(), 20U);
  for (const auto& one : series) EXPECT_EQ(count(svg, ">" + one.label + "</text>"), 1U);
  for (std::size_t i = 0; i < found.boxes.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      EXPECT_FALSE(found.boxes[i].overlaps(found.boxes[k])) << found.texts[i] << " on " << found.texts[k];
}

TEST(Plot, NothingLeavesThePicture) {
  Plot plot =
      make_plot({make_series("a label that is a good deal longer than what one would like to read", {{1, 1}, {2, 2}}),
                 make_series("short", {{1, 1}, {1.5, 1e5}})});
  plot.panels.resize(3, plot.panels[0]);
  for (const int columns : {1, 2, 3}) {
    plot.columns = columns;
    const std::string svg = make_svg(plot);
    std::smatch size;
    ASSERT_TRUE(std::regex_search(svg, size, std::regex(R"re(viewBox="0 0 ([0-9.]+) ([0-9.]+)")re")));
    EXPECT_NEAR(std::stod(size[1]), columns == 1 ? 860.0 : 580.0 * columns, 50.0);
    const PlacedTexts found = find_texts(svg);
    for (std::size_t i = 0; i < found.boxes.size(); ++i) {
      EXPECT_GE(found.boxes[i].left, 0.0) << found.texts[i];
      EXPECT_LE(found.boxes[i].right, std::stod(size[1])) << found.texts[i];
      EXPECT_LE(found.boxes[i].bottom, std::stod(size[2])) << found.texts[i];
    }
  }
}

TEST(Plot, FailuresAreCrossesAndPredictionsDashed) {
  PlotSeries failed = make_series("", {{1, 1}, {2, 2}}), predicted = make_series("", {{1, 2}, {2, 3}});
  failed.marks = PlotSeries::Marks::crosses;
  failed.line = false;
  predicted.dashed = true;
  predicted.marks = PlotSeries::Marks::none;
  const std::string svg = make_svg(make_plot({failed, predicted}));
  EXPECT_EQ(count(svg, "stroke-dasharray"), 1U);
  EXPECT_EQ(find_dots(svg).size(), 0U);
  EXPECT_EQ(find_all(svg, R"re(d="M[^LM"]*L[^LM"]*M[^LM"]*L[^LM"]*")re").size(), 2U);
}

TEST(Plot, SeriesThatShareANumberShareAColour) {
  PlotSeries predicted = make_series("", {{1, 2}, {2, 3}});
  predicted.color = 0;
  const std::string svg =
      make_svg(make_plot({make_series("", {{1, 1}, {2, 2}}), predicted, make_series("", {{1, 3}})}));
  EXPECT_EQ(find_all(svg, R"re(<circle[^>]*#0072b2)re").size(), 4U);
  EXPECT_EQ(find_all(svg, R"re(<circle[^>]*#d55e00)re").size(), 1U);
}

TEST(Plot, ASlopeRunsParallelToItsData) {
  Plot plot = make_plot({make_series("", {{1e-3, 1e-6}, {1e-2, 1e-4}, {1e-1, 1e-2}})}, true);
  plot.panels[0].slopes = {{2.0, "order 2"}};
  const std::string svg = make_svg(plot);
  EXPECT_EQ(count(svg, ">order 2</text>"), 1U);
  const auto dots = find_dots(svg);
  std::smatch line;
  ASSERT_TRUE(std::regex_search(
      svg, line,
      std::regex(R"re(<line x1="([0-9.]+)" y1="([0-9.]+)" x2="([0-9.]+)" y2="([0-9.]+)"[^>]*width="1.2")re")));
  const double slope = (std::stod(line[4]) - std::stod(line[2])) / (std::stod(line[3]) - std::stod(line[1]));
  EXPECT_NEAR(slope, (dots[2].y - dots[0].y) / (dots[2].x - dots[0].x), 1e-2);
}

std::vector<std::string> tick_texts(const PlotAxis& axis, const std::vector<double>& values, int number = 6) {
  std::vector<std::string> texts;
  for (const PlotTick& tick : AxisScale(axis, values).make_ticks(number))
    texts.push_back(tick.power.empty() ? tick.text : tick.text + "^" + tick.power);
  return texts;
}

TEST(PlotAxis, TicksAreNumbersAsPeopleWriteThem) {
  using Texts = std::vector<std::string>;
  EXPECT_EQ(tick_texts({}, {0.0, 1.0}), (Texts{"0", "0.2", "0.4", "0.6", "0.8", "1.0"}));
  EXPECT_EQ(tick_texts({}, {-5.0, 12.0}), (Texts{"−5", "0", "5", "10"}));
  EXPECT_EQ(tick_texts({}, {0.0, 3e-5}, 4), (Texts{"0", "1×10^−5", "2×10^−5", "3×10^−5"}));
  EXPECT_EQ(tick_texts({"", true}, {1e-3, 1e2}), (Texts{"0.001", "0.01", "0.1", "1", "10", "100"}));
  EXPECT_EQ(tick_texts({"", true}, {1e-7, 1e-4}), (Texts{"10^−7", "10^−6", "10^−5", "10^−4"}));
  EXPECT_EQ(tick_texts({"", true}, {0.1, 3.0}), (Texts{"0.1", "0.2", "0.5", "1", "2"}));
  EXPECT_EQ(tick_texts({"", true}, {4.2, 4.9}), (Texts{"4.2", "4.4", "4.6", "4.8"}));
}

TEST(PlotAxis, TicksLieWhereTheirValuesDo) {
  const AxisScale linear({}, {0.0, 10.0}), decades({"", true}, {1e-7, 1e-4});
  for (const PlotTick& tick : linear.make_ticks(5)) EXPECT_NEAR(tick.at, *linear.place(std::stod(tick.text)), 1e-12);
  EXPECT_NEAR(decades.make_ticks(5)[1].at, *decades.place(1e-6), 1e-12);
}

TEST(PlotAxis, HugeRangesHaveFewNumbers) {
  for (const bool logarithmic : {false, true}) {
    const auto ticks = AxisScale({"", logarithmic}, {1e-300, 1e300}).make_ticks(6);
    std::size_t numbers = 0;
    for (const PlotTick& tick : ticks) numbers += tick.text.empty() ? 0 : 1;
    EXPECT_LE(ticks.size(), 45U);
    EXPECT_GE(numbers, 3U);
    EXPECT_LE(numbers, 9U);
  }
}

TEST(PlotAxis, GivenLimitsAreTheEnds) {
  PlotAxis axis;
  axis.lo = -2.0;
  axis.hi = 6.0;
  const AxisScale scale(axis, {0.0, 100.0});
  EXPECT_DOUBLE_EQ(*scale.place(-2.0), 0.0);
  EXPECT_DOUBLE_EQ(*scale.place(6.0), 1.0);
  EXPECT_FALSE(scale.place(infinity));
  axis.lo = 6.0;
  EXPECT_DOUBLE_EQ(*AxisScale(axis, {0.0}).place(6.0), 0.0);
}

TEST(PlotLabels, StayWhereTheyAreWithoutNeed) {
  std::vector<SvgBox> boxes = {{0, 10, 50, 26}, {0, 40, 50, 56}, {60, 12, 90, 28}};
  const auto before = boxes;
  spread_labels(boxes, 0.0, 200.0);
  for (std::size_t i = 0; i < boxes.size(); ++i) EXPECT_EQ(boxes[i].top, before[i].top);
}

TEST(PlotLabels, MoveAsLittleAsPossibleAndKeepTheirOrder) {
  std::vector<SvgBox> boxes = {{0, 102, 50, 118}, {0, 98, 50, 114}};
  spread_labels(boxes, 0.0, 200.0);
  EXPECT_DOUBLE_EQ(boxes[1].top, 92.0);
  EXPECT_DOUBLE_EQ(boxes[0].top, 108.0);
  spread_labels(boxes, 0.0, 118.0);
  EXPECT_DOUBLE_EQ(boxes[1].top, 86.0);
  EXPECT_DOUBLE_EQ(boxes[0].bottom, 118.0);
}

TEST(PlotLabels, ANoteFindsAFreePlaceNearItsMark) {
  const SvgBox bounds{0, 0, 200, 200};
  const SvgBox first = find_note_place({100, 100}, 40, 12, bounds, {});
  EXPECT_LT(first.bottom, 100.0);
  const SvgBox second = find_note_place({100, 100}, 40, 12, bounds, {first});
  EXPECT_FALSE(second.overlaps(first));
  EXPECT_LT(find_note_place({198, 100}, 40, 12, bounds, {}).right, 200.0);
}

TEST(PlotPath, ManyPointsAreThinnedWithoutLosingPeaks) {
  PlotPiece piece;
  for (int i = 0; i < 100000; ++i) piece.push_back({0.001 * i, 10.0 * (i % 2)});
  piece[5123].y = 99.0;
  const PlotPiece thin = thin_out(piece);
  EXPECT_LE(thin.size(), 1000U);
  EXPECT_EQ(thin.front().x, 0.0);
  EXPECT_EQ(thin.back().x, piece.back().x);
  EXPECT_EQ(std::count_if(thin.begin(), thin.end(), [](const SvgPoint& point) { return point.y == 99.0; }), 1);
}

TEST(Svg, NumbersAreShortAndWithinWhatRenderersBear) {
  EXPECT_EQ(svg_number(1.0), "1");
  EXPECT_EQ(svg_number(12.345), "12.35");
  EXPECT_EQ(svg_number(-0.001), "0");
  EXPECT_EQ(svg_number(100.0), "100");
  EXPECT_EQ(svg_number(1e300), "1000000");
  EXPECT_EQ(svg_number(-infinity), "-1000000");
}

TEST(PlotText, LongTextIsCutBetweenCharactersOrWrappedBetweenWords) {
  EXPECT_EQ(fit_text("short", 12.0, 100.0), "short");
  const std::string cut = fit_text("éééééééééééééééé", 12.0, 60.0);
  EXPECT_TRUE(cut.ends_with("é…")) << cut;
  EXPECT_LE(estimate_text_width(cut, 12.0), 62.0);
  EXPECT_EQ(wrap_text("one two three", 12.0, 60.0), (std::vector<std::string>{"one two", "three"}));
  EXPECT_EQ(wrap_text("", 12.0, 60.0).size(), 1U);
}

}  // namespace
}  // namespace flexcast::test
