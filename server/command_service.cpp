#include "server/command_service.h"

#include <spdlog/spdlog.h>

#include "idl/wire/fill.h"
#include "server/convert/commands.h"

namespace flexcast::server {

wire::Result<std::unique_ptr<CommandService>> CommandService::create(const wire::Participant& participant,
                                                                     std::string world, Queue<Command>& commands,
                                                                     Queue<Reply>& replies) {
  auto writer = wire::Writer<flexcast_Reply>::create(participant);
  if (!writer) return writer.error();
  auto reader = wire::Reader<flexcast_Command>::create(participant);
  if (!reader) return reader.error();
  auto stop_signal = wire::GuardCondition::create(participant);
  if (!stop_signal) return stop_signal.error();
  auto wait_set = wire::WaitSet::create(participant);
  if (!wait_set) return wait_set.error();
  if (auto attached = wait_set.value().attach_data(reader.value()); !attached) return attached.error();
  if (auto attached = wait_set.value().attach(stop_signal.value()); !attached) return attached.error();
  return std::unique_ptr<CommandService>(
      new CommandService(std::move(world), commands, replies, std::move(reader).value(), std::move(writer).value(),
                         std::move(stop_signal).value(), std::move(wait_set).value()));
}

CommandService::CommandService(std::string world, Queue<Command>& commands, Queue<Reply>& replies,
                               wire::Reader<flexcast_Command> reader, wire::Writer<flexcast_Reply> writer,
                               wire::GuardCondition stop_signal, wire::WaitSet wait_set)
    : world_(std::move(world)),
      commands_(commands),
      replies_(replies),
      reader_(std::move(reader)),
      writer_(std::move(writer)),
      stop_signal_(std::move(stop_signal)),
      wait_set_(std::move(wait_set)) {}

CommandService::~CommandService() {
  stop_receiving();
  stop_replying();
}

void CommandService::start() {
  receive_thread_ = std::thread(&CommandService::receive, this);
  reply_thread_ = std::thread(&CommandService::reply, this);
}

void CommandService::stop_receiving() {
  receiving_ = false;
  stop_signal_.trigger();
  if (receive_thread_.joinable()) receive_thread_.join();
}

void CommandService::stop_replying() {
  replying_ = false;
  replies_.wake();
  if (reply_thread_.joinable()) reply_thread_.join();
}

// ---------------------------------------------------------------- commands in

void CommandService::receive() {
  while (receiving_) {
    if (wait_set_.wait(std::chrono::seconds(1))) take_commands();
  }
}

void CommandService::take_commands() {
  auto samples = reader_.take();
  if (!samples) {
    spdlog::error("{}", samples.error().message);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));  // not in a tight loop
    return;
  }
  for (const auto [message, info] : samples.value()) {
    if (info.valid && wire::text(message.world) == world_) accept(message);
  }
}

void CommandService::accept(const flexcast_Command& message) {
  Command command = from_wire(message, Clock::now());
  const RequestKey key = command.key;
  const auto lookup = memory_.begin(key);
  if (lookup.seen == ReplyMemory::Seen::answered) return write(*lookup.reply);
  if (lookup.seen == ReplyMemory::Seen::in_flight) return;
  const bool full = !commands_.push(std::move(command));
  if (full) memory_.forget(key);  // the client sends it again
  if (full && !was_full_) {
    spdlog::warn("the command queue is full: request {} of {} and more were dropped", key.request_id, key.client_id);
  }
  was_full_ = full;
}

// ---------------------------------------------------------------- replies out

void CommandService::reply() {
  while (replying_) {
    replies_.wait_for(std::chrono::seconds(1));
    write_replies();
  }
  write_replies();
}

void CommandService::write_replies() {
  for (const Reply& reply : replies_.take_all()) {
    memory_.store(reply);
    write(reply);
  }
}

void CommandService::write(const Reply& reply) {
  if (auto result = writer_.write(*to_wire(reply, world_)); !result) spdlog::error("{}", result.error().message);
}

}  // namespace flexcast::server
