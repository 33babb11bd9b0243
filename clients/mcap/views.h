// Views of the lists inside records: read in place, nothing is copied or allocated. Their bytes were checked when the
// record was parsed; they are valid as long as the record is.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

#include "clients/mcap/types.h"

namespace flexcast::mcap {

// A little-endian integer at the start of `bytes`, which must hold it.
template <class T>
T load(Bytes bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i) value |= std::to_integer<std::uint64_t>(bytes[i]) << (8 * i);
  return static_cast<T>(value);
}

// Text to text; a file may hold a key twice.
class TextMap {
 public:
  TextMap() = default;
  explicit TextMap(Bytes checked_bytes) : bytes_(checked_bytes) {}

  template <class Visit>
  void for_each(Visit visit) const {
    for (Bytes rest = bytes_; !rest.empty();) {
      const std::string_view key = take(rest);
      const std::string_view value = take(rest);
      visit(key, value);
    }
  }

  // The first value under `key`.
  std::optional<std::string_view> find(std::string_view key) const {
    std::optional<std::string_view> found;
    for_each([&](std::string_view other, std::string_view value) {
      if (!found && other == key) found = value;
    });
    return found;
  }

  TextPairs copy() const {
    TextPairs pairs;
    for_each([&](std::string_view key, std::string_view value) { pairs.emplace(key, value); });
    return pairs;
  }

  Bytes bytes() const { return bytes_; }

 private:
  static std::string_view take(Bytes& rest) {
    const auto length = load<std::uint32_t>(rest);
    const Bytes text = rest.subspan(4, length);
    rest = rest.subspan(4 + std::size_t{length});
    return {reinterpret_cast<const char*>(text.data()), text.size()};
  }

  Bytes bytes_;
};

// A list of pairs of integers.
template <class First, class Second>
class PairList {
 public:
  static constexpr std::size_t kPairBytes = sizeof(First) + sizeof(Second);

  PairList() = default;
  explicit PairList(Bytes checked_bytes) : bytes_(checked_bytes) {}

  std::size_t size() const { return bytes_.size() / kPairBytes; }
  std::pair<First, Second> operator[](std::size_t i) const {
    const Bytes pair = bytes_.subspan(i * kPairBytes, kPairBytes);
    return {load<First>(pair), load<Second>(pair.subspan(sizeof(First)))};
  }

 private:
  Bytes bytes_;
};

using MessageEntries = PairList<Time, std::uint64_t>;      // log time, offset in the unpacked chunk
using ChannelValues = PairList<ChannelId, std::uint64_t>;  // of each channel an offset or a count

}  // namespace flexcast::mcap
