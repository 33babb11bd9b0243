// Cdr: reads the bytes of a message field by field (XCDR1, little-endian), as the OMG's text has it and without the
// help of any DDS library.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace flexcast::test {

class Cdr {
 public:
  // `message` with its 4-byte header. Throws on anything but little-endian XCDR1, and later when bytes are missing.
  explicit Cdr(std::span<const std::byte> message) {
    if (message.size() < 4 || message[0] != std::byte{0} || message[1] != std::byte{1}) {
      throw std::runtime_error("a message is not little-endian XCDR1");
    }
    bytes_ = message.subspan(4);
    padding_ = std::to_integer<std::size_t>(message[3] & std::byte{3});
  }

  template <class T>
  T number() {
    static_assert(std::is_arithmetic_v<T>);
    align(sizeof(T));
    T value;
    std::memcpy(&value, take(sizeof(T)).data(), sizeof(T));
    return value;
  }
  std::uint32_t u32() { return number<std::uint32_t>(); }
  std::uint64_t u64() { return number<std::uint64_t>(); }
  double f64() { return number<double>(); }
  bool boolean() { return number<std::uint8_t>() != 0; }

  template <class Enum>
  Enum enumerator() {
    return static_cast<Enum>(u32());
  }

  std::string string() {
    const std::uint32_t length = u32();
    const auto text = take(length);
    if (length == 0 || text.back() != std::byte{0}) throw std::runtime_error("a string without its final zero");
    return {reinterpret_cast<const char*>(text.data()), length - 1};
  }

  template <std::size_t N>
  std::array<double, N> doubles() {
    std::array<double, N> values;
    for (double& value : values) value = f64();
    return values;
  }

  // A sequence; of numbers, or of what `read_one()` reads.
  template <class T>
  std::vector<T> numbers() {
    const std::uint32_t count = u32();
    if (count > 0) align(sizeof(T));
    const auto content = take(count * sizeof(T));
    std::vector<T> values(count);
    if (count > 0) std::memcpy(values.data(), content.data(), content.size());
    return values;
  }
  template <class Read>
  auto sequence(Read read_one) {
    std::vector<decltype(read_one())> values(u32());
    for (auto& value : values) value = read_one();
    return values;
  }
  std::vector<std::string> strings() {
    return sequence([this] { return string(); });
  }

  // Throws if the message goes on behind the last field.
  void expect_end() const {
    if (at_ + padding_ != bytes_.size()) throw std::runtime_error("a message has more bytes than fields");
  }

 private:
  void align(std::size_t size) { at_ = (at_ + size - 1) / size * size; }

  std::span<const std::byte> take(std::size_t count) {
    if (at_ > bytes_.size() || count > bytes_.size() - at_) throw std::runtime_error("a message is too short");
    const auto taken = bytes_.subspan(at_, count);
    at_ += count;
    return taken;
  }

  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
  std::size_t padding_ = 0;
};

}  // namespace flexcast::test
