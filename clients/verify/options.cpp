#include "clients/verify/options.h"

#include <CLI/CLI.hpp>

namespace flexcast::verify {
namespace {

constexpr const char* example = R"(
Example:
  flexcast-verify drop.mcap --threads 2

executes every run of the recording once more, from its scene and events, and compares the state of each recorded frame
to the last bit. Needs no network. Exit code: 0 all frames equal, 1 a difference or a recording that lacks something,
2 bad usage.)";

}  // namespace

std::variant<Options, int> parse_options(int argc, const char* const* argv, std::ostream& out, std::ostream& err) {
  Options options;
  std::uint64_t run = 0;
  CLI::App app("Proves a recording: the same scene and events give the same bits.", "flexcast-verify");
  app.footer(example);
  app.add_option("RUN.mcap", options.file, "the recording")->required();
  app.add_option("--threads", options.threads, "threads of the engine; any number gives the same bits; default 1")
      ->check(CLI::Range(1, 1024));
  const auto* given = app.add_option("--run", run, "only this run: 1 is the first of the recording, or its run_id")
                          ->check(CLI::PositiveNumber);
  app.add_flag("--json", options.json, "print the result as JSON");
  app.set_version_flag("--version", std::string("flexcast-verify ") + FLEXCAST_VERSION);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error, out, err) == 0 ? 0 : 2;
  }
  if (given->count() > 0) options.run = run;
  return options;
}

}  // namespace flexcast::verify
