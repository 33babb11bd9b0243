#include "clients/record/content_ledger.h"

#include <algorithm>

#include "idl/wire/decode.h"
#include "idl/wire/fill.h"
#include "idl/wire/frame_head.h"
#include "idl/wire/message_head.h"

namespace flexcast::record {

void ContentLedger::note(wire::TopicId topic, std::int64_t log_time, mcap::Bytes bytes) {
  last_time_ = std::max(last_time_, log_time);
  if (world_.empty()) world_ = wire::peek_world(topic, bytes).value_or("");
  if (topic == wire::TopicId::frames) note_frame(log_time, bytes);
  if (topic == wire::TopicId::status) note_status(bytes);
  if (topic == wire::TopicId::scene) note_scene(bytes);
}

void ContentLedger::note_frame(std::int64_t log_time, mcap::Bytes bytes) {
  const auto head = wire::peek_frame_head(bytes);
  const Verdict verdict = head ? frames_.judge(head.value()) : Verdict::invalid;
  if (verdict == Verdict::invalid) ++unreadable_;
  if (verdict != Verdict::record) return;
  if (!first_frame_) first_frame_ = log_time;
  // The number of the server's process stands for the writer.
  frames_.add(head.value(), server_id_);
}

void ContentLedger::note_status(mcap::Bytes bytes) {
  const auto status = wire::decode<flexcast_Status>(bytes);
  if (!status) return;
  const auto& unpublished = status.value()->unpublished;
  server_id_ = status.value()->server_id;
  frames_.note_unpublished(status.value()->run_id, {unpublished._buffer, unpublished._length});
}

void ContentLedger::note_scene(mcap::Bytes bytes) {
  const auto scene = wire::decode<flexcast_SceneInfo>(bytes);
  if (scene) server_version_ = wire::text(scene.value()->version);
}

Reception ContentLedger::reception() const {
  Reception reception;
  reception.runs = frames_.runs();
  reception.gaps = frames_.gaps();
  reception.unreadable = unreadable_;
  reception.server_version = server_version_;
  if (first_frame_) reception.seconds = 1e-9 * static_cast<double>(last_time_ - *first_frame_);
  return reception;
}

}  // namespace flexcast::record
