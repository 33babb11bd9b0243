#include "idl/wire/frame_head.h"

#include <bit>
#include <cstring>

namespace flexcast::wire {
namespace {

static_assert(std::endian::native == std::endian::little, "the wire's numbers are little-endian");

template <class T>
void peek(T& value, std::span<const std::byte> bytes, std::size_t offset) {
  std::memcpy(&value, bytes.data() + offset, sizeof value);
}

}  // namespace

Result<FrameHead> peek_frame_head(std::span<const std::byte> bytes) {
  namespace at = frame_offset;
  if (bytes.size() < at::world) return Error{"a frame of " + std::to_string(bytes.size()) + " bytes has no head"};
  if (bytes[0] != std::byte{0} || bytes[1] != std::byte{1}) return Error{"a frame is not little-endian XCDR1"};
  FrameHead head;
  peek(head.run_id, bytes, at::run_id);
  peek(head.frame, bytes, at::frame);
  peek(head.step, bytes, at::step);
  peek(head.time, bytes, at::time);
  peek(head.parameter_revision, bytes, at::parameter_revision);
  peek(head.topology_revision, bytes, at::topology_revision);
  peek(head.state_hash, bytes, at::state_hash);
  peek(head.chunk, bytes, at::chunk);
  peek(head.chunks, bytes, at::chunks);
  peek(head.first, bytes, at::first);
  peek(head.total, bytes, at::total);
  peek(head.bounds, bytes, at::bounds);
  std::uint32_t length = 0;
  peek(length, bytes, at::world_length);
  if (length == 0 || length > bytes.size() - at::world) return Error{"a frame ends within the name of its world"};
  head.world = {reinterpret_cast<const char*>(bytes.data()) + at::world, length - 1};
  return head;
}

}  // namespace flexcast::wire
