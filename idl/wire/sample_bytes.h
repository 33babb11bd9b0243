// SampleBytes: the bytes of one serialised sample. Copies share them: off the wire they stay where Cyclone DDS has put
// them until the last copy goes, which must be before the participant does. Copies may go on any thread.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace flexcast::wire {

class SampleBytes {
 public:
  SampleBytes() = default;

  SampleBytes(std::vector<std::byte> bytes) {  // NOLINT: implicit by design
    const auto owned = std::make_shared<const std::vector<std::byte>>(std::move(bytes));
    bytes_ = *owned;
    owner_ = owned;
  }

  // `owner` keeps `bytes` alive.
  SampleBytes(std::shared_ptr<const void> owner, std::span<const std::byte> bytes)
      : owner_(std::move(owner)), bytes_(bytes) {}

  operator std::span<const std::byte>() const { return bytes_; }  // NOLINT: implicit by design
  std::size_t size() const { return bytes_.size(); }

 private:
  std::shared_ptr<const void> owner_;  // shared: with the queue, the file and what parts repeat
  std::span<const std::byte> bytes_;
};

}  // namespace flexcast::wire
