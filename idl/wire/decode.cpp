// The only file that uses Cyclone's internal (not stable) interface of CDR streams.
#include "idl/wire/decode.h"

#include <dds/dds.h>
#include <dds/ddsi/ddsi_cdrstream.h>

#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

namespace flexcast::wire {
namespace {

constexpr std::uint32_t xcdr1 = 1;
constexpr std::size_t header_bytes = 4;

bool is_little_endian_xcdr1(std::span<const std::byte> cdr) {
  return cdr.size() >= header_bytes && cdr[0] == std::byte{0} && cdr[1] == std::byte{1};
}

}  // namespace

Result<void> decode(void* sample, const dds_topic_descriptor_t& descriptor, std::span<const std::byte> cdr) {
  if (!is_little_endian_xcdr1(cdr)) return Error{"the bytes are not little-endian XCDR1"};
  const std::size_t padding = std::to_integer<std::size_t>(cdr[3] & std::byte{3});
  const auto body = cdr.subspan(header_bytes);
  if (padding > body.size() || body.size() > std::numeric_limits<std::uint32_t>::max()) {
    return Error{"the bytes are no " + std::string(descriptor.m_typename)};
  }
  const auto size = static_cast<std::uint32_t>(body.size() - padding);
  std::vector<std::uint64_t> aligned(size / sizeof(std::uint64_t) + 1);
  auto* const bytes = reinterpret_cast<char*>(aligned.data());
  std::memcpy(bytes, body.data(), size);
  std::uint32_t checked = 0;
  if (dds_stream_normalize_data(bytes, &checked, size, false, xcdr1, descriptor.m_ops) == nullptr || checked != size) {
    return Error{"the bytes are no " + std::string(descriptor.m_typename)};
  }
  dds_istream_t stream;
  dds_istream_init(&stream, size, bytes, xcdr1);
  dds_stream_read(&stream, static_cast<char*>(sample), descriptor.m_ops);
  dds_istream_fini(&stream);
  return {};
}

}  // namespace flexcast::wire
