#include "tests/bench/stream/publish_latency.h"

#include <nlohmann/json.hpp>
#include <thread>

#include "tests/bench/stream/bare_feed.h"
#include "tests/bench/stream/child.h"
#include "tests/bench/stream/frame_feed.h"
#include "tests/bench/stream/frame_tally.h"

namespace flexcast::bench {
namespace {

Latency latency_of(const nlohmann::json& report, const char* world) {
  if (!report.contains(world)) return {};
  return {report[world]["p50"].get<double>(), report[world]["p99"].get<double>()};
}

}  // namespace

Latencies measure_latencies(int domain, std::int64_t particles, double rate, double seconds) {
  const auto participant = join(domain);
  FrameFeed ours(participant, particles);
  BareFeed bare(participant, particles);
  Child subscriber("/proc/self/exe",
                   {"--subscriber", std::to_string(12 * particles), "--domain", std::to_string(domain)});
  subscriber.hear();
  const std::chrono::duration<double> half_period(0.5 / rate);
  const auto run_for = [&](double span) {
    for (const double end = monotonic_seconds() + span; monotonic_seconds() < end;) {
      ours.push();
      std::this_thread::sleep_for(half_period);
      bare.push();
      std::this_thread::sleep_for(half_period);
    }
  };
  run_for(1.0);
  subscriber.tell("clear");
  run_for(seconds);
  subscriber.tell("report");
  const auto report = nlohmann::json::parse(subscriber.hear());
  return {latency_of(report, "ours"), latency_of(report, "bare")};
}

}  // namespace flexcast::bench
