// The checksum of the format: CRC-32 as in zlib (polynomial 0x04C11DB7, reflected).
#pragma once

#include <cstdint>

#include "clients/mcap/types.h"

namespace flexcast::mcap {

// The checksum of `bytes`, or of what gave `start` followed by `bytes`.
std::uint32_t crc32(Bytes bytes, std::uint32_t start = 0);

// The checksum of A followed by B from theirs alone; `second_bytes` is the length of B.
std::uint32_t crc32_join(std::uint32_t first, std::uint32_t second, std::uint64_t second_bytes);

}  // namespace flexcast::mcap
