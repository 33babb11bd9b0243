// A server that hangs, one that is killed and one that has ended look different from outside.
#include <gtest/gtest.h>

#include <algorithm>

#include "idl/wire/fill.h"
#include "tests/system/scenes.h"
#include "tests/system/system_test.h"

namespace flexcast::test {
namespace {

class HangSystem : public SystemTest {
 protected:
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

bool tells_a_hang(const flexcast_Status& status) {
  const auto warnings = wire::strings(status.warnings);
  return std::any_of(warnings.begin(), warnings.end(),
                     [](const std::string& text) { return text.find("step loop") != std::string::npos; });
}

// A step of 10^12 sweeps does not end while there are tests.
TEST_F(HangSystem, AStepThatNeverEndsShowsInStatusesThatGoOnAndAKillInTheirEnd) {
  const auto server = start_server(write_file("rope.toml", rope_scene()), {"--paused"});
  const auto statuses = read_statuses();
  auto connection = connect();
  applied(connection.set({{"time.integrator", "xpbd"},
                          {"time.substeps", std::int64_t{1'000'000}},
                          {"solver.iterations", std::int64_t{1'000'000}}}));
  applied(connection.resume());
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
