// encode(): a struct as the bytes that a writer would send, for recordings that are made without a network.
#pragma once

#include <dds/dds.h>
#include <dds/ddsi/ddsi_cdrstream.h>

#include <cstddef>
#include <cstring>
#include <vector>

#include "idl/wire/types.h"

namespace flexcast::test {

// Little-endian XCDR1 with its 4-byte header, padded to a multiple of four.
template <class T>
std::vector<std::byte> encode(const T& sample) {
  dds_ostream_t stream;
  dds_ostream_init(&stream, 256, 1);
  dds_stream_write(&stream, reinterpret_cast<const char*>(&sample), wire::descriptor_of<T>().m_ops);
  const std::size_t size = stream.m_index, padding = (4 - size % 4) % 4;
  std::vector<std::byte> bytes(4 + size + padding);
  bytes[1] = std::byte{1};
  bytes[3] = static_cast<std::byte>(padding);
  std::memcpy(bytes.data() + 4, stream.m_buffer, size);
  dds_ostream_fini(&stream);
  return bytes;
}

}  // namespace flexcast::test
