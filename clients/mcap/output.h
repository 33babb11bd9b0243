// Output: a ByteSink with a byte count, a running checksum and a memory: after the first failure it only repeats it.
#pragma once

#include <cstdint>

#include "clients/mcap/byte_sink.h"

namespace flexcast::mcap {

class Output {
 public:
  explicit Output(ByteSink& sink) : sink_(sink) {}

  Status write(Bytes bytes);

  // The same for bytes whose checksum is known already.
  Status write(Bytes bytes, std::uint32_t crc);

  Status flush();

  // Cuts the sink back to `offset`, where the checksum was `crc`, and forgets the failure.
  Status cut(std::uint64_t offset, std::uint32_t crc);

  // The first failure, or success.
  const Status& status() const { return status_; }

  std::uint64_t offset() const { return offset_; }

  // Of everything since the start or the last restart_crc().
  std::uint32_t crc() const { return crc_; }
  void restart_crc() { crc_ = 0; }

 private:
  ByteSink& sink_;
  Status status_;
  std::uint64_t offset_ = 0;
  std::uint32_t crc_ = 0;
};

}  // namespace flexcast::mcap
