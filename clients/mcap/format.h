// The constants of the MCAP format, version 0: https://mcap.dev/spec
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace flexcast::mcap {

// The first and the last eight bytes of a complete file: 89 M C A P 0 \r \n.
inline constexpr std::array<std::byte, 8> kMagic = {std::byte{0x89}, std::byte{'M'}, std::byte{'C'},  std::byte{'A'},
                                                    std::byte{'P'},  std::byte{'0'}, std::byte{'\r'}, std::byte{'\n'}};

// A record is an opcode (u8), the length of its body (u64, little endian) and the body.
inline constexpr std::size_t kRecordPrefixBytes = 9;

enum class Opcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kAttachment = 0x09,
  kAttachmentIndex = 0x0A,
  kStatistics = 0x0B,
  kMetadata = 0x0C,
  kMetadataIndex = 0x0D,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

}  // namespace flexcast::mcap
