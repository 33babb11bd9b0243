#include "core/lab/plot/plot_verb.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <ostream>

#include "core/lab/output_file.h"
#include "core/lab/plot/csv_table.h"

namespace flexcast {
namespace {

constexpr std::size_t most_marks = 60;  // of a line; more run into each other

using Columns = std::vector<std::vector<double>>;

// Units of the columns that `flexcast-lab run --csv` writes, "" for others.
std::string find_unit(const std::string& column) {
  const std::string end = column.substr(column.rfind('.') + 1), start = column.substr(0, column.rfind('.'));
  if (column == "time") return "s";
  for (const char* energy : {"kinetic", "elastic", "gravity", "contact", "work", "dissipated", "numerical"})
    if (column == energy) return "J";
  if (start == "momentum") return "kg.m/s";
  if (start == "angular_momentum") return "kg.m\xC2\xB2/s";
  if (start == column) return "";
  if (end == "x" || end == "y" || end == "z") return "m";
  return end == "vx" || end == "vy" || end == "vz" ? "m/s" : "";
}

std::string with_unit(const std::string& text, const std::vector<std::string>& columns) {
  const std::string unit = find_unit(columns[0]);
  const bool shared =
      std::all_of(columns.begin(), columns.end(), [&](const auto& name) { return find_unit(name) == unit; });
  return shared && !unit.empty() ? text + " (" + unit + ")" : text;
}

std::string comma_list(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : ", ") + part;
  return text;
}

// A function of x given at some places, linear between them.
class Reference {
 public:
  Reference(const std::vector<double>& x, const std::vector<double>& y) {
    for (std::size_t i = 0; i < x.size(); ++i)
      if (std::isfinite(x[i]) && std::isfinite(y[i])) values_[x[i]] = y[i];
  }
  // Not a number outside of what is given.
  double calc(double x) const {
    const auto after = std::isfinite(x) ? values_.lower_bound(x) : values_.end();
    if (after == values_.end() || (after == values_.begin() && after->first > x))
      return std::numeric_limits<double>::quiet_NaN();
    if (after->first == x) return after->second;
    const auto before = std::prev(after);
    const double t = (x - before->first) / (after->first - before->first);
    return (1.0 - t) * before->second + t * after->second;
  }

 private:
  std::map<double, double> values_;
};

std::string choose_label(const PlotOptions& options, std::size_t file, std::size_t column) {
  const std::size_t files = options.files.size(), columns = options.y.size();
  if (options.labels.size() == files * columns) return options.labels[file * columns + column];
  const std::string name = options.labels.empty() ? options.files[file].stem().string() : options.labels[file];
  if (columns == 1) return name;
  return files == 1 ? options.y[column] : name + " " + options.y[column];
}

PlotSeries make_series(const PlotOptions& options, const Columns& columns, std::size_t column,
                       const Columns& reference) {
  PlotSeries series;
  const std::vector<double>&x = columns[0], &y = columns[column + 1];
  const bool magnitude = options.logarithmic.find('y') != std::string::npos;
  for (std::size_t i = 0; i < x.size(); ++i) series.points.push_back({x[i], y[i]});
  if (!reference.empty()) {
    const Reference subtracted(reference[0], reference[column + 1]);
    for (auto& point : series.points) {
      point[1] -= subtracted.calc(point[0]);
      if (magnitude) point[1] = std::abs(point[1]);
    }
  }
  series.marks = x.size() > most_marks ? PlotSeries::Marks::none : PlotSeries::Marks::dots;
  return series;
}

}  // namespace

Result<Plot> make_csv_plot(const PlotOptions& options) {
  const std::size_t lines = options.files.size() * options.y.size();
  if (!options.labels.empty() && options.labels.size() != lines && options.labels.size() != options.files.size()) {
    return Error{"--labels: " + std::to_string(options.labels.size()) + " labels (allowed: " + std::to_string(lines) +
                 ", one a line, or " + std::to_string(options.files.size()) + ", one a file)"};
  }
  std::vector<std::string> names = {options.x};
  names.insert(names.end(), options.y.begin(), options.y.end());
  Columns reference;
  if (options.difference) {
    auto columns = read_csv_columns(*options.difference, names);
    if (!columns) return columns.error();
    reference = std::move(columns).value();
  }
  PlotPanel panel;
  panel.x = {with_unit(options.x, {options.x}), options.logarithmic.find('x') != std::string::npos};
  panel.y = {with_unit(comma_list(options.y), options.y), options.logarithmic.find('y') != std::string::npos};
  if (options.difference) panel.y.title = "difference of " + panel.y.title;
  for (std::size_t file = 0; file < options.files.size(); ++file) {
    const auto columns = read_csv_columns(options.files[file], names);
    if (!columns) return columns.error();
    for (std::size_t column = 0; column < options.y.size(); ++column) {
      panel.series.push_back(make_series(options, columns.value(), column, reference));
      panel.series.back().label = choose_label(options, file, column);
    }
  }
  std::string subtitle;
  if (options.difference) subtitle = "difference from " + options.difference->filename().string();
  return Plot{options.title, subtitle, {std::move(panel)}};
}

int plot_verb(const PlotOptions& options, std::ostream& log) {
  const auto refuse = [&](const std::string& reason) {
    log << "flexcast-lab: " << reason << std::endl;
    return 1;
  };
  const auto plot = make_csv_plot(options);
  if (!plot) return refuse(plot.error().message);
  auto file = OutputFile::open(options.picture);
  if (!file) return refuse(file.error().message);
  file.value().stream() << make_svg(plot.value());
  if (const auto closed = file.value().close(); !closed) return refuse(closed.error().message);
  return 0;
}

}  // namespace flexcast
