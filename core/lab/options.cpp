#include "core/lab/options.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <sstream>

#include "core/integrators/integrator.h"

namespace flexcast {
namespace {

constexpr const char* footer =
    "Examples:\n"
    "  flexcast-lab run server/scenes/cantilever.toml --until 2 --csv tip.csv\n"
    "  flexcast-lab run server/scenes/cloth.toml --steps 100 --set cloth.stiffness=5 --set 'gravity=[0,0,-3]' "
    "--json\n"
    "\n"
    "Results go to stdout, warnings and progress to stderr. Exit code: 0 success, 1 the scene or the simulation "
    "failed,\n"
    "2 bad usage.";

std::string check_assignment(const std::string& text) {
  const std::size_t equals = text.find('=');
  return equals == std::string::npos || equals == 0 ? "--set " + text + ": expected PATH=VALUE" : "";
}

std::string check_time(const std::string& text) {
  double value = 0.0;
  const bool good = CLI::detail::lexical_cast(text, value) && std::isfinite(value) && value >= 0.0;
  return good ? "" : "--until " + text + ": expected a number >= 0, s";
}

void add_overrides(CLI::App& verb, std::vector<std::string>& overrides) {
  verb.add_option("--set", overrides,
                  "A value of the scene or a parameter, written as in TOML: time.step=1e-4, beam.young=2e5")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false)
      ->check(check_assignment);
}

void add_threads(CLI::App& verb, int& threads) {
  verb.add_option("--threads", threads, "Threads of the engine, default 1; any number gives the same bits")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
}

void add_bench(CLI::App& app, BenchOptions& options) {
  CLI::App* bench = app.add_subcommand(
      "bench", "Time a scene's forces, tangent, conjugate gradients and first 30 steps; nanoseconds an element.");
  bench->footer("Example:\n  flexcast-lab bench server/scenes/cantilever.toml --threads 2 --set beam.law=neo_hookean");
  bench->add_option("scene", options.scene, "Scene file (TOML)")->required()->type_name("SCENE");
  add_threads(*bench, options.threads);
  add_overrides(*bench, options.overrides);
  bench->add_flag("--json", options.json, "Print JSON");
}

void add_modes(CLI::App& app, ModesOptions& options) {
  CLI::App* modes =
      app.add_subcommand("modes", "Print natural frequencies of a scene, and the explicit step it allows.");
  modes->footer("Example:\n  flexcast-lab modes server/scenes/cantilever.toml --count 10 --static");
  modes->add_option("scene", options.scene, "Scene file (TOML)")->required()->type_name("SCENE");
  modes->add_option("--count", options.count, "Number of the lowest modes")->type_name("N")->check(CLI::Range(1, 1000));
  modes->add_flag("--static", options.at_equilibrium, "About the equilibrium instead of the start");
  add_overrides(*modes, options.overrides);
  modes->add_flag("--json", options.json, "Print JSON");
}

void add_limits(CLI::App& app, LimitsOptions& options) {
  CLI::App* limits = app.add_subcommand(
      "limits", "Measure where each integrator blows up, next to what is predicted, over decades of what it hangs on.");
  limits->footer("Example:\n  flexcast-lab limits server/scenes/cantilever.toml -o limits --vary stiffness,damping");
  std::vector<std::string> schemes;
  for (const IntegratorRow& row : integrators()) schemes.emplace_back(row.name);
  limits->add_option("scene", options.scene, "Scene file (TOML)")->required()->type_name("SCENE");
  limits->add_option("-o,--output", options.folder, "Folder for limits.csv, limits.json and limits.svg")
      ->required()
      ->type_name("DIR");
  limits->add_option("--integrators", options.integrators, "Default: all that know time")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::IsMember(schemes));
  limits->add_option("--vary", options.quantities, "Default: all of them")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::IsMember(variation_names()));
  limits->add_option("--points", options.points, "Values of each quantity, default 7")
      ->type_name("N")
      ->check(CLI::Range(1, 1000));
  limits->add_option("--budget", options.budget, "Time for the measurements, default 60 s")
      ->type_name("SECONDS")
      ->check(CLI::Range(0.0, 1e9));
  add_threads(*limits, options.threads);
  add_overrides(*limits, options.overrides);
  limits->add_flag("--json", options.json, "Print JSON");
}

void add_plot(CLI::App& app, PlotOptions& options) {
  CLI::App* plot = app.add_subcommand("plot", "Draw columns of CSV files as lines, into an SVG picture.");
  plot->footer("Example:\n  flexcast-lab plot coarse.csv fine.csv -o tip.svg --y tip.z --title 'Tip of the beam'");
  plot->add_option("files", options.files, "CSV files; the first row names the columns")->required()->type_name("FILE");
  plot->add_option("-o,--output", options.picture, "The picture")->required()->type_name("FILE");
  plot->add_option("--x", options.x, "Column along the x axis, default time")->type_name("COLUMN");
  plot->add_option("--y", options.y, "Columns along the y axis, parted by commas")
      ->required()
      ->type_name("COLUMN,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  plot->add_option("--log", options.logarithmic, "Logarithmic axes: x, y or xy")
      ->check(CLI::IsMember({"x", "y", "xy"}));
  plot->add_option("--title", options.title, "Title of the picture")->type_name("TEXT");
  plot->add_option("--labels", options.labels, "Labels, one a line or one a file; default: names of the files")
      ->type_name("TEXT,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  plot->add_option("--difference", options.difference, "Draw the difference from this file, interpolated over x")
      ->type_name("FILE");
}

void add_scene_cost(CLI::App& app, SceneCostOptions& options) {
  CLI::App* cost =
      app.add_subcommand("scene-cost", "Say what each feature of a scene costs per step, by leaving it out.");
  cost->footer("Example:\n  flexcast-lab scene-cost server/scenes/drape.toml --budget 10");
  cost->add_option("scene", options.scene, "Scene file (TOML)")->required()->type_name("SCENE");
  cost->add_option("--steps", options.steps, "Steps of each variant at most")
      ->type_name("N")
      ->check(CLI::Range(1, 1000000));
  cost->add_option("--budget", options.budget, "Seconds after which no further round of steps begins")
      ->type_name("SECONDS")
      ->check(CLI::PositiveNumber);
  add_threads(*cost, options.threads);
  add_overrides(*cost, options.overrides);
  cost->add_flag("--json", options.json, "Print JSON");
}

void add_run(CLI::App& app, RunOptions& options) {
  CLI::App* run = app.add_subcommand("run", "Run a scene and print the report of its last step and its probes.");
  run->footer(footer);
  run->add_option("scene", options.scene, "Scene file (TOML)")->required()->type_name("SCENE");
  auto* until = run->add_option("--until", options.until, "Simulated time at which to stop, s; round(T / step) steps")
                    ->type_name("T")
                    ->check(check_time);
  run->add_option("--steps", options.steps, "Number of steps; 0: the initial state")
      ->type_name("N")
      ->check(CLI::NonNegativeNumber)
      ->excludes(until);
  add_overrides(*run, options.overrides);
  run->add_flag("--static", options.at_equilibrium, "Solve for equilibrium instead of stepping; handles at their end");
  add_threads(*run, options.threads);
  run->add_option("--csv", options.csv, "File for one row per frame, the initial state first")->type_name("FILE");
  run->add_option("--positions", options.positions, "File for the final positions, one `x y z` a line")
      ->type_name("FILE");
  run->add_flag("--json", options.json, "Print the report as JSON");
}

// A list of numbers separated by commas, each within the range.
template <class Option>
void make_list(Option* option, const char* type, double lo, double hi, const char* expected) {
  option->type_name(type)->delimiter(',')->allow_extra_args(false)->check([=](const std::string& text) {
    double value = 0.0;
    const bool good = CLI::detail::lexical_cast(text, value) && std::isfinite(value) && value >= lo && value <= hi;
    return good ? "" : option->get_name() + " " + text + ": expected " + expected;
  });
}

void add_sweep(CLI::App& trade, TradeOptions& options) {
  std::vector<std::string> names;
  for (const IntegratorRow& row : integrators()) names.emplace_back(row.name);
  trade.add_option("--integrators", options.integrators, "Integrators, default: all but quasi_static")
      ->type_name("A,B")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::IsMember(names));
  make_list(trade.add_option("--dt", options.steps, "Steps of the integrator, s; default: halved while there is time"),
            "H1,H2", 1e-300, 1e300, "a number > 0, s");
  make_list(trade.add_option("--iterations", options.iterations,
                             "Sweeps of xpbd and vbd; 1 also: one Newton iteration of implicit schemes"),
            "N1,N2", 1, 1e6, "a whole number, 1 to 1000000");
  make_list(
      trade.add_option("--tolerances", options.tolerances, "Values of the contract time.tolerance, to be run too"),
      "E1,E2", 1e-300, 1e300, "a number > 0");
  trade.add_option("--elements", options.elements, "tet4, tet10 or both; default: the scene's")
      ->type_name("E1,E2")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::IsMember({"tet4", "tet10"}));
  make_list(trade.add_option("--refine", options.refinements, "Multiply the cells of generated meshes by 2^R"), "R1,R2",
            0, 6, "a whole number, 0 to 6");
}

void add_trade(CLI::App& app, TradeOptions& options, bool& stream) {
  CLI::App* trade = app.add_subcommand(
      "trade", "Measure accuracy against time: run a scene with many settings and compare each with a reference.");
  trade->footer(
      "Example:\n  flexcast-lab trade server/scenes/cantilever.toml -o beam --until 1 --integrators "
      "rk4,backward_euler");
  trade->add_option("scene", options.scene, "Scene file (TOML)")->required()->type_name("SCENE");
  trade->add_option("-o,--output", options.folder, "Folder for trade.csv, trade.json, trade.svg and order.svg")
      ->type_name("DIR");
  make_list(trade->add_option("--until", options.until, "Simulated time, s; default: the scene's duration, or 1"), "T",
            1e-300, 1e300, "a number > 0, s");
  add_sweep(*trade, options);
  make_list(trade->add_option("--budget", options.budget, "Time the whole study may take, s, default 60"), "SECONDS",
            1e-3, 1e9, "a number, 0.001 to 1e9, s");
  make_list(trade->add_option("--repeats", options.repeats, "Runs of each setting; default: as the budget allows"), "N",
            1, 1000, "a whole number, 1 to 1000");
  add_threads(*trade, options.threads);
  add_overrides(*trade, options.overrides);
  trade->add_flag("--json", options.json, "Print JSON");
  CLI::Option* flag = trade->add_flag("--stream", stream,
                                      "Instead: bytes against errors of the formats of the stream; -o DIR, when given, "
                                      "gets stream.csv and stream.json");
  for (const char* name :
       {"--integrators", "--dt", "--iterations", "--tolerances", "--elements", "--refine", "--budget", "--repeats"})
    flag->excludes(trade->get_option(name));
  trade->callback([&options, &stream] {
    if (!stream && options.folder.empty()) throw CLI::RequiredError("--output");
  });
}

StreamTradeOptions make_stream_options(const TradeOptions& trade) {
  StreamTradeOptions options;
  options.scene = trade.scene;
  options.until = trade.until;
  options.overrides = trade.overrides;
  if (!trade.folder.empty()) options.directory = trade.folder;
  options.threads = trade.threads;
  options.json = trade.json;
  return options;
}

}  // namespace

LabCommand parse_lab_command(const std::vector<std::string>& arguments) {
  CLI::App app("flexcast-lab: soft-body scenes without network, what they do and what they cost.", "flexcast-lab");
  app.footer(footer);
  app.set_version_flag("--version", std::string("flexcast-lab ") + FLEXCAST_VERSION);
  app.require_subcommand(1);
  RunOptions run;
  ModesOptions modes;
  BenchOptions bench;
  TradeOptions trade;
  bool stream = false;
  SceneCostOptions cost;
  add_run(app, run);
  add_modes(app, modes);
  add_bench(app, bench);
  PlotOptions plot;
  add_plot(app, plot);
  LimitsOptions limits;
  add_limits(app, limits);
  add_trade(app, trade, stream);
  add_scene_cost(app, cost);
  try {
    app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::ParseError& error) {
    std::ostringstream out, log;
    const bool answered = app.exit(error, out, log) == 0;
    return CommandLineEnd{answered ? out.str() : log.str(), answered ? 0 : 2};
  }
  if (app.got_subcommand("modes")) return modes;
  if (app.got_subcommand("bench")) return bench;
  if (app.got_subcommand("plot")) return plot;
  if (app.got_subcommand("limits")) return limits;
  if (app.got_subcommand("trade") && stream) return make_stream_options(trade);
  if (app.got_subcommand("trade")) return trade;
  if (app.got_subcommand("scene-cost")) return cost;
  return run;
}

}  // namespace flexcast
