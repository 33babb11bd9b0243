#include "clients/export/frame_reader.h"

#include "idl/wire/decode.h"

namespace flexcast::exporting {

using recording::FrameEntry;
using recording::RecordedMessage;
using recording::Recording;

namespace {

// What a frame of so many bytes can hold, whatever it says: the memory for it is claimed before it is filled.
bool is_plausible(const flexcast_ParticleFrame& sample, const recording::Index& index, const FrameEntry& entry) {
  return sample.total <= index.frame_bytes() && sample.chunks <= entry.last - entry.first + 1;
}

}  // namespace

std::optional<client::Frame> read_frame(Recording& recording, const recording::Index& index, const FrameEntry& entry) {
  client::FrameAssembler assembler;
  recording.seek(entry.first);
  while (recording.ordinal() <= entry.last) {
    const RecordedMessage* message = recording.next();
    if (message == nullptr) break;
    if (message->topic != wire::TopicId::frames) continue;
    const auto sample = wire::decode<flexcast_ParticleFrame>(message->bytes);
    if (!sample || sample.value()->frame != entry.number || !is_plausible(*sample.value(), index, entry)) continue;
    if (auto frame = assembler.add(*sample.value())) return frame;
  }
  return std::nullopt;
}

wire::Result<wire::FrameHead> read_head(Recording& recording, const FrameEntry& entry) {
  recording.seek(entry.first);
  const RecordedMessage* message = recording.next();
  if (message == nullptr) return wire::Error{recording.path() + ": a frame is not there any more"};
  auto head = wire::peek_frame_head(message->bytes);
  if (head) head.value().world = {};  // lives as long as the message
  return head;
}

wire::Result<wire::Owned<flexcast_SceneInfo>> read_scene(Recording& recording, const recording::Index& index,
                                                         const FrameEntry& entry) {
  const auto head = read_head(recording, entry);
  if (!head) return head.error();
  for (const std::uint64_t ordinal : index.find_in_force(head.value(), entry.first)) {
    recording.seek(ordinal);
    const RecordedMessage* message = recording.next();
    if (message == nullptr || message->topic != wire::TopicId::scene) continue;
    return wire::decode<flexcast_SceneInfo>(message->bytes);
  }
  return wire::Error{recording.path() + ": the scene of these frames was not recorded"};
}

}  // namespace flexcast::exporting
