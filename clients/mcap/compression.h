// How the records of a chunk are packed.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "clients/mcap/status.h"
#include "clients/mcap/types.h"

namespace flexcast::mcap {

enum class Compression { kNone, kLz4, kZstd };

// The name as it stands in the file: "", "lz4" or "zstd".
std::string_view compression_name(Compression compression);

// Packs one chunk after the other; contexts and the output buffer are kept between them.
class Compressor {
 public:
  // `zstd_level`: 1 (fast) to 22 (small).
  Compressor(Compression compression, int zstd_level);
  ~Compressor();
  Compressor(const Compressor&) = delete;
  Compressor& operator=(const Compressor&) = delete;

  // The packed bytes, valid until the next call; with kNone these are `bytes` themselves.
  Result<Bytes> compress(Bytes bytes);

 private:
  struct Contexts;  // the libraries' own types

  Result<Bytes> compress_lz4(Bytes bytes);
  Result<Bytes> compress_zstd(Bytes bytes);

  Compression compression_;
  int zstd_level_;
  std::unique_ptr<Contexts> contexts_;
  std::vector<std::byte> packed_;
};

}  // namespace flexcast::mcap
