// Qos: the part of DDS quality of service that flexcast uses. Always RELIABLE; writers never dispose on their own.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>

namespace flexcast::wire {

struct Qos {
  bool transient_local = false;                        // late readers get the last `depth` samples of each key
  std::int32_t depth = 1;                              // KEEP_LAST, samples of each key; 0: KEEP_ALL
  std::int32_t max_samples = 0;                        // bound of a KEEP_ALL reader; 0: none
  std::chrono::nanoseconds deadline{0};                // each key is written at least this often; 0: no promise
  std::chrono::nanoseconds lease{0};                   // a dead process is noticed after this (AUTOMATIC); 0: never
  std::chrono::nanoseconds max_blocking{100'000'000};  // how long a KEEP_ALL writer may wait for a reader
};

// A KEEP_LAST writer never waits for a reader; it keeps this much for readers that lag (bytes, of one topic).
inline constexpr std::size_t history_budget = std::size_t{256} << 20;

// flexcast/frames, writer: depth 64, less when frames are large (history_budget), at least 4. `frame_bytes` counts all
// chunks of one frame.
Qos frames_writer_qos(std::size_t frame_bytes);

// flexcast/frames, reader that must not lose any: KEEP_ALL, max_samples so that history_budget holds, at least 4
// frames.
Qos frames_recorder_qos(std::size_t frame_bytes, std::uint32_t chunks);

}  // namespace flexcast::wire
