// flexcast-bench: one table of what kernels and steps cost, in Markdown, row by row as they are measured.
#include <CLI/CLI.hpp>
#include <iostream>
#include <regex>

#include "tests/bench/report_rows.h"

namespace {

using namespace flexcast;
using namespace flexcast::bench;

std::string check_regex(const std::string& text) {
  try {
    std::regex{text};
    return "";
  } catch (const std::regex_error& error) {
    return "--only " + text + ": " + error.what();
  }
}

void print(const ReportRow& row) {
  std::cout << make_line(row) << std::flush;
}

}  // namespace

int main(int argc, char** argv) {
  bool quick = false, list = false;
  std::string only;
  flexcast::TurnSettings settings;
  settings.turns = 101;
  settings.least_turns = 3;
  settings.budget = 10.0;
  CLI::App app("Times kernels and steps of beams and cloths; prints one table.", "flexcast-bench");
  app.add_flag("--quick", quick, "Beams of n = 3 and 6 and the smaller cloth alone");
  app.add_option("--only", only, "Scenes whose name has a match")->type_name("REGEX")->check(check_regex);
  app.add_option("--budget", settings.budget, "Seconds a scene after which no further turn begins; default 10")
      ->check(CLI::NonNegativeNumber);
  app.add_flag("--list", list, "Print the names of the scenes alone");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }

  const std::regex pattern(only);
  const auto is_wanted = [&](const NamedScene& scene) {
    const bool wanted = std::regex_search(scene.name, pattern);
    if (wanted && list) std::cout << scene.name << "\n";
    return wanted && !list;
  };
  if (!list) std::cout << make_header() << std::flush;
  for (const NamedScene& scene : make_kernel_scenes(quick)) {
    if (!is_wanted(scene)) continue;
    for (const ReportRow& row : measure_kernel_rows(scene, settings)) print(row);
  }
  for (const NamedScene& scene : make_step_scenes(quick)) {
    if (is_wanted(scene)) print(measure_step_row(scene, settings));
  }
  return std::cout ? 0 : 1;
}
