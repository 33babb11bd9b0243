#include "clients/export/options.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>

namespace flexcast::exporting {
namespace {

constexpr const char* example = R"(
Examples:
  flexcast-export drop.mcap --vtk drop --every 10
  flexcast-export drop.mcap --csv tip.csv --from 1 --to 2

The first writes every tenth frame to drop/frame_00000000.vtu and so on, and drop/run.pvd, which ParaView opens as one
film: tetrahedra and springs, and of each particle what was streamed. The second writes a row for each frame with time and
place of every probe of the scene. Frames that are missing in the recording are named on stderr.)";

std::optional<double> parse_time(const char* option, const std::string& text) {
  if (text.empty()) return std::nullopt;
  double time = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), time);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(time) || time < 0.0) {
    throw CLI::ValidationError(option, "'" + text + "' is not a time in seconds from 0 on");
  }
  return time;
}

void check_together(const Options& options) {
  if (options.vtk.empty() == options.csv.empty()) {
    throw CLI::ValidationError("--vtk, --csv", "exactly one of the two is needed");
  }
  if (options.from && options.to && *options.from > *options.to) {
    throw CLI::ValidationError("--from", "lies after --to");
  }
}

}  // namespace

std::variant<Options, int> parse_options(int argc, const char* const* argv) {
  Options options;
  std::string from, to;
  std::size_t run = 0;
  CLI::App app("Turns a recording into files for ParaView and for tables.", "flexcast-export");
  app.footer(example);
  app.add_option("RUN", options.file, "recording (MCAP)")->required();
  app.add_option("--vtk", options.vtk, "folder for a VTK file a frame and run.pvd; made when needed");
  app.add_option("--csv", options.csv, "file with a row a frame: the probes of the scene");
  auto* run_given =
      app.add_option("--run", run, "which run, from 1 on in the order of the recording; default: the last")
          ->check(CLI::PositiveNumber);
  app.add_option("--from", from, "from this simulated time on, s");
  app.add_option("--to", to, "up to this simulated time, s");
  app.add_option("--every", options.every, "every n-th frame of these; default 1")->check(CLI::PositiveNumber);
  app.add_option("--fields", options.fields, "of velocities, stretch, stress; default: what was streamed")
      ->delimiter(',')
      ->check(CLI::IsMember({"positions", "velocities", "stretch", "stress"}));
  app.add_flag("--force", options.force, "replace files that exist");
  app.add_flag("--json", options.json, "print what was written as JSON");
  app.set_version_flag("--version", std::string("flexcast-export ") + FLEXCAST_VERSION);
  try {
    app.parse(argc, argv);
    options.from = parse_time("--from", from);
    options.to = parse_time("--to", to);
    check_together(options);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (run_given->count() > 0) options.run = run;
  return options;
}

}  // namespace flexcast::exporting
