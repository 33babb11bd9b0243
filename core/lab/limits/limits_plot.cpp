#include <algorithm>
#include <cmath>

#include "core/lab/limits/limits_report.h"

namespace flexcast {
namespace {

PlotPanel make_plot_panel(const LimitPanel& panel) {
  PlotPanel plot{panel.variation.name,
                 {panel.variation.title, panel.variation.logarithmic},
                 {"largest stable step (s)", true},
                 {}};
  for (std::size_t i = 0; i < panel.curves.size(); ++i) {
    PlotSeries predicted, measured;
    predicted.dashed = true;
    predicted.marks = PlotSeries::Marks::none;
    measured.line = false;
    measured.label = panel.curves[i].integrator;
    predicted.color = measured.color = static_cast<int>(i);
    for (const LimitPoint& point : panel.curves[i].points) {
      predicted.points.push_back({point.value, point.limit.predicted.value_or(0.0)});
      measured.points.push_back({point.value, point.limit.resolved ? point.limit.measured.value_or(0.0) : 0.0});
    }
    plot.series.push_back(std::move(predicted));
    plot.series.push_back(std::move(measured));
  }
  return plot;
}

PlotPanel make_implicit_panel(const std::vector<BoundedRun>& runs) {
  PlotPanel plot{"implicit schemes", {"time step (s)", true}, {"largest energy norm over the first", true}, {}};
  double most = 10.0;
  for (const BoundedRun& run : runs)
    if (std::isfinite(run.gain)) most = std::max(most, run.gain);
  PlotSeries failed;
  failed.line = false;
  failed.marks = PlotSeries::Marks::crosses;
  for (const BoundedRun& run : runs) {
    if (plot.series.empty() || plot.series.back().label != run.integrator) {
      plot.series.emplace_back();
      plot.series.back().label = run.integrator;
    }
    if (std::isfinite(run.gain)) plot.series.back().points.push_back({run.step, run.gain});
    if (run.bounded()) continue;
    failed.points.push_back({run.step, std::min(run.gain, most)});
    failed.notes.push_back(run.integrator + " blows up");
  }
  failed.color = 6;
  plot.series.push_back(std::move(failed));
  return plot;
}

}  // namespace

Plot make_limits_plot(const Limits& limits) {
  Plot plot{"Where the integrators blow up: " + limits.scene,
            "dots: measured, dashed: what the engine predicts; about the rest state",
            {},
            2};
  for (const LimitPanel& panel : limits.panels) plot.panels.push_back(make_plot_panel(panel));
  if (!limits.runs.empty()) plot.panels.push_back(make_implicit_panel(limits.runs));
  return plot;
}

}  // namespace flexcast
