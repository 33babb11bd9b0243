// ByteSink: where a writer puts its bytes. MemorySink keeps them, for tests; FileSink (file_sink.h) writes a file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "clients/mcap/status.h"
#include "clients/mcap/types.h"

namespace flexcast::mcap {

class ByteSink {
 public:
  virtual ~ByteSink() = default;

  // Takes all bytes or fails; the bytes may be reused as soon as it returns.
  virtual Status write(Bytes bytes) = 0;

  // Hands on what is held back, so that it outlives the process.
  virtual Status flush() = 0;

  // Drops everything after the first `bytes` bytes, also what a failed write has left; the next write goes on there.
  virtual Status cut(std::uint64_t bytes) {
    return Status::failure("this cannot be cut back to " + std::to_string(bytes) + " bytes");
  }
};

class MemorySink final : public ByteSink {
 public:
  Status write(Bytes bytes) override {
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    return {};
  }
  Status flush() override { return {}; }
  Status cut(std::uint64_t bytes) override {
    bytes_.resize(bytes);
    return {};
  }

  Bytes bytes() const { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
};

}  // namespace flexcast::mcap
