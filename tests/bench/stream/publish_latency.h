// How long a frame takes from the end of its step to a subscriber in another process, beside a bare writer's sample of
// the same size.
#pragma once

#include <cstdint>

namespace flexcast::bench {

struct Latency {
  double p50 = 0.0, p99 = 0.0;  // s
};
struct Latencies {
  Latency ours, bare;
};

// Both take turns, at `rate` frames a second each.
Latencies measure_latencies(int domain, std::int64_t particles, double rate, double seconds);

}  // namespace flexcast::bench
