#include "tests/bench/stream/publish_rate.h"

#include <nlohmann/json.hpp>

#include "tests/bench/stream/child.h"
#include "tests/bench/stream/frame_feed.h"
#include "tests/bench/stream/frame_tally.h"

namespace flexcast::bench {

double measure_publish_rate(int domain, std::int64_t particles, double seconds) {
  const auto participant = join(domain);
  FrameFeed feed(participant, particles);
  Child subscriber("/proc/self/exe",
                   {"--subscriber", std::to_string(12 * particles), "--domain", std::to_string(domain), "--listener"});
  subscriber.hear();
  feed.push_for(1.0);
  subscriber.tell("clear");
  const double begin = monotonic_seconds();
  feed.push_for(seconds);
  subscriber.tell("report");
  const auto report = nlohmann::json::parse(subscriber.hear());
  const double end = monotonic_seconds();
  return report.value("/ours/frames"_json_pointer, 0.0) / (end - begin);
}

}  // namespace flexcast::bench
