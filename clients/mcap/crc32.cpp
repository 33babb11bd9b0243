#include "clients/mcap/crc32.h"

#include <zlib.h>

namespace flexcast::mcap {

std::uint32_t crc32(Bytes bytes, std::uint32_t start) {
  if (bytes.empty()) return start;  // zlib reads a null pointer as "give me the initial value"
  return static_cast<std::uint32_t>(::crc32_z(start, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

std::uint32_t crc32_join(std::uint32_t first, std::uint32_t second, std::uint64_t second_bytes) {
  return static_cast<std::uint32_t>(::crc32_combine(first, second, static_cast<z_off_t>(second_bytes)));
}

}  // namespace flexcast::mcap
