#include "clients/mcap/crc32.h"

#include <gtest/gtest.h>

#include <random>
#include <string_view>
#include <vector>

namespace flexcast::mcap {
namespace {

// The definition, bit by bit.
std::uint32_t calc_by_bits(Bytes bytes, std::uint32_t start) {
  std::uint32_t crc = ~start;
  for (const std::byte byte : bytes) {
    crc ^= std::to_integer<std::uint32_t>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0xEDB88320 : 0);
  }
  return ~crc;
}

std::vector<std::byte> random_bytes(std::size_t size) {
  std::mt19937 random(5);
  std::vector<std::byte> bytes(size);
  for (std::byte& byte : bytes) byte = static_cast<std::byte>(random() & 0xFF);
  return bytes;
}

TEST(Crc32, HasTheKnownValueOfTheDigits) {
  EXPECT_EQ(crc32(std::as_bytes(std::span(std::string_view("123456789")))), 0xCBF43926u);
}

TEST(Crc32, IsWhatItsDefinitionSaysForEveryLengthPlaceAndStart) {
  const std::vector<std::byte> bytes = random_bytes(700);
  for (std::size_t size = 0; size < 600; ++size) {
    for (const std::uint32_t start : {0u, 1u, 0xFFFFFFFFu, 0xDEADBEEFu}) {
      const Bytes part = Bytes(bytes).subspan(size % 17, size);
      ASSERT_EQ(crc32(part, start), size == 0 ? start : calc_by_bits(part, start)) << size << ' ' << start;
    }
  }
}

TEST(Crc32, OfTwoHalvesJoinsToThatOfTheWhole) {
  const std::vector<std::byte> bytes = random_bytes(5000);
  for (const std::size_t half : {0u, 1u, 63u, 64u, 1000u, 4999u, 5000u}) {
    const Bytes first = Bytes(bytes).first(half), second = Bytes(bytes).subspan(half);
    EXPECT_EQ(crc32_join(crc32(first), crc32(second), second.size()), crc32(bytes)) << half;
    EXPECT_EQ(crc32(second, crc32(first)), crc32(bytes)) << half;
  }
}

}  // namespace
}  // namespace flexcast::mcap
