// flexcast-publish-bench: what our way from the simulation to the network costs over Cyclone DDS alone.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>

#include "idl/wire/memory.h"
#include "idl/wire/profile.h"
#include "idl/wire/qos.h"
#include "tests/bench/stream/ddsperf.h"
#include "tests/bench/stream/percentiles.h"
#include "tests/bench/stream/publish_cost.h"
#include "tests/bench/stream/publish_latency.h"
#include "tests/bench/stream/publish_rate.h"
#include "tests/bench/stream/subscriber.h"

namespace {

using namespace flexcast;
using namespace flexcast::bench;

constexpr const char* example = R"(
Example:
  flexcast-publish-bench --seconds 3 --repeats 3

Rate: frames through mailbox and publisher as fast as they go, against the samples of ddsperf, in turns; either's
subscriber takes in Cyclone's receive thread. Latency: from the end of a step to a subscriber with a thread of its own,
against a writer and a reader alone, in turns. Cost: CPU time of capturing and writing a frame, against a writer alone,
in turns. Medians of the repeats; ratios of neighbours in time.)";

struct Size {
  int kilobytes = 0;
  double rate = 0.0;  // frames a second at which latency is measured

  std::int64_t particles() const { return std::int64_t{1000} * kilobytes / 12; }
  std::string name() const {
    return kilobytes < 1000 ? fmt::format("{} KB", kilobytes) : fmt::format("{:g} MB", kilobytes / 1000.0);
  }
};

struct Settings {
  int domain = 98;
  double seconds = 3.0;
  int repeats = 3;
  bool ddsperf = true;
};

double median(const std::vector<double>& values) {
  return calc_percentile(values, 0.5);
}

void bench_rate(const Size& size, const Settings& settings) {
  const auto bytes = static_cast<std::size_t>(12 * size.particles());
  std::vector<double> ours, theirs, ratios;
  for (int i = 0; i < settings.repeats; ++i) {
    ours.push_back(measure_publish_rate(settings.domain, size.particles(), settings.seconds));
    if (!settings.ddsperf) continue;
    const auto rate = measure_ddsperf(settings.domain, bytes, wire::frames_writer_qos(bytes).depth, settings.seconds);
    if (!rate) continue;
    theirs.push_back(*rate);
    ratios.push_back(ours.back() / *rate);
  }
  std::puts(fmt::format("{:<7} rate, frames/s     ours {:8.0f}   ddsperf {:8.0f}   ratio {:5.2f}", size.name(),
                        median(ours), median(theirs), median(ratios))
                .c_str());
  std::fflush(stdout);
}

void bench_latency(const Size& size, const Settings& settings) {
  std::vector<double> ours, bare, ratios, tails;
  for (int i = 0; i < settings.repeats; ++i) {
    const auto latencies = measure_latencies(settings.domain, size.particles(), size.rate, settings.seconds);
    ours.push_back(1e3 * latencies.ours.p50);
    bare.push_back(1e3 * latencies.bare.p50);
    ratios.push_back(latencies.ours.p50 / latencies.bare.p50);
    tails.push_back(latencies.ours.p99 / latencies.bare.p99);
  }
  std::puts(fmt::format("{:<7} latency p50, ms    ours {:8.3f}   bare    {:8.3f}   ratio {:5.2f}   of p99 {:5.2f}",
                        size.name(), median(ours), median(bare), median(ratios), median(tails))
                .c_str());
  std::fflush(stdout);
}

void bench_cost(const Size& size, const Settings& settings) {
  std::vector<double> ours, bare, ratios;
  for (int i = 0; i < settings.repeats; ++i) {
    const Cost cost = measure_publish_cost(settings.domain, size.particles(), settings.seconds);
    ours.push_back(1e3 * cost.ours);
    bare.push_back(1e3 * cost.bare);
    ratios.push_back(cost.ours / cost.bare);
  }
  std::puts(fmt::format("{:<7} cost, CPU ms       ours {:8.3f}   bare    {:8.3f}   ratio {:5.2f}", size.name(),
                        median(ours), median(bare), median(ratios))
                .c_str());
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  wire::keep_freed_memory();  // as server and recorder do
  Settings settings;
  std::size_t subscriber = 0;
  int only = 0;
  bool no_ddsperf = false, by_listener = false;
  CLI::App app("Times the server's way to publish against Cyclone DDS alone.", "flexcast-publish-bench");
  app.footer(example);
  app.add_option("--seconds", settings.seconds, "of each measurement; default 3")->check(CLI::Range(0.1, 3600.0));
  app.add_option("--repeats", settings.repeats, "of each measurement; default 3")->check(CLI::Range(1, 1000));
  app.add_option("--domain", settings.domain, "DDS domain; default 98")->check(CLI::Range(0, 230));
  app.add_option("--only", only, "only frames of so many KB: 24, 240 or 2400");
  app.add_flag("--no-ddsperf", no_ddsperf, "without the comparison with ddsperf");
  app.add_option("--subscriber", subscriber, "be the reader, of frames of so many bytes")->group("");
  app.add_flag("--listener", by_listener, "as that reader: take in Cyclone's receive thread")->group("");
  app.set_version_flag("--version", std::string("flexcast-publish-bench ") + FLEXCAST_VERSION);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  // For all processes, ddsperf among them.
  setenv("CYCLONEDDS_URI", wire::resolve_profile("loopback").value().config.c_str(), 1);
  if (subscriber > 0) {
    return run_subscriber(settings.domain, subscriber, by_listener ? TakeBy::listener : TakeBy::wait_set);
  }
  spdlog::set_level(spdlog::level::warn);
  settings.ddsperf = !no_ddsperf;
  for (const Size& size : {Size{24, 500.0}, Size{240, 200.0}, Size{2400, 20.0}}) {
    if (only != 0 && only != size.kilobytes) continue;
    bench_rate(size, settings);
    bench_latency(size, settings);
    bench_cost(size, settings);
  }
  return 0;
}
