// Encoder: appends the fields of MCAP records, little endian, to a byte buffer.
#pragma once

#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "clients/mcap/format.h"
#include "clients/mcap/types.h"

namespace flexcast::mcap {

class Encoder {
 public:
  explicit Encoder(std::vector<std::byte>& buffer) : buffer_(buffer) {}

  void u8(std::uint8_t value) { integer(value); }
  void u16(std::uint16_t value) { integer(value); }
  void u32(std::uint32_t value) { integer(value); }
  void u64(std::uint64_t value) { integer(value); }
  void raw(Bytes bytes) { buffer_.insert(buffer_.end(), bytes.begin(), bytes.end()); }

  // Bytes preceded by their length as u32.
  void counted(Bytes bytes) {
    length(bytes.size());
    raw(bytes);
  }
  void text(std::string_view value) { counted(std::as_bytes(std::span(value))); }

  // A map of text to text, preceded by its length in bytes as u32.
  void pairs(const TextPairs& values) {
    std::uint64_t total = 0;
    for (const auto& [key, value] : values) total += 8 + key.size() + value.size();
    length(total);
    for (const auto& [key, value] : values) {
      text(key);
      text(value);
    }
  }

  // Opcode and length of a record whose body has `body_bytes` bytes; the caller appends or writes those.
  void record_prefix(Opcode opcode, std::uint64_t body_bytes) {
    u8(static_cast<std::uint8_t>(opcode));
    u64(body_bytes);
  }

  // A record of yet unknown length: begin_record gives the place that end_record needs.
  std::size_t begin_record(Opcode opcode) {
    record_prefix(opcode, 0);
    return buffer_.size();
  }
  void end_record(std::size_t body_start) {
    store(body_start - 8, static_cast<std::uint64_t>(buffer_.size() - body_start));
  }

  // False once a field was longer than its u32 length can say; what was encoded must not be written then.
  bool fits() const { return fits_; }

 private:
  template <class T>
  void integer(T value) {
    const std::size_t start = buffer_.size();
    buffer_.resize(start + sizeof(T));
    store(start, value);
  }

  template <class T>
  void store(std::size_t position, T value) {
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      buffer_[position + i] = static_cast<std::byte>(static_cast<std::uint64_t>(value) >> (8 * i) & 0xFF);
    }
  }

  void length(std::uint64_t bytes) {
    fits_ = fits_ && bytes <= std::numeric_limits<std::uint32_t>::max();
    u32(static_cast<std::uint32_t>(bytes));
  }

  std::vector<std::byte>& buffer_;
  bool fits_ = true;
};

}  // namespace flexcast::mcap
