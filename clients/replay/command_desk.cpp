#include "clients/replay/command_desk.h"

#include <utility>

#include "idl/wire/fill.h"

namespace flexcast::replay {

wire::Result<CommandDesk> CommandDesk::create(const wire::Participant& participant, std::string world) {
  auto writer = wire::Writer<flexcast_Reply>::create(participant);
  if (!writer) return writer.error();
  auto reader = wire::Reader<flexcast_Command>::create(participant, wire::topic_of<flexcast_Command>().monitor);
  if (!reader) return reader.error();
  return CommandDesk(std::move(world), std::move(writer).value(), std::move(reader).value());
}

std::vector<Command> CommandDesk::take() {
  std::vector<Command> commands;
  auto samples = reader_.take_owned();
  if (!samples) return commands;
  for (auto& [command, info] : samples.value()) {
    if (!info.valid || wire::text(command->world) != world_) continue;
    const auto lookup = memory_.begin(std::string(wire::text(command->client_id)), command->request_id);
    if (lookup.seen == ReplyMemory::Seen::answered) (void)writer_.write(*lookup.reply);
    if (lookup.seen == ReplyMemory::Seen::first) commands.push_back(std::move(command));
  }
  return commands;
}

void CommandDesk::answer(Reply reply) {
  (void)writer_.write(memory_.store(std::move(reply)));
}

}  // namespace flexcast::replay
