// A server that hangs, one that is killed and one that has ended look different from outside.
#include <gtest/gtest.h>

#include <sys/stat.h>

#include <algorithm>

#include "idl/wire/fill.h"
#include "tests/system/scenes.h"
#include "tests/system/system_test.h"

namespace flexcast::test {
namespace {

class HangSystem : public SystemTest {
 protected:
  // Its first step of 10^12 sweeps does not end while there are tests.
  std::unique_ptr<Process> start_hanging_server() const {
    auto server = start_server(write_file("rope.toml", rope_scene()), {"--paused"});
    auto connection = connect();
    applied(connection.set({{"time.integrator", "xpbd"},
                            {"time.substeps", std::int64_t{1'000'000}},
                            {"solver.iterations", std::int64_t{1'000'000}}}));
    applied(connection.resume());
    return server;
  }

  // Every status there is from now on.
  wire::Reader<flexcast_Status> read_statuses() {
    participant_ = wire::Participant::create({.domain = domain()}).value();
    return wire::Reader<flexcast_Status>::create(*participant_, wire::topic(wire::TopicId::status).recorder).value();
  }

 private:
  std::optional<wire::Participant> participant_;
};

// Hands statuses on until `visit` says that it is enough; throws when that takes longer than `patience`.
void watch(const wire::Reader<flexcast_Status>& statuses,
           const std::function<bool(const flexcast_Status&, const wire::SampleInfo&)>& visit) {
  for (const client::Deadline deadline(patience); !deadline.passed(); statuses.wait(100ms)) {
    const auto samples = statuses.take();
    for (const auto [status, info] : samples.value()) {
      if (visit(status, info)) return;
    }
  }
  throw std::runtime_error("the statuses do not come to what the test waits for");
}

// The first warning with that part; "": none.
std::string warning(const flexcast_Status& status, const std::string& part) {
  const auto warnings = wire::strings(status.warnings);
  const auto found = std::find_if(warnings.begin(), warnings.end(),
                                  [&](const std::string& text) { return text.find(part) != std::string::npos; });
  return found != warnings.end() ? std::string(*found) : "";
}

bool tells_a_hang(const flexcast_Status& status) {
  return !warning(status, "step loop").empty();
}

TEST_F(HangSystem, AStepThatNeverEndsShowsInStatusesThatGoOnAndAKillInTheirEnd) {
  const auto server = start_hanging_server();
  const auto statuses = read_statuses();
  std::optional<std::uint64_t> heartbeat;
  int alike = 0;
  bool told = false;
  std::uint64_t writer = 0;
  watch(statuses, [&](const flexcast_Status& status, const wire::SampleInfo& info) {
    if (!info.valid || status.state != flexcast_WORLD_RUNNING) return false;
    alike = heartbeat == status.heartbeat ? alike + 1 : 1;
    heartbeat = status.heartbeat;
    writer = info.writer;
    told = tells_a_hang(status);
    return alike >= 8 && told;
  });
  EXPECT_TRUE(server->runs());

  server->send(SIGKILL);
  bool gone = false;
  for (const client::Deadline deadline(patience); !gone && !deadline.passed(); statuses.wait(100ms)) {
    const auto samples = statuses.take();
    for (const auto [status, info] : samples.value()) EXPECT_NE(info.state, wire::InstanceState::disposed);
    gone = !statuses.participant_of(writer);
  }
  EXPECT_TRUE(gone);
}

// A step that does not end is cut off a few seconds after the signal: the last status says so, the world is disposed.
TEST_F(HangSystem, AStepThatNeverEndsIsCutOffAfterSigtermAndTheServerSaysGoodbye) {
  const auto server = start_hanging_server();
  const auto statuses = read_statuses();
  server->send(SIGTERM);
  std::string last_words;
  watch(statuses, [&](const flexcast_Status& status, const wire::SampleInfo& info) {
    if (info.valid) last_words = warning(status, "cut off");
    return info.state == wire::InstanceState::disposed;
  });
  EXPECT_EQ(last_words,
            "step 1 had not ended 5 s after SIGTERM and was cut off; what was asked meanwhile is not answered");
  EXPECT_EQ(server->wait(patience), 1);
  EXPECT_NE(server->err().find("[error] " + last_words), std::string::npos) << server->err();
}

TEST_F(HangSystem, ASecondSignalCutsOffAtOnce) {
  const auto server = start_hanging_server();
  const auto statuses = read_statuses();
  // Who has just come may not know the server yet when it says goodbye.
  watch(statuses, [](const flexcast_Status&, const wire::SampleInfo& info) { return info.valid; });
  server->send(SIGINT);
  ASSERT_TRUE(server->wait_for_line("ending on SIGINT", patience));
  server->send(SIGINT);
  std::string last_words;
  watch(statuses, [&](const flexcast_Status& status, const wire::SampleInfo& info) {
    if (info.valid) last_words = warning(status, "cut off");
    return info.state == wire::InstanceState::disposed;
  });
  EXPECT_NE(last_words.find("step 1 had not ended at a second signal, SIGINT"), std::string::npos) << last_words;
  EXPECT_EQ(server->wait(patience), 1);
}

// A scene that is a pipe nobody writes into is never read to its end.
TEST_F(HangSystem, ALoadThatNeverEndsIsCutOffAsWell) {
  const auto server = start_server(write_file("rope.toml", rope_scene()));
  ASSERT_EQ(mkfifo(path("endless.toml").c_str(), 0600), 0);
  const auto loading = start("flexcast-ctl", {"--domain", std::to_string(domain()), "load", "endless"});
  const auto statuses = read_statuses();
  watch(statuses,
        [](const flexcast_Status& status, const wire::SampleInfo& info) { return info.valid && tells_a_hang(status); });
  server->send(SIGTERM);
  EXPECT_EQ(server->wait(patience), 1);
  EXPECT_NE(server->err().find("the command 'load' had not ended 5 s after SIGTERM"), std::string::npos)
      << server->err();
}

TEST_F(HangSystem, AStartThatNeverEndsIsCutOffAsWell) {
  ASSERT_EQ(mkfifo(path("endless.toml").c_str(), 0600), 0);
  const auto server = start("flexcast-server", {path("endless.toml").string(), "--domain", std::to_string(domain())});
  ASSERT_TRUE(server->wait_for_line("loading", patience));
  server->send(SIGTERM);
  ASSERT_TRUE(server->wait_for_line("ending on SIGTERM", patience));
  server->send(SIGTERM);
  EXPECT_EQ(server->wait(patience), 1);
  EXPECT_NE(server->err().find("the start had not ended at a second signal"), std::string::npos) << server->err();
}

TEST_F(HangSystem, AServerThatEndsSaysGoodbye) {
  const auto server = start_server(write_file("rope.toml", rope_scene()));
  const auto statuses = read_statuses();
  watch(statuses, [](const flexcast_Status& status, const wire::SampleInfo& info) {
    return info.valid && status.report.step > 100 && !tells_a_hang(status);
  });
  end(*server, SIGTERM);
  watch(statuses, [&](const flexcast_Status&, const wire::SampleInfo& info) {
    return info.state == wire::InstanceState::disposed;
  });
}

}  // namespace
}  // namespace flexcast::test
