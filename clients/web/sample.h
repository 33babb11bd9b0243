// Samples on their way from DDS to the clients: never decoded, never copied.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "idl/wire/sample_bytes.h"

namespace flexcast::web {

struct Sample {
  wire::SampleBytes bytes{};  // as they came off the wire
  std::int64_t time = 0;      // ns since 1970, when it was written
};

struct WholeFrame {
  std::uint64_t run_id = 0;
  std::uint64_t frame = 0;
  std::vector<Sample> chunks{};    // in order
  std::optional<Sample> points{};  // the same as a foxglove::PointCloud, if somebody wants it
};

using FramePointer = std::shared_ptr<const WholeFrame>;  // shared: by all clients it is sent to

}  // namespace flexcast::web
