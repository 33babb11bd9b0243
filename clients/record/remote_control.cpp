#include "clients/record/remote_control.h"

#include "idl/wire/fill.h"

namespace flexcast::record {

wire::Result<RemoteControl> RemoteControl::create(const wire::Participant& participant) {
  auto reader =
      wire::Reader<flexcast_RecorderCommand>::create(participant, wire::topic_of<flexcast_RecorderCommand>().recorder);
  if (!reader) return reader.error();
  return RemoteControl(std::move(reader).value());
}

std::vector<RemoteCommand> RemoteControl::take(const std::string& world, const std::string& id) const {
  std::vector<RemoteCommand> commands;
  const auto samples = reader_.take();
  if (!samples) return commands;
  for (const auto [command, info] : samples.value()) {
    if (!info.valid || wire::text(command.world) != world) continue;
    const std::string_view wanted = wire::text(command.recorder_id);
    if (wanted.empty() || wanted == id) commands.push_back({command.kind, command.request_id});
  }
  return commands;
}

}  // namespace flexcast::record
