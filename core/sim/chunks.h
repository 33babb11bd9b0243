// Large samples go as chunks: runs of an array, each at most 1 MiB with everything around it.
#pragma once

#include <cstddef>
#include <cstdint>

namespace flexcast {

inline constexpr std::size_t chunk_bytes = std::size_t{1} << 20;
inline constexpr std::size_t chunk_overhead = 512;  // fixed fields, world name, sequence lengths

// How many chunks `count` elements of `element_bytes` need; at least one.
inline std::uint32_t count_chunks(std::size_t count, std::size_t element_bytes) {
  const std::size_t most = element_bytes == 0 ? count : (chunk_bytes - chunk_overhead) / element_bytes;
  return count == 0 ? 1 : static_cast<std::uint32_t>((count + most - 1) / most);
}

struct ChunkRun {
  std::size_t first = 0;
  std::size_t count = 0;
};

// The chunk's share of `count` elements: equal runs that follow each other without gap.
inline ChunkRun chunk_run(std::size_t count, std::uint32_t chunk, std::uint32_t chunks) {
  const std::size_t first = count * chunk / chunks;
  return {first, count * (chunk + 1) / chunks - first};
}

}  // namespace flexcast
