// ContentLedger: what a recording holds, found out from its messages in the order of the file.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "clients/mcap/types.h"
#include "clients/record/gap_ledger.h"
#include "clients/record/reception.h"
#include "idl/wire/topics.h"

namespace flexcast::record {

class ContentLedger {
 public:
  // `log_time`: ns since 1970.
  void note(wire::TopicId topic, std::int64_t log_time, mcap::Bytes bytes);

  // What the recorder has said of frames.
  void note(const AccountNote& account);

  // The file could not take this chunk.
  void lose(const wire::FrameHead& head) { frames_.lose(head); }

  const GapLedger& frames() const { return frames_; }
  const std::string& world() const { return world_; }  // "" before the first message

  // Without why the recorder ended; what it dropped as far as its notes say.
  Reception reception() const;

 private:
  void note_frame(std::int64_t log_time, mcap::Bytes bytes);
  void note_status(mcap::Bytes bytes);
  void note_scene(mcap::Bytes bytes);

  GapLedger frames_;
  std::string world_;
  std::string server_version_;
  std::uint64_t server_id_ = 0;  // of the newest status
  std::uint64_t unreadable_ = 0;
  std::map<wire::TopicId, std::uint64_t> dropped_;  // messages
  std::optional<std::int64_t> first_frame_;
  std::int64_t last_time_ = 0;
};

}  // namespace flexcast::record
