// The whole server in this process, seen through DDS.
#include "server/server.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "idl/wire/fill.h"
#include "idl/wire/reader.h"
#include "idl/wire/writer.h"
#include "tests/server/worlds.h"
#include "tests/support/network.h"

namespace flexcast::server {
namespace {

using namespace std::chrono_literals;

// The scenes of the servers below: "rope", "pair" with two bodies, "soft" with every field in 16 bits, and "long" with
// frames above 4 MiB.
std::filesystem::path write_scene() {
  static const test::Folder folder;
  const auto path = folder.path() / "rope.toml";
  std::ofstream(path) << test::rope_scene();
  std::ofstream(folder.path() / "pair.toml") << test::rope_scene(R"([[body]]
name = "other"
model = "mass_spring"
mesh = { shape = "rope", cells = [20], size = [1.0] }
springs = { stiffness = 1.0 }
mass = 0.01
)");
  std::ofstream(folder.path() / "soft.toml") << R"(name = "soft"
[[body]]
name = "cube"
model = "fem"
mesh = { shape = "beam", cells = [1, 1, 1], size = [1.0, 1.0, 1.0] }
material = { law = "linear", young = 1e5, poisson = 0.0, density = 1000.0 }
displacement = [ { select = { nodes = [1, 3, 5, 7] }, value = [0.25, 0.0, 0.0] } ]
[stream]
fields = ["positions", "velocities", "stretch", "stress"]
precision = "quantized16"
)";
  std::string longest =
      test::rope_scene("[stream]\nfields = [\"positions\", \"velocities\"]\nprecision = \"float64\"\n");
  longest.replace(longest.find("cells = [10]"), 12, "cells = [90000]");
  std::ofstream(folder.path() / "long.toml") << longest;
  return path;
}

Options paused_rope() {
  Options options;
  options.scene = write_scene();
  options.domain = flexcast::test::test_domain();
  options.profile = "loopback";
  options.paused = true;
  return options;
}

std::unique_ptr<Server> start_paused_server() {
  auto server = Server::start(paused_rope());
  if (!server) throw std::runtime_error(server.error().message);
  return std::move(server).value();
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

// The first sample of this run.
template <class T>
wire::Owned<T> wait_for_run(const wire::Reader<T>& reader, std::uint64_t run_id) {
  wire::Owned<T> found;
  const bool came = wait_for([&] {
    auto taken = reader.take_owned();
    for (auto& sample : taken.value()) {
      if (!sample.info.valid || sample.data->run_id != run_id) continue;
      found = std::move(sample.data);
      return true;
    }
    return false;
  });
  if (!came) throw std::runtime_error("no sample of the run came");
  return found;
}

class Client {
 public:
  Client()
      : participant_(flexcast::test::join_test_domain()),
        commands_(wire::Writer<flexcast_Command>::create(participant_).value()),
        replies_(wire::Reader<flexcast_Reply>::create(participant_).value()),
        events_(wire::Reader<flexcast_Event>::create(participant_).value()) {
    if (!wait_for([&] { return commands_.matched().current > 0 && replies_.matched().current > 0; })) {
      throw std::runtime_error("no server was found");
    }
  }

  wire::Participant& participant() { return participant_; }

  static wire::Owned<flexcast_Command> make(flexcast_CommandKind kind) {
    static std::uint64_t request_id = 0;
    wire::Owned<flexcast_Command> command;
    wire::set_string(command->world, "rope");
    wire::set_string(command->client_id, "tester");
    command->request_id = ++request_id;
    command->kind = kind;
    return command;
  }

  wire::Owned<flexcast_Reply> ask(const wire::Owned<flexcast_Command>& command) {
    wire::Owned<flexcast_Reply> answer;
    if (!commands_.write(*command)) throw std::runtime_error("the command could not be written");
    const bool came = wait_for([&] {
      auto taken = replies_.take_owned();
      for (auto& reply : taken.value()) {
        if (!reply.info.valid || reply.data->request_id != command->request_id) continue;
        answer = std::move(reply.data);
        return true;
      }
      return false;
    });
    if (!came) throw std::runtime_error("no reply came");
    return answer;
  }

  // How many events a kind of command has made, up to and including the first of `marker`, which is waited for: events
  // come in order, but not in step with replies.
  std::size_t count_events_until(flexcast_CommandKind marker, flexcast_CommandKind kind) {
    std::size_t count = 0;
    bool marked = false;
    wait_for([&] {
      auto samples = events_.take();
      for (auto [event, info] : samples.value()) {
        if (!info.valid || event.kind != flexcast_EVENT_COMMAND || marked) continue;
        count += event.command_kind == kind ? 1 : 0;
        marked = event.command_kind == marker;
      }
      return marked;
    });
    return count;
  }

 private:
  wire::Participant participant_;
  wire::Writer<flexcast_Command> commands_;
  wire::Reader<flexcast_Reply> replies_;
  wire::Reader<flexcast_Event> events_;
};

TEST(Server, ARecordingReaderGetsEveryFrameOfTheStepsItAskedFor) {
  const auto server = start_paused_server();
  Client client;
  auto frames =
      wire::Reader<flexcast_ParticleFrame>::create(client.participant(), wire::frames_recorder_qos(1000, 1)).value();
  ASSERT_TRUE(wait_for([&] { return frames.matched().current > 0 && frames.wait(0ns); }));  // frame 0, again
  auto command = Client::make(flexcast_COMMAND_STEP);
  command->count = 50;
  const auto reply = client.ask(command);
  EXPECT_EQ(reply->outcome, flexcast_OUTCOME_APPLIED);
  EXPECT_EQ(reply->applied_step, 50u);
  EXPECT_EQ(reply->state, flexcast_WORLD_PAUSED);
  std::vector<std::uint64_t> numbers;
  ASSERT_TRUE(wait_for([&] {
    auto samples = frames.take();
    for (auto [frame, info] : samples.value()) {
      if (!info.valid) continue;
      EXPECT_EQ(frame.step, frame.frame);
      EXPECT_EQ(frame.positions._length, 33u);
      numbers.push_back(frame.frame);
    }
    return !numbers.empty() && numbers.back() == 50;
  }));
  ASSERT_EQ(numbers.size(), 51u);
  for (std::size_t i = 0; i < numbers.size(); ++i) EXPECT_EQ(numbers[i], i);
}

TEST(Server, ALateReaderOfAStandingWorldSeesTheNewestFrame) {
  const auto server = start_paused_server();
  Client client;
  auto command = Client::make(flexcast_COMMAND_STEP);
  command->count = 7;
  client.ask(command);
  auto frames = wire::Reader<flexcast_ParticleFrame>::create(client.participant()).value();
  std::uint64_t seen = 0;
  EXPECT_TRUE(wait_for([&] {
    auto samples = frames.take();
    for (auto [frame, info] : samples.value()) seen = info.valid ? frame.frame : seen;
    return seen == 7;
  }));
}

// The newest status for which `wanted` is true.
template <class Condition>
void wait_for_status(const wire::Reader<flexcast_Status>& statuses, Condition wanted) {
  const bool came = wait_for([&] {
    auto samples = statuses.take();
    for (auto [status, info] : samples.value()) {
      if (info.valid && wanted(status)) return true;
    }
    return false;
  });
  if (!came) throw std::runtime_error("no status as the test waits for");
}

std::vector<std::uint64_t> unpublished(const flexcast_Status& status) {
  const auto numbers = wire::elements(status.unpublished);
  return {numbers.begin(), numbers.end()};
}

TEST(Server, NamesTheFramesThatNobodyReadAndTakesBackTheOneItSendsAgain) {
  const auto server = start_paused_server();
  Client client;
  auto statuses = wire::Reader<flexcast_Status>::create(client.participant()).value();
  auto command = Client::make(flexcast_COMMAND_STEP);
  command->count = 7;
  client.ask(command);
  using Numbers = std::vector<std::uint64_t>;
  wait_for_status(statuses, [](const flexcast_Status& status) {
    return unpublished(status) == Numbers{0, 7} && status.frames_published == 0;
  });
  auto frames = wire::Reader<flexcast_ParticleFrame>::create(client.participant()).value();
  wait_for_status(statuses, [](const flexcast_Status& status) {
    return unpublished(status) == Numbers{0, 6} && status.frames_published == 1;
  });
  client.ask(Client::make(flexcast_COMMAND_RESET));
  wait_for_status(statuses, [](const flexcast_Status& status) {
    return unpublished(status).empty() && status.frames_published == 1 && status.report.step == 0;
  });
}

TEST(Server, ARepeatedRequestIsAnsweredAgainAndExecutedOnce) {
  const auto server = start_paused_server();
  Client client;
  auto command = Client::make(flexcast_COMMAND_STEP);
  command->count = 3;
  const auto first = client.ask(command);
  const auto again = client.ask(command);
  EXPECT_EQ(first->applied_step, 3u);
  EXPECT_EQ(again->applied_step, 3u);
  EXPECT_EQ(client.ask(Client::make(flexcast_COMMAND_STATUS))->report.step, 3u);
  client.ask(Client::make(flexcast_COMMAND_RESET));
  EXPECT_EQ(client.count_events_until(flexcast_COMMAND_RESET, flexcast_COMMAND_STEP), 1u);
}

TEST(Server, LateReadersFindSceneTopologyParametersAndAllEvents) {
  const auto server = start_paused_server();
  Client client;
  const auto run_id = client.ask(Client::make(flexcast_COMMAND_RESET))->run_id;
  auto scenes = wire::Reader<flexcast_SceneInfo>::create(client.participant()).value();
  auto topologies = wire::Reader<flexcast_Topology>::create(client.participant()).value();
  auto parameters = wire::Reader<flexcast_ParameterSet>::create(client.participant()).value();
  const auto scene = wait_for_run(scenes, run_id);
  EXPECT_EQ(wire::text(scene->scene_text), test::rope_scene());
  EXPECT_EQ(wait_for_run(topologies, run_id)->rest_positions._length, 33u);
  EXPECT_GT(wait_for_run(parameters, run_id)->descriptors._length, 5u);
  EXPECT_EQ(client.count_events_until(flexcast_COMMAND_RESET, flexcast_COMMAND_RESET), 1u);
}

TEST(Server, ALoadedSceneIsPublishedAnewAndLateReadersSeeNothingOfTheOldOne) {
  const auto server = start_paused_server();
  Client client;
  const auto load = [&](const char* name) {
    auto command = Client::make(flexcast_COMMAND_LOAD);
    wire::set_string(command->name, name);
    return client.ask(command);
  };
  EXPECT_EQ(load("nothing")->outcome, flexcast_OUTCOME_REJECTED);
  EXPECT_EQ(load("../pair")->outcome, flexcast_OUTCOME_REJECTED);
  const auto pair = load("pair");
  ASSERT_EQ(pair->outcome, flexcast_OUTCOME_APPLIED) << wire::text(pair->reason);
  auto scenes = wire::Reader<flexcast_SceneInfo>::create(client.participant()).value();
  auto frames = wire::Reader<flexcast_ParticleFrame>::create(client.participant()).value();
  const auto scene = wait_for_run(scenes, pair->run_id);
  EXPECT_EQ(scene->particles, 11u + 21u);
  EXPECT_EQ(scene->bodies._length, 2u);
  EXPECT_EQ(scene->topology_revision, 2u);
  const auto frame = wait_for_run(frames, pair->run_id);
  EXPECT_EQ(frame->topology_revision, 2u);
  EXPECT_EQ(frame->total, 32u);

  const auto rope = load("rope");
  ASSERT_EQ(rope->outcome, flexcast_OUTCOME_APPLIED);
  EXPECT_EQ(wait_for_run(scenes, rope->run_id)->particles, 11u);
  EXPECT_EQ(wait_for_run(frames, rope->run_id)->topology_revision, 3u);
  auto topologies = wire::Reader<flexcast_Topology>::create(client.participant()).value();
  EXPECT_EQ(wait_for_run(topologies, rope->run_id)->body, 0u);
  std::this_thread::sleep_for(100ms);  // what else there may be
  auto others = topologies.take();
  for (auto [topology, info] : others.value()) EXPECT_FALSE(info.valid) << "body " << topology.body;
}

TEST(Server, PublishesTheFieldsAndThePrecisionThatTheSceneNames) {
  const auto server = start_paused_server();
  Client client;
  auto command = Client::make(flexcast_COMMAND_LOAD);
  wire::set_string(command->name, "soft");
  const auto reply = client.ask(command);
  ASSERT_EQ(reply->outcome, flexcast_OUTCOME_APPLIED) << wire::text(reply->reason);
  auto scenes = wire::Reader<flexcast_SceneInfo>::create(client.participant()).value();
  const auto scene = wait_for_run(scenes, reply->run_id);
  EXPECT_EQ(wire::text(scene->precision), "quantized16");
  EXPECT_EQ(wire::strings(scene->fields), (std::vector<std::string>{"positions", "velocities", "stretch", "stress"}));
  auto frames = wire::Reader<flexcast_ParticleFrame>::create(client.participant()).value();
  const auto frame = wait_for_run(frames, reply->run_id);
  EXPECT_EQ(frame->positions._length + frame->positions64._length + frame->velocities64._length, 0u);
  ASSERT_EQ(frame->positions16._length, 24u);
  EXPECT_EQ(frame->positions16._buffer[3], 65535u);  // node 1 has the largest x
  EXPECT_EQ(frame->bounds[3], 1.25);
  EXPECT_EQ(frame->velocities._length, 24u);
  ASSERT_EQ(frame->stretch._length, 8u);
  ASSERT_EQ(frame->stress._length, 8u);
  for (int i = 0; i < 8; ++i) {
    EXPECT_FLOAT_EQ(frame->stretch._buffer[i], 0.25f);
    EXPECT_FLOAT_EQ(frame->stress._buffer[i], 1e5f * 0.25f);
  }
}

TEST(Server, ASceneWithFramesTooLargeForItsStreamIsNotLoaded) {
  const auto server = start_paused_server();
  Client client;
  auto command = Client::make(flexcast_COMMAND_LOAD);
  wire::set_string(command->name, "long");
  const auto reply = client.ask(command);
  EXPECT_EQ(reply->outcome, flexcast_OUTCOME_REJECTED);
  EXPECT_NE(wire::text(reply->reason).find("too large"), std::string::npos) << wire::text(reply->reason);
}

TEST(Server, ASecondServerWithTheSameWorldIsRefused) {
  const auto server = start_paused_server();
  Options options = paused_rope();
  const auto second = Server::start(options);
  ASSERT_FALSE(second);
  EXPECT_NE(second.error().message.find("'rope'"), std::string::npos);
  options.world = "other";
  EXPECT_TRUE(Server::start(options));
  Client client;  // the first is untouched
  EXPECT_EQ(client.ask(Client::make(flexcast_COMMAND_STATUS))->outcome, flexcast_OUTCOME_APPLIED);
}

TEST(Server, SaysGoodbye) {
  auto server = start_paused_server();
  Client client;
  auto statuses = wire::Reader<flexcast_Status>::create(client.participant()).value();
  ASSERT_TRUE(wait_for([&] { return statuses.wait(0ns); }));
  server.reset();
  EXPECT_TRUE(wait_for([&] {
    auto samples = statuses.take();
    for (auto [status, info] : samples.value()) {
      if (info.state == wire::InstanceState::disposed) return true;
    }
    return false;
  }));
}

}  // namespace
}  // namespace flexcast::server
