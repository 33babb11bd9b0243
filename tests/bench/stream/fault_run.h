// FaultRun: three subscribers of a stream, of which one has a fault for a third of the time.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/bench/stream/stream_world.h"

namespace flexcast::bench {

enum class Fault { none, stop, kill, throttle };

const char* name_of(Fault fault);

struct FaultResult {
  std::vector<double> healthy_steps, faulty_steps;  // s
  std::uint64_t lost = 0;                           // frames that were published, by the two healthy subscribers
  std::uint64_t skipped = 0;                        // frames, by the simulation: the publisher lagged
};

// `seconds` in all, after a second of warming up. A killed subscriber does not come back: what follows its third is
// neither healthy nor faulty, since its lease runs still.
FaultResult run_with_fault(const StreamCase& stream, Fault fault, double seconds, int domain);

}  // namespace flexcast::bench
