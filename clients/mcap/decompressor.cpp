#include "clients/mcap/decompressor.h"

#include <lz4frame.h>
#include <zstd.h>

#include <new>
#include <string>

namespace flexcast::mcap {
namespace {

Status wrong_size(std::uint64_t bytes) {
  return Status::failure("its records do not unpack to the " + std::to_string(bytes) + " bytes it states");
}

}  // namespace

struct Decompressor::Contexts {
  std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> lz4{nullptr, &LZ4F_freeDecompressionContext};
  std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> zstd{nullptr, &ZSTD_freeDCtx};
};

Decompressor::Decompressor(std::uint64_t max_bytes) : max_bytes_(max_bytes), contexts_(std::make_unique<Contexts>()) {}

Decompressor::~Decompressor() = default;

Result<Bytes> Decompressor::decompress(std::string_view compression, Bytes packed, std::uint64_t bytes) {
  if (compression.empty()) {
    if (packed.size() != bytes) return wrong_size(bytes);
    return packed;
  }
  if (compression != "lz4" && compression != "zstd") {
    return Status::failure("its compression \"" + std::string(compression) + "\" is none of \"\", \"lz4\", \"zstd\"");
  }
  if (Status status = grow(bytes); !status) return status;
  Status status = compression == "lz4" ? decompress_lz4(packed, bytes) : decompress_zstd(packed, bytes);
  if (!status) return status;
  return Bytes(unpacked_.get(), bytes);
}

Status Decompressor::grow(std::uint64_t bytes) {
  if (bytes > max_bytes_) {
    return Status::failure("its " + std::to_string(bytes) + " unpacked bytes are more than the allowed " +
                           std::to_string(max_bytes_));
  }
  if (bytes <= capacity_ && unpacked_) return {};
  // Not touched before it is filled: a file that lies about a size costs address space only.
  unpacked_.reset(new (std::nothrow) std::byte[bytes]);
  capacity_ = unpacked_ ? bytes : 0;
  return unpacked_ ? Status() : Status::failure("there is no memory for its " + std::to_string(bytes) + " bytes");
}

Status Decompressor::decompress_lz4(Bytes packed, std::uint64_t bytes) {
  if (!contexts_->lz4) {
    LZ4F_dctx* context = nullptr;
    if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION)) != 0U) {
      return Status::failure("there is no memory to unpack lz4");
    }
    contexts_->lz4.reset(context);
  }
  LZ4F_resetDecompressionContext(contexts_->lz4.get());
  std::uint64_t done = 0;
  std::size_t expected = 1;  // 0 when the frame is complete
  while (expected != 0) {
    std::size_t produced = bytes - done;
    std::size_t consumed = packed.size();
    expected =
        LZ4F_decompress(contexts_->lz4.get(), unpacked_.get() + done, &produced, packed.data(), &consumed, nullptr);
    if (LZ4F_isError(expected) != 0U) {
      return Status::failure(std::string("lz4 cannot unpack it: ") + LZ4F_getErrorName(expected));
    }
    done += produced;
    packed = packed.subspan(consumed);
    if (produced == 0 && consumed == 0) break;
  }
  return expected == 0 && done == bytes && packed.empty() ? Status() : wrong_size(bytes);
}

Status Decompressor::decompress_zstd(Bytes packed, std::uint64_t bytes) {
  if (!contexts_->zstd) contexts_->zstd.reset(ZSTD_createDCtx());
  if (!contexts_->zstd) return Status::failure("there is no memory to unpack zstd");
  const std::size_t size =
      ZSTD_decompressDCtx(contexts_->zstd.get(), unpacked_.get(), bytes, packed.data(), packed.size());
  if (ZSTD_isError(size) != 0U) {
    return Status::failure(std::string("zstd cannot unpack it: ") + ZSTD_getErrorName(size));
  }
  return size == bytes ? Status() : wrong_size(bytes);
}

}  // namespace flexcast::mcap
