// Commands through the network into a queue that is full: whoever asks again is answered in the end, once.
#include "server/command_service.h"

#include <gtest/gtest.h>

#include <map>
#include <utility>

#include "idl/wire/fill.h"
#include "tests/support/network.h"

namespace flexcast::server {
namespace {

using namespace std::chrono_literals;
using Request = std::pair<std::string, std::uint64_t>;

class CommandLoad : public testing::Test {
 protected:
  static constexpr std::uint64_t requests = 64;  // of each client: as many as its writer keeps

  CommandLoad() {
    service_->start();
    wait_for([this] { return writer_.matched().current > 0 && reader_.matched().current > 0; });
  }

  // The time limit only ends a test that hangs.
  template <class Condition>
  bool wait_for(Condition condition) {
    const auto limit = Clock::now() + 60s;
    while (!condition()) {
      if (Clock::now() > limit) return false;
      std::this_thread::sleep_for(2ms);
    }
    return true;
  }

  // Sends what is not answered yet.
  void send_all(int clients) {
    wire::Owned<flexcast_Command> command;
    wire::set_string(command->world, "rope");
    command->kind = flexcast_COMMAND_STATUS;
    for (int i = 0; i < clients; ++i) {
      const std::string client = "client-" + std::to_string(i);
      wire::set_string(command->client_id, client);
      for (command->request_id = 1; command->request_id <= requests; ++command->request_id) {
        if (!answers_.contains({client, command->request_id})) (void)writer_.write(*command);
      }
    }
  }
  void take_answers() {
    auto samples = reader_.take(512);
    for (const auto [reply, info] : samples.value()) {
      if (info.valid) ++answers_[{std::string(wire::text(reply.client_id)), reply.request_id}];
    }
  }
  // Answers what is in the queue, as the simulation thread does.
  void execute() {
    for (const Command& command : commands_.take_all()) {
      ++executed_[{command.key.client_id, command.key.request_id}];
      Reply reply;
      reply.key = command.key;
      replies_.push(reply);
    }
  }

  wire::Participant participant_ = flexcast::test::join_test_domain();
  Queue<Command> commands_{4096};
  Queue<Reply> replies_;
  std::unique_ptr<CommandService> service_ = CommandService::create(participant_, "rope", commands_, replies_).value();
  wire::Reader<flexcast_Reply> reader_ =
      wire::Reader<flexcast_Reply>::create(participant_, wire::topic_of<flexcast_Reply>().recorder).value();
  wire::Writer<flexcast_Command> writer_ = wire::Writer<flexcast_Command>::create(participant_).value();
  std::map<Request, int> executed_;
  std::map<Request, int> answers_;
};

TEST_F(CommandLoad, WhatAFullQueueRefusedIsExecutedWhenItIsAskedAgain) {
  constexpr int clients = 80;  // 5120 commands
  for (int tries = 0; tries < 100 && commands_.size() < 4096; ++tries) {
    send_all(clients);
    std::this_thread::sleep_for(20ms);
  }
  ASSERT_EQ(commands_.size(), 4096u);
  EXPECT_TRUE(answers_.empty());
  for (int tries = 0; tries < 1000 && answers_.size() < clients * requests; ++tries) {
    execute();
    send_all(clients);
    wait_for([this] {
      const std::size_t before = answers_.size();
      take_answers();
      return answers_.size() == before;
    });
  }
  EXPECT_EQ(answers_.size(), clients * requests);
  for (const auto& [request, times] : executed_) ASSERT_EQ(times, 1) << request.first << ", " << request.second;
  EXPECT_EQ(executed_.size(), clients * requests);
}

}  // namespace
}  // namespace flexcast::server
