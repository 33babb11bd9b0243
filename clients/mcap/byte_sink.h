// ByteSink: where a writer puts its bytes. MemorySink keeps them, for tests; FileSink (file_sink.h) writes a file.
#pragma once

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
};

class MemorySink final : public ByteSink {
 public:
  Status write(Bytes bytes) override {
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    return {};
  }
  Status flush() override { return {}; }

  Bytes bytes() const { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
};

}  // namespace flexcast::mcap
