// The other side of the benches: a process that reads the frames of worlds and counts them. It reads one-word commands
// from its standard input and ends with it:
//   clear   count anew
//   slow    take a sample a tenth of a second from now on
//   fast    take all as they come
//   report  prints {"WORLD": {"frames": N, "missing": N, "p50": s, "p99": s}, ...} of latencies, on a line
#pragma once

#include <cstddef>

namespace flexcast::bench {

// Who takes the samples: a thread that waits in a wait set, as in our clients, or Cyclone's receive thread itself, by a
// listener, as in ddsperf.
enum class TakeBy { wait_set, listener };

// Prints "matched" once it has found a writer of frames. Returns the exit code. "slow" is for wait sets.
int run_subscriber(int domain, std::size_t frame_bytes, TakeBy take_by = TakeBy::wait_set);

}  // namespace flexcast::bench
