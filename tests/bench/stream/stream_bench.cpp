// flexcast-stream-bench: what a subscriber that is stopped, killed or slow costs the simulation and the others.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "tests/bench/stream/fault_run.h"
#include "tests/bench/stream/percentiles.h"
#include "tests/bench/stream/subscriber.h"

namespace {

using namespace flexcast::bench;

constexpr const char* example = R"(
Example:
  flexcast-stream-bench --seconds 10 --fault stop --fault kill

A sheet of springs runs in real time and is read by three processes. One of them is stopped, killed or slow for the
middle third of the time. A row is the time of a step without and with that, the frames that the two others lost, and
those that were not published since the machine was too busy. The fault 'none' shows how much the figures vary by
themselves.)";

const std::vector<StreamCase> cases = {{"24 KB at 1000 Hz", 39, 49, 0.001}, {"2.4 MB at 60 Hz", 399, 499, 1.0 / 60.0}};

void print_row(const StreamCase& stream, Fault fault, const FaultResult& result) {
  const auto pair = [&](double fraction) {
    const double without = 1e3 * calc_percentile(result.healthy_steps, fraction);
    const double with = 1e3 * calc_percentile(result.faulty_steps, fraction);
    return fmt::format("{:9.4f} {:9.4f} {:+7.1f} %", without, with, 100.0 * (with / without - 1.0));
  };
  std::puts(fmt::format("{:<17} {:<9} {} {} {:>5} {:>7}", stream.name, name_of(fault), pair(0.50), pair(0.99),
                        result.lost, result.skipped)
                .c_str());
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  double seconds = 10.0;
  int domain = 99;
  std::size_t subscriber = 0;
  std::string only;
  std::vector<Fault> faults;
  const std::map<std::string, Fault> names = {
      {"none", Fault::none}, {"stop", Fault::stop}, {"kill", Fault::kill}, {"throttle", Fault::throttle}};
  CLI::App app("Times the steps of a streamed world while one of its subscribers has a fault.",
               "flexcast-stream-bench");
  app.footer(example);
  app.add_option("--seconds", seconds, "of each row; default 10")->check(CLI::Range(0.3, 3600.0));
  app.add_option("--domain", domain, "DDS domain; default 99")->check(CLI::Range(0, 230));
  app.add_option("--only", only, "only the streams whose name contains this");
  app.add_option("--fault", faults, "none, stop, kill or throttle; may be repeated; default: all")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->transform(CLI::CheckedTransformer(names));
  app.add_option("--subscriber", subscriber, "be one of the three, of frames of so many bytes")->group("");
  app.set_version_flag("--version", std::string("flexcast-stream-bench ") + FLEXCAST_VERSION);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (subscriber > 0) return run_subscriber(domain, subscriber);
  spdlog::set_level(spdlog::level::warn);
  if (faults.empty()) faults = {Fault::none, Fault::stop, Fault::kill, Fault::throttle};
  std::puts("stream            fault      p50, ms:    with              p99, ms:    with               lost skipped");
  for (const StreamCase& stream : cases) {
    if (stream.name.find(only) == std::string::npos) continue;
    for (const Fault fault : faults) print_row(stream, fault, run_with_fault(stream, fault, seconds, domain));
  }
  return 0;
}
