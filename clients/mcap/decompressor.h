// Decompressor: unpacks the records of a chunk.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

#include "clients/mcap/status.h"
#include "clients/mcap/types.h"

namespace flexcast::mcap {

class Decompressor {
 public:
  // No chunk may unpack to more than `max_bytes`, whatever the file says.
  explicit Decompressor(std::uint64_t max_bytes);
  ~Decompressor();
  Decompressor(const Decompressor&) = delete;
  Decompressor& operator=(const Decompressor&) = delete;

  // `packed` unpacked to exactly `bytes` bytes, valid until the next call. `compression` as in the file; with ""
  // these are `packed` itself.
  Result<Bytes> decompress(std::string_view compression, Bytes packed, std::uint64_t bytes);

 private:
  struct Contexts;  // the libraries' own types

  Status grow(std::uint64_t bytes);
  Status decompress_lz4(Bytes packed, std::uint64_t bytes);
  Status decompress_zstd(Bytes packed, std::uint64_t bytes);

  std::uint64_t max_bytes_;
  std::unique_ptr<Contexts> contexts_;
  std::unique_ptr<std::byte[]> unpacked_;
  std::uint64_t capacity_ = 0;
};

}  // namespace flexcast::mcap
