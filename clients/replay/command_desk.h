// CommandDesk: takes the commands to a world from the network, each once, and writes the replies.
#pragma once

#include <string>
#include <vector>

#include "clients/replay/reply_memory.h"
#include "idl/wire/reader.h"
#include "idl/wire/writer.h"

namespace flexcast::replay {

using Command = wire::Owned<flexcast_Command>;
using Reply = wire::Owned<flexcast_Reply>;

class CommandDesk {
 public:
  static wire::Result<CommandDesk> create(const wire::Participant& participant, std::string world);

  // What has come and is to be executed. Requests that were answered before are answered from memory.
  std::vector<Command> take();

  // World, client and number must be those of the command.
  void answer(Reply reply);

  // For waiting until there is something to take.
  const wire::UntypedReader& reader() const { return reader_; }

 private:
  CommandDesk(std::string world, wire::Writer<flexcast_Reply> writer, wire::Reader<flexcast_Command> reader)
      : world_(std::move(world)), writer_(std::move(writer)), reader_(std::move(reader)) {}

  std::string world_;
  wire::Writer<flexcast_Reply> writer_;  // before the reader: no command may come that could not be answered
  wire::Reader<flexcast_Command> reader_;
  ReplyMemory memory_;
};

}  // namespace flexcast::replay
