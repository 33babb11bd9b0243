// The other side of the benches: a process that reads the frames of worlds and counts them. It reads one-word commands
// from its standard input and ends with it:
//   clear   count anew
//   slow    take a sample a tenth of a second from now on
//   fast    take all as they come
//   report  prints {"WORLD": {"frames": N, "missing": N, "p50": s, "p99": s}, ...} of latencies, on a line
#pragma once

#include <cstddef>

namespace flexcast::bench {

// Prints "matched" once it has found a writer of frames. Returns the exit code.
int run_subscriber(int domain, std::size_t frame_bytes);

}  // namespace flexcast::bench
