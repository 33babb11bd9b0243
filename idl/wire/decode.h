// Serialised samples back to structs, without a network: for recordings.
#pragma once

#include <cstddef>
#include <span>

#include "idl/wire/owned.h"
#include "idl/wire/result.h"

namespace flexcast::wire {

// Fills a zeroed struct of the descriptor's type from `cdr` (with its 4-byte header). Trusts nothing: bytes that are no
// little-endian XCDR1 sample of the type are an error, and the struct stays zeroed.
Result<void> decode(void* sample, const dds_topic_descriptor_t& descriptor, std::span<const std::byte> cdr);

// auto event = wire::decode<flexcast_Event>(message.data);
template <class T>
Result<Owned<T>> decode(std::span<const std::byte> cdr) {
  Owned<T> sample;
  if (auto decoded = decode(&*sample, descriptor_of<T>(), cdr); !decoded) return decoded.error();
  return sample;
}

}  // namespace flexcast::wire
