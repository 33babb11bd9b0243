// Many clients at once, and readers that come at any time: everyone is answered once and sees what is true.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <random>
#include <set>
#include <thread>

#include "idl/wire/fill.h"
#include "idl/wire/world_watch.h"
#include "idl/wire/writer.h"
#include "tests/system/replay.h"
#include "tests/system/scenes.h"
#include "tests/system/system_test.h"

namespace flexcast::test {
namespace {

using LoadSystem = SystemTest;

bool is_long() {
  return std::getenv("FLEXCAST_LONG") != nullptr;
}

struct Answer {
  flexcast_ReplyOutcome outcome;
  std::uint64_t parameter_revision, applied_step;

  bool operator==(const Answer&) const = default;
};

// Sends raw commands, each several times and none in order, until all are answered.
class ImpatientClient {
 public:
  ImpatientClient(int domain, int number)
      : id_("impatient-" + std::to_string(number)),
        random_(static_cast<unsigned>(number)),
        participant_(wire::Participant::create({.domain = domain}).value()),
        replies_(wire::Reader<flexcast_Reply>::create(participant_, {.depth = 0, .max_samples = 4096}).value()),
        commands_(wire::Writer<flexcast_Command>::create(participant_).value()) {
    for (const client::Deadline deadline(patience); !is_matched() && !deadline.passed();) replies_.wait(5ms);
  }

  // Every `expiring`th request is too late when it is received. Some more copies are sent after the answers.
  void ask(std::uint64_t requests, std::uint64_t expiring) {
    std::vector<std::uint64_t> open(requests);
    for (std::uint64_t i = 0; i < requests; ++i) open[i] = i + 1;
    for (const client::Deadline deadline(patience); !open.empty() && !deadline.passed();) {
      send(open, expiring);
      send({open[random_() % open.size()]}, expiring);
      for (const client::Deadline pause(200ms); !pause.passed(); replies_.wait(pause.left())) listen();
      std::erase_if(open, [this](std::uint64_t request) { return answers_.contains(request); });
    }
    send({1, 2, requests}, expiring);
    for (const client::Deadline pause(200ms); !pause.passed(); replies_.wait(pause.left())) listen();
  }

  const std::string& id() const { return id_; }
  const std::map<std::uint64_t, Answer>& answers() const { return answers_; }
  bool contradicted() const { return contradicted_; }  // two answers to one request differed

 private:
  bool is_matched() const { return commands_.matched().current > 0 && replies_.matched().current > 0; }

  void send(std::vector<std::uint64_t> requests, std::uint64_t expiring) {
    std::shuffle(requests.begin(), requests.end(), random_);
    for (const std::uint64_t request : requests) {
      wire::Owned<flexcast_Command> command;
      wire::set_string(command->world, "rope");
      wire::set_string(command->client_id, id_);
      command->request_id = request;
      command->kind = flexcast_COMMAND_SET;
      command->expires_in = request % expiring == 0 ? 1e-9 : 0.0;
      const auto values = wire::resize(command->values, 1);
      wire::set_string(values[0].name, "rope.stiffness");
      values[0].kind = flexcast_VALUE_NUMBER;
      wire::resize(values[0].numbers, 1)[0] = 50.0 + 0.001 * static_cast<double>(request);
      (void)commands_.write(*command);
    }
  }

  void listen() {
    const auto samples = replies_.take(512);
    for (const auto [reply, info] : samples.value()) {
      if (!info.valid || wire::text(reply.client_id) != id_) continue;
      const Answer answer{reply.outcome, reply.parameter_revision, reply.applied_step};
      const auto [known, is_new] = answers_.try_emplace(reply.request_id, answer);
      contradicted_ |= !is_new && !(known->second == answer);
    }
  }

  std::string id_;
  std::mt19937 random_;
  wire::Participant participant_;
  wire::Reader<flexcast_Reply> replies_;
  wire::Writer<flexcast_Command> commands_;
  std::map<std::uint64_t, Answer> answers_;
  bool contradicted_ = false;
};

// How often each request took effect, by the events of the run.
std::map<std::pair<std::string, std::uint64_t>, int> count_effects(int domain, std::size_t expected) {
  const auto participant = wire::Participant::create({.domain = domain}).value();
  const auto events = wire::Reader<flexcast_Event>::create(participant).value();
  std::map<std::pair<std::string, std::uint64_t>, int> effects;
  for (const client::Deadline deadline(patience); effects.size() < expected && !deadline.passed(); events.wait(100ms)) {
    const auto samples = events.take(4096);
    for (const auto [event, info] : samples.value()) {
      if (info.valid && event.kind == flexcast_EVENT_COMMAND)
        ++effects[{std::string(wire::text(event.client_id)), event.request_id}];
    }
  }
  return effects;
}

TEST_F(LoadSystem, EveryCommandOfManyImpatientClientsHasOneEffectAndOneAnswer) {
  constexpr int client_count = 8;
  constexpr std::uint64_t expiring = 10;
  const std::uint64_t requests = is_long() ? 125 : 30;
  const auto server = start_server(write_file("rope.toml", rope_scene()));
  auto connection = connect();
  const auto before = applied(connection.get()).parameter_revision;
  std::vector<std::unique_ptr<ImpatientClient>> clients;
  for (int i = 0; i < client_count; ++i) clients.push_back(std::make_unique<ImpatientClient>(domain(), i));
  {
    std::vector<std::jthread> threads;
    for (auto& one : clients) threads.emplace_back([&one, requests] { one->ask(requests, expiring); });
  }

  const std::uint64_t effective = client_count * (requests - requests / expiring);
  EXPECT_EQ(applied(connection.get()).parameter_revision, before + effective);
  const auto effects = count_effects(domain(), effective);
  EXPECT_EQ(effects.size(), effective);
  std::set<std::uint64_t> revisions;
  for (const auto& one : clients) {
    EXPECT_EQ(one->answers().size(), requests);
    EXPECT_FALSE(one->contradicted());
    for (const auto& [request, answer] : one->answers()) {
      const bool is_late = request % expiring == 0;
      ASSERT_EQ(answer.outcome, is_late ? flexcast_OUTCOME_EXPIRED : flexcast_OUTCOME_APPLIED);
      const auto found = effects.find({one->id(), request});
      ASSERT_EQ(found == effects.end() ? 0 : found->second, is_late ? 0 : 1) << one->id() << ", request " << request;
      if (!is_late) {
        EXPECT_TRUE(revisions.insert(answer.parameter_revision).second);
      }
    }
  }
}

struct Joined {
  std::uint64_t run_id, frame, step, state_hash;
};

// The first frame that each of so many readers sees; every one of them comes out of nowhere, at a random time.
std::vector<Joined> join_late(const wire::Participant& participant, int joiners) {
  std::mt19937 random(1);
  std::vector<Joined> joined;
  for (int i = 0; i < joiners; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(random() % 40));
    const auto frames = wire::Reader<flexcast_ParticleFrame>::create(participant).value();
    bool got = false;
    for (const client::Deadline deadline(patience); !got && !deadline.passed();) {
      frames.wait(deadline.left());
      const auto samples = frames.take(1);
      for (const auto [frame, info] : samples.value()) {
        if (!info.valid) continue;
        joined.push_back({frame.run_id, frame.frame, frame.step, frame.state_hash});
        got = true;
      }
    }
  }
  return joined;
}

TEST_F(LoadSystem, LateJoinersAroundResetsGetRightFrames) {
  const int joiners = is_long() ? 200 : 20;
  const auto scene = write_file("rope.toml", rope_scene());
  const auto server = start_server(scene, {"--rate", "0.5"});
  auto connection = connect();
  std::set<std::uint64_t> runs = {wait_for_status(connection, [](const auto&) { return true; })->run_id};
  const auto participant = wire::Participant::create({.domain = domain()}).value();
  std::vector<Joined> joined;
  std::atomic<bool> done = false;
  std::jthread joining([&] {
    joined = join_late(participant, joiners);
    done = true;
  });
  std::mt19937 random(2);
  while (!done) {
    std::this_thread::sleep_for(std::chrono::milliseconds(random() % 60));
    runs.insert(applied(connection.reset()).run_id);
  }
  joining.join();

  ASSERT_EQ(joined.size(), static_cast<std::size_t>(joiners));
  const auto last = std::max_element(joined.begin(), joined.end(),
                                     [](const Joined& some, const Joined& other) { return some.step < other.step; });
  const auto truth = calc_hashes(scene, static_cast<std::int64_t>(last->step));
  std::set<std::uint64_t> seen;
  for (const Joined& one : joined) {
    EXPECT_TRUE(runs.contains(one.run_id));
    EXPECT_EQ(one.frame, one.step);
    EXPECT_EQ(one.state_hash, truth[one.step]) << "step " << one.step;
    seen.insert(one.run_id);
  }
  EXPECT_GT(seen.size(), 3U);
}

TEST_F(LoadSystem, AClientAndAWatchOfWorldsCarryOnWhenAServerIsKilledAndStartedAgain) {
  const auto scene = write_file("rope.toml", rope_scene());
  auto server = start_server(scene);
  auto connection = connect();
  const auto participant = wire::Participant::create({.domain = domain()}).value();
  auto watch = wire::WorldWatch::create(participant).value();
  ASSERT_TRUE(watch.wait_for("rope", patience));
  const auto first = watch.find("rope")->status->server_id;
  const auto run = applied(connection.set({{"rope.stiffness", 60.0}})).run_id;
  server->send(SIGKILL);
  EXPECT_EQ(server->wait(patience), 128 + SIGKILL);
  server = start_server(scene);

  const auto is_second = [&] {
    watch.update();
    const auto worlds = watch.worlds();
    return worlds.size() == 1 && worlds[0]->status->server_id != first && worlds[0]->status->report.step > 10;
  };
  bool seen = false;
  for (const client::Deadline deadline(patience); !(seen = is_second()) && !deadline.passed();) watch.wait(100ms);
  EXPECT_TRUE(seen);
  const auto reply = applied(connection.set({{"rope.stiffness", 70.0}}));
  EXPECT_NE(reply.run_id, run);
  EXPECT_EQ(applied(connection.get({"rope.stiffness"})).values,
            (std::vector<client::Parameter>{{"rope.stiffness", 70.0}}));
}

}  // namespace
}  // namespace flexcast::test
