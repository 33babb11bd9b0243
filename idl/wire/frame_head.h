// The fixed-size head of a serialised ParticleFrame: readable at fixed offsets, without decoding the sample.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "idl/wire/result.h"

namespace flexcast::wire {

// Byte offsets from the start of the sample, the 4-byte CDR header included.
namespace frame_offset {
inline constexpr std::size_t run_id = 4;
inline constexpr std::size_t frame = 12;
inline constexpr std::size_t step = 20;
inline constexpr std::size_t time = 28;
inline constexpr std::size_t parameter_revision = 36;
inline constexpr std::size_t topology_revision = 44;
inline constexpr std::size_t state_hash = 52;
inline constexpr std::size_t chunk = 60;
inline constexpr std::size_t chunks = 64;
inline constexpr std::size_t first = 68;
inline constexpr std::size_t total = 72;
inline constexpr std::size_t bounds = 76;         // six doubles
inline constexpr std::size_t world_length = 124;  // u32, the final zero counted
inline constexpr std::size_t world = 128;
}  // namespace frame_offset

struct FrameHead {
  std::uint64_t run_id = 0;
  std::uint64_t frame = 0;
  std::uint64_t step = 0;
  double time = 0;
  std::uint64_t parameter_revision = 0;
  std::uint64_t topology_revision = 0;
  std::uint64_t state_hash = 0;
  std::uint32_t chunk = 0;
  std::uint32_t chunks = 0;
  std::uint32_t first = 0;
  std::uint32_t total = 0;
  std::array<double, 6> bounds{};
  std::string_view world;  // within `bytes`
};

// An error if the bytes are too few or not little-endian XCDR1 (CDR header 00 01), which flexcast's servers always
// send.
Result<FrameHead> peek_frame_head(std::span<const std::byte> bytes);

}  // namespace flexcast::wire
