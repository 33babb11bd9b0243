#include "idl/wire/message_head.h"

#include <array>
#include <cstdint>

#include "idl/wire/frame_head.h"

namespace flexcast::wire {
namespace {

constexpr std::size_t first_member = 4;          // after the CDR header
constexpr std::size_t after_topology_head = 32;  // two 64-bit numbers, then three of 32 bits

// The byte at which the length (u32, the final zero counted) of the world's name stands.
struct Row {
  TopicId topic;
  std::size_t world_length;
};

constexpr std::array rows{
    Row{TopicId::scene, first_member},      Row{TopicId::topology, after_topology_head},
    Row{TopicId::parameters, first_member}, Row{TopicId::frames, frame_offset::world_length},
    Row{TopicId::status, first_member},     Row{TopicId::commands, first_member},
    Row{TopicId::replies, first_member},    Row{TopicId::events, first_member},
    Row{TopicId::recorders, first_member},  Row{TopicId::recorder_commands, first_member},
};

constexpr bool is_in_order_of_topics() {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].topic != static_cast<TopicId>(i)) return false;
  }
  return true;
}
static_assert(is_in_order_of_topics());

std::uint32_t load_u32(std::span<const std::byte, 4> bytes, bool little_endian) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t shift = 8 * (little_endian ? i : 3 - i);
    value |= std::to_integer<std::uint32_t>(bytes[i]) << shift;
  }
  return value;
}

}  // namespace

std::optional<std::string_view> peek_world(TopicId topic, std::span<const std::byte> bytes) {
  const std::size_t at = rows[static_cast<std::size_t>(topic)].world_length;
  const std::size_t text = at + 4;
  if (bytes.size() < text) return std::nullopt;
  // 00 00: XCDR1, big-endian; 00 01: little-endian.
  if (bytes[0] != std::byte{0} || bytes[1] > std::byte{1}) return std::nullopt;
  const std::uint32_t length = load_u32(bytes.subspan(at).first<4>(), bytes[1] == std::byte{1});
  if (length == 0 || length > bytes.size() - text) return std::nullopt;
  return std::string_view(reinterpret_cast<const char*>(bytes.data()) + text, length - 1);
}

}  // namespace flexcast::wire
