// status says what is the case with a world, and --watch goes on when it goes.
#include <gtest/gtest.h>
#include <pthread.h>

#include <csignal>
#include <thread>

#include "tests/clients/ctl/ctl.h"
#include "tests/support/fake_server.h"

namespace flexcast::ctl {
namespace {

using namespace std::chrono_literals;
using flexcast::test::FakeServer;
using test::ctl;

TEST(CtlStatus, AWorldWhoseHeartbeatMovesIsOk) {
  const FakeServer server("beam");
  EXPECT_EQ(ctl({"status", "--json"}).json()["health"], "ok");
  const auto text = ctl({"--world", "beam", "status"});
  EXPECT_EQ(text.exit_code, 0);
  EXPECT_NE(text.out.find("health            ok\n"), std::string::npos) << text.out;
  EXPECT_EQ(text.err, "");
}

TEST(CtlStatus, AStepLoopThatStandsStillIsHung) {
  FakeServer server("beam");
  server.stuck = true;
  const auto result = ctl({"status", "--json"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.json()["health"], "hung");
  EXPECT_EQ(result.json()["world"], "beam") << "with all the rest";
  EXPECT_NE(result.err.find("its step loop stands still"), std::string::npos) << result.err;
}

TEST(CtlStatus, AWorldThatFallsSilentIsGone) {
  FakeServer server("beam");
  ctl({"status"});
  server.quiet = true;  // its last status is still there for those who come
  const auto result = ctl({"status", "--json"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.json()["health"], "gone");
  EXPECT_NE(result.err.find("gone or unreachable"), std::string::npos) << result.err;
}

TEST(CtlStatus, AWorldThatWasNeverThereIsNotFoundAndTheDoctorIsNamed) {
  const FakeServer server("rope");
  const auto result = ctl({"--wait", "0.3", "--world", "beam", "status", "--json"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.json()["health"], "not_found");
  for (const char* part : {"no world 'beam'", "profile loopback", "waited 0.3 s", "there: rope", "doctor"}) {
    EXPECT_NE(result.err.find(part), std::string::npos) << part << ": " << result.err;
  }
}

TEST(CtlStatus, SeveralWorldsMustBeToldApart) {
  const FakeServer beam("beam"), rope("rope");
  const auto result = ctl({"status"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.out, "");
  EXPECT_NE(result.err.find("name one: "), std::string::npos) << result.err;
  EXPECT_EQ(ctl({"--world", "rope", "status", "--json"}).json()["world"], "rope");
}

// The lines of a watch that the given user interrupts.
template <class User>
test::Outcome watch(User user) {
  const auto previous = std::signal(SIGINT, SIG_IGN);  // should the watch not be there yet
  std::atomic<bool> ended = false;
  std::jthread other([&] {
    user();
    while (!ended) {
      std::this_thread::sleep_for(50ms);
      kill(getpid(), SIGINT);
    }
  });
  const auto watched = ctl({"--world", "beam", "status", "--watch", "--json"});
  ended = true;
  other.join();
  std::signal(SIGINT, previous);
  return watched;
}

TEST(CtlStatus, AWatchSaysThatTheWorldWentAndCameBack) {
  FakeServer server("beam");
  const auto watched = watch([&] {
    std::this_thread::sleep_for(500ms);
    server.say_goodbye();
    std::this_thread::sleep_for(500ms);
    server.quiet = false;
    std::this_thread::sleep_for(500ms);
  });
  EXPECT_EQ(watched.exit_code, 0);
  std::istringstream lines(watched.out);
  std::string course;
  for (std::string line; std::getline(lines, line);) {
    const auto health = Json::parse(line)["health"].get<std::string>();
    if (!course.ends_with(health + " ")) course += health + " ";
  }
  EXPECT_EQ(course, "ok ended ok ");
  EXPECT_NE(watched.err.find("'beam' is ended"), std::string::npos) << watched.err;
  EXPECT_NE(watched.err.find("'beam' is back"), std::string::npos) << watched.err;
}

TEST(CtlStatus, AWatchSaysThatTheServerDied) {
  std::optional<FakeServer> server("beam");
  const auto watched = watch([&] {
    std::this_thread::sleep_for(500ms);
    server.reset();  // no goodbye
    std::this_thread::sleep_for(500ms);
  });
  EXPECT_NE(watched.err.find("'beam' is gone"), std::string::npos) << watched.err;
}

}  // namespace
}  // namespace flexcast::ctl
