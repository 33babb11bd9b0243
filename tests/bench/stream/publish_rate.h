// How many frames a second a subscriber in another process gets when the server publishes as fast as it can.
#pragma once

#include <cstdint>

namespace flexcast::bench {

double measure_publish_rate(int domain, std::int64_t particles, double seconds);

}  // namespace flexcast::bench
