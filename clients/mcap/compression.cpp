#include "clients/mcap/compression.h"

#include <lz4frame.h>
#include <zstd.h>

#include <string>

namespace flexcast::mcap {

struct Compressor::Contexts {
  std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> zstd{nullptr, &ZSTD_freeCCtx};
};

std::string_view compression_name(Compression compression) {
  switch (compression) {
    case Compression::kLz4:
      return "lz4";
    case Compression::kZstd:
      return "zstd";
    case Compression::kNone:
      break;
  }
  return "";
}

Compressor::Compressor(Compression compression, int zstd_level)
    : compression_(compression), zstd_level_(zstd_level), contexts_(std::make_unique<Contexts>()) {
  if (compression_ == Compression::kZstd) contexts_->zstd.reset(ZSTD_createCCtx());
}

Compressor::~Compressor() = default;

Result<Bytes> Compressor::compress(Bytes bytes) {
  switch (compression_) {
    case Compression::kLz4:
      return compress_lz4(bytes);
    case Compression::kZstd:
      return compress_zstd(bytes);
    case Compression::kNone:
      break;
  }
  return bytes;
}

// One frame of independent blocks that says its size: what every decoder reads, the small ones on npm included.
Result<Bytes> Compressor::compress_lz4(Bytes bytes) {
  LZ4F_preferences_t preferences = LZ4F_INIT_PREFERENCES;
  preferences.frameInfo.blockSizeID = LZ4F_max4MB;
  preferences.frameInfo.blockMode = LZ4F_blockIndependent;
  preferences.frameInfo.contentSize = bytes.size();
  const std::size_t bound = LZ4F_compressFrameBound(bytes.size(), &preferences);
  if (packed_.size() < bound) packed_.resize(bound);
  const std::size_t size = LZ4F_compressFrame(packed_.data(), packed_.size(), bytes.data(), bytes.size(), &preferences);
  if (LZ4F_isError(size) != 0U) return Status::failure(std::string("lz4 failed: ") + LZ4F_getErrorName(size));
  return Bytes(packed_.data(), size);
}

Result<Bytes> Compressor::compress_zstd(Bytes bytes) {
  if (!contexts_->zstd) return Status::failure("zstd failed: no memory for its context");
  const std::size_t bound = ZSTD_compressBound(bytes.size());
  if (packed_.size() < bound) packed_.resize(bound);
  const std::size_t size =
      ZSTD_compressCCtx(contexts_->zstd.get(), packed_.data(), packed_.size(), bytes.data(), bytes.size(), zstd_level_);
  if (ZSTD_isError(size) != 0U) return Status::failure(std::string("zstd failed: ") + ZSTD_getErrorName(size));
  return Bytes(packed_.data(), size);
}

}  // namespace flexcast::mcap
