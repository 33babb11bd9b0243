// RemoteControl: the commands that come for this recorder on flexcast/recorder_commands.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "idl/wire/reader.h"

namespace flexcast::record {

struct RemoteCommand {
  flexcast_RecorderCommandKind kind = flexcast_RECORDER_STATUS;
  std::uint64_t request_id = 0;
};

class RemoteControl {
 public:
  static wire::Result<RemoteControl> create(const wire::Participant& participant);

  // What has come since the last call for recorder `id` of `world`, in the order of each sender; a command without an
  // id is for every recorder of the world.
  std::vector<RemoteCommand> take(const std::string& world, const std::string& id) const;

 private:
  explicit RemoteControl(wire::Reader<flexcast_RecorderCommand> reader) : reader_(std::move(reader)) {}

  wire::Reader<flexcast_RecorderCommand> reader_;
};

}  // namespace flexcast::record
