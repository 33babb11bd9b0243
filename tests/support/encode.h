// Bytes of a sample as a writer sends them, without a network.
#pragma once

#include <dds/dds.h>
#include <dds/ddsi/ddsi_cdrstream.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "idl/wire/types.h"

namespace flexcast::test {

template <class T>
std::vector<std::byte> encode(const T& sample) {
  dds_ostream_t stream;
  dds_ostream_init(&stream, 0, 1);
  dds_stream_write(&stream, reinterpret_cast<const char*>(&sample), wire::descriptor_of<T>().m_ops);
  const std::size_t padding = (4 - stream.m_index % 4) % 4;
  std::vector<std::byte> bytes(4 + stream.m_index + padding);
  bytes[1] = std::byte{1};
  bytes[3] = static_cast<std::byte>(padding);
  std::transform(stream.m_buffer, stream.m_buffer + stream.m_index, bytes.begin() + 4,
                 [](unsigned char byte) { return std::byte{byte}; });
  dds_ostream_fini(&stream);
  return bytes;
}

}  // namespace flexcast::test
