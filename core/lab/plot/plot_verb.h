// The verb `plot`: lines from CSV files as a picture.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/lab/plot/plot.h"

namespace flexcast {

struct PlotOptions {
  std::vector<std::filesystem::path> files;
  std::filesystem::path picture;
  std::string x = "time";
  std::vector<std::string> y;
  std::string logarithmic;  // "", x, y or xy
  std::string title;
  std::vector<std::string> labels;                  // one a line or one a file; none: stems of the files
  std::optional<std::filesystem::path> difference;  // whose y, interpolated over x, is subtracted
};

// One line for each file and column of y.
Result<Plot> make_csv_plot(const PlotOptions& options);

// The program's verb; returns the exit code.
int plot_verb(const PlotOptions& options, std::ostream& log);

}  // namespace flexcast
