// The rate that ddsperf (Debian: cyclonedds-tools) reaches between two processes, for comparison.
#pragma once

#include <cstddef>
#include <optional>

namespace flexcast::bench {

// Samples of so many bytes a second that its subscriber gets, KEEP_LAST `depth` on both sides; none if there is no such
// program or it says nothing that is understood. Takes two seconds more.
std::optional<double> measure_ddsperf(int domain, std::size_t bytes, int depth, double seconds);

}  // namespace flexcast::bench
