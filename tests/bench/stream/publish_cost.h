// What publishing a frame costs in CPU time, in whichever thread: other programs of the machine disturb it little.
#pragma once

#include <cstdint>

namespace flexcast::bench {

struct Cost {
  double ours = 0.0, bare = 0.0;  // s a frame: capturing the state and writing; writing what is ready
};

// Blocks of frames in turns, to one subscriber.
Cost measure_publish_cost(int domain, std::int64_t particles, double seconds);

}  // namespace flexcast::bench
