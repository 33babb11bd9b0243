#include "core/lab/plot/plot.h"

#include <algorithm>

#include "core/lab/plot/plot_panel.h"
#include "core/lab/plot/plot_text.h"

namespace flexcast {
namespace {

constexpr double margin = 24.0;   // around everything, px
constexpr double between = 28.0;  // panels
constexpr double title_size = 19.0, subtitle_size = 13.0;
constexpr double wide = 812.0, narrow = 540.0;  // panels: alone in their row, beside others

// Title and subtitle, broken into lines; returns the y below them.
double draw_heading(Svg* svg, const Plot& plot, double width) {
  double y = margin;
  const SvgFont bold{title_size, "#111111", SvgFont::Anchor::start, true};
  const SvgFont grey{subtitle_size, "#6e6e6e"};
  if (!plot.title.empty()) {
    for (const std::string& line : wrap_text(plot.title, 1.06 * title_size, width)) {
      if (svg) svg->text({margin, y + 0.75 * title_size}, bold, line);
      y += 1.3 * title_size;
    }
  }
  if (!plot.subtitle.empty()) {
    for (const std::string& line : wrap_text(plot.subtitle, subtitle_size, width)) {
      if (svg) svg->text({margin, y + subtitle_size}, grey, line);
      y += 1.4 * subtitle_size;
    }
  }
  return y > margin ? y + 14.0 : y;
}

// All panels alike, so that their axes stand in line.
PanelLayout make_layout(const std::vector<PlotPanelDrawing>& drawings, int columns) {
  PanelLayout layout;
  layout.width = columns == 1 ? wide : narrow;
  layout.height = columns > 1 ? 380.0 : drawings.size() > 1 ? 400.0 : 480.0;
  layout.left = layout.right = 0.0;
  for (const PlotPanelDrawing& drawing : drawings) layout.left = std::max(layout.left, drawing.calc_left());
  for (const PlotPanelDrawing& drawing : drawings)
    layout.right = std::max(layout.right, drawing.calc_right(layout.width, layout.left));
  return layout;
}

}  // namespace

std::string make_svg(const Plot& plot) {
  std::vector<PlotPanelDrawing> drawings;
  drawings.reserve(plot.panels.size());
  for (const PlotPanel& panel : plot.panels) drawings.emplace_back(panel);
  const int count = static_cast<int>(plot.panels.size());
  const int columns = std::clamp(plot.columns, 1, std::max(count, 1));
  const int rows = (count + columns - 1) / columns;
  const PanelLayout layout = make_layout(drawings, columns);

  const double inner = columns * layout.width + (columns - 1) * between;
  const double top = draw_heading(nullptr, plot, inner);
  const double height = top + rows * layout.height + std::max(rows - 1, 0) * between + margin;
  Svg svg(inner + 2.0 * margin, height, plot.title);
  draw_heading(&svg, plot, inner);
  for (int i = 0; i < count; ++i) {
    const SvgPoint corner{margin + i % columns * (layout.width + between),
                          top + i / columns * (layout.height + between)};
    drawings[static_cast<std::size_t>(i)].draw(svg, corner, layout);
  }
  return svg.finish();
}

}  // namespace flexcast
