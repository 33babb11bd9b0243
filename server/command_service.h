// CommandService: takes commands from the network and puts them into the queue to the simulation, takes replies out of
// the other queue and writes them. A repeated request is answered from memory, never executed twice.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <thread>

#include "idl/wire/reader.h"
#include "idl/wire/wait_set.h"
#include "idl/wire/writer.h"
#include "server/convert/command_types.h"
#include "server/queue.h"
#include "server/reply_memory.h"

namespace flexcast::server {

class CommandService {
 public:
  // The queues must outlive this object.
  static wire::Result<std::unique_ptr<CommandService>> create(const wire::Participant& participant, std::string world,
                                                              Queue<Command>& commands, Queue<Reply>& replies);
  ~CommandService();
  CommandService(const CommandService&) = delete;
  CommandService& operator=(const CommandService&) = delete;

  void start();
  void stop_receiving();
  // Writes what waits; to be called when the simulation has ended.
  void stop_replying();

 private:
  CommandService(std::string world, Queue<Command>& commands, Queue<Reply>& replies,
                 wire::Reader<flexcast_Command> reader, wire::Writer<flexcast_Reply> writer,
                 wire::GuardCondition stop_signal, wire::WaitSet wait_set);
  void receive();
  void take_commands();
  void accept(const flexcast_Command& message);
  void reply();
  void write_replies();
  void write(const Reply& reply);

  std::string world_;
  Queue<Command>& commands_;
  Queue<Reply>& replies_;
  ReplyMemory memory_;
  bool was_full_ = false;  // the queue of commands, at the last one
  wire::Reader<flexcast_Command> reader_;
  wire::Writer<flexcast_Reply> writer_;
  wire::GuardCondition stop_signal_;
  wire::WaitSet wait_set_;  // goes before what is attached to it
  std::atomic<bool> receiving_ = true;
  std::atomic<bool> replying_ = true;
  std::thread receive_thread_;
  std::thread reply_thread_;
};

}  // namespace flexcast::server
