// Decoder: takes the fields of a record off its body, bounds checked. After a field that is not there everything reads
// as zero or empty and ok() is false.
#pragma once

#include <cstdint>
#include <string_view>

#include "clients/mcap/views.h"

namespace flexcast::mcap {

class Decoder {
 public:
  explicit Decoder(Bytes bytes) : rest_(bytes) {}

  bool ok() const { return ok_; }
  Bytes rest() const { return rest_; }

  std::uint8_t u8() { return integer<std::uint8_t>(); }
  std::uint16_t u16() { return integer<std::uint16_t>(); }
  std::uint32_t u32() { return integer<std::uint32_t>(); }
  std::uint64_t u64() { return integer<std::uint64_t>(); }

  Bytes take(std::uint64_t bytes) {
    if (bytes > rest_.size()) return fail();
    const Bytes taken = rest_.first(bytes);
    rest_ = rest_.subspan(bytes);
    return taken;
  }

  Bytes counted() { return take(u32()); }

  std::string_view text() {
    const Bytes bytes = counted();
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }

  TextMap text_map() {
    const Bytes bytes = counted();
    Decoder inside(bytes);
    while (inside.ok() && !inside.rest().empty()) {
      inside.counted();
      inside.counted();
    }
    return TextMap(inside.ok() ? bytes : fail());
  }

  template <class List>
  List pair_list() {
    const Bytes bytes = counted();
    return List(bytes.size() % List::kPairBytes == 0 ? bytes : fail());
  }

 private:
  template <class T>
  T integer() {
    const Bytes bytes = take(sizeof(T));
    return ok_ ? load<T>(bytes) : T{0};
  }

  Bytes fail() {
    ok_ = false;
    rest_ = {};
    return {};
  }

  Bytes rest_;
  bool ok_ = true;
};

}  // namespace flexcast::mcap
