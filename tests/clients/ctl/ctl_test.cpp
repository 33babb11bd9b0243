#include <gtest/gtest.h>

#include <csignal>
#include <sstream>

#include "tests/clients/ctl/ctl.h"
#include "tests/support/fake_server.h"

namespace flexcast::ctl {
namespace {

using namespace std::chrono_literals;
using flexcast::test::FakeServer;
using test::ctl;

class Ctl : public testing::Test {
 protected:
  FakeServer server{"beam"};
};

TEST_F(Ctl, ListShowsTheWorlds) {
  const auto text = ctl({"list"});
  EXPECT_EQ(text.exit_code, 0);
  EXPECT_EQ(text.out,
            "WORLD  STATE    STEP  TIME  RATE      VERSION\n"
            "beam   running  0     0 s   realtime  0\n");
  const auto json = ctl({"--json", "list"}).json();
  ASSERT_EQ(json["worlds"].size(), 1u);
  EXPECT_EQ(json["worlds"][0]["world"], "beam");
  EXPECT_EQ(json["worlds"][0]["state"], "running");
  EXPECT_TRUE(json["worlds"][0]["report"]["min_j"].is_null()) << "NaN";
}

TEST_F(Ctl, SetReportsStepAndValuesInForce) {
  const auto result = ctl({"--world", "beam", "set", "gravity=[0, 0, -3]", "beam.young=2000", "--json"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const auto json = result.json();
  EXPECT_EQ(json["outcome"], "applied");
  EXPECT_EQ(json["applied_step"], 0);
  EXPECT_EQ(json["parameter_revision"], 1);
  EXPECT_EQ(json["values"], Json::parse(R"({"gravity": [0.0, 0.0, -3.0], "beam.young": 2000.0})"));
  EXPECT_FALSE(json.contains("reason"));
  const auto text = ctl({"set", "solver.linear=pcg"});
  EXPECT_EQ(text.out, "applied at step 0 (0 s): running\nsolver.linear  pcg\n");
}

TEST_F(Ctl, SetIfRevisionIsRefusedWhenAnotherOneIsInForce) {
  EXPECT_EQ(ctl({"set", "beam.young=1", "--if-revision", "0"}).exit_code, 0);
  const auto refused = ctl({"set", "--if-revision", "0", "beam.young=2"});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_EQ(refused.err, "flexcast-ctl: rejected: parameter revision 1 is in force, not 0\n");
  EXPECT_EQ(ctl({"get", "beam.young"}).out, "beam.young  1\n");
  EXPECT_EQ(ctl({"set", "--if-revision", "1", "beam.young=2", "--json"}).json()["parameter_revision"], 2);
}

TEST_F(Ctl, RefusedCommandsFailWithTheReasonOnStderr) {
  const auto text = ctl({"set", "no.such=1"});
  EXPECT_EQ(text.exit_code, 1);
  EXPECT_EQ(text.out, "");
  EXPECT_EQ(text.err, "flexcast-ctl: rejected: no parameter takes no.such = 1\n");
  const auto json = ctl({"set", "no.such=1", "--json"});
  EXPECT_EQ(json.exit_code, 1);
  EXPECT_EQ(json.json()["outcome"], "rejected");
  EXPECT_EQ(json.json()["reason"], "no parameter takes no.such = 1");
  EXPECT_EQ(ctl({"set", "beam.young=nan"}).exit_code, 0) << "nan is a number: the server decides";
}

TEST_F(Ctl, DescribeAndGetPrintTables) {
  const auto described = ctl({"describe"});
  EXPECT_EQ(described.exit_code, 0);
  EXPECT_NE(described.out.find("gravity        [0, 0, -9.81]"), std::string::npos) << described.out;
  EXPECT_EQ(ctl({"get", "gravity"}).out, "gravity  [0, 0, -9.81]\n");
  const auto json = ctl({"describe", "--json"}).json();
  EXPECT_EQ(json["descriptors"].size(), 4u);
  EXPECT_EQ(json["descriptors"][1]["name"], "gravity");
  EXPECT_EQ(json["descriptors"][1]["kind"], "vector");
  EXPECT_TRUE(json["descriptors"][1]["minimum"].is_null()) << "unbounded";
}

TEST_F(Ctl, SteersTheCourseOfTime) {
  EXPECT_EQ(ctl({"pause", "--json"}).json()["state"], "paused");
  EXPECT_EQ(ctl({"status", "--json"}).json()["state"], "paused");
  EXPECT_EQ(ctl({"step", "5", "--json"}).json()["applied_step"], 5);
  EXPECT_EQ(ctl({"step", "--json"}).json()["applied_step"], 6);
  EXPECT_EQ(ctl({"run-until", "0.5", "--json"}).json()["applied_step"], 500);
  EXPECT_EQ(ctl({"reset", "--keep-parameters", "--json"}).json()["applied_step"], 0);
  EXPECT_EQ(ctl({"resume", "--json"}).json()["state"], "running");
}

TEST_F(Ctl, SavesAndRestoresByName) {
  ctl({"pause"});
  ctl({"step", "5"});
  EXPECT_EQ(ctl({"save", "start"}).out, "applied at step 5 (0 s): paused\n");
  ctl({"step", "3"});
  const auto restored = ctl({"restore", "start", "--json"});
  EXPECT_EQ(restored.exit_code, 0) << restored.err;
  EXPECT_EQ(restored.json()["command"], "restore");
  EXPECT_EQ(restored.json()["applied_step"], 5);
  const auto missing = ctl({"restore", "end"});
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_EQ(missing.err, "flexcast-ctl: rejected: there is no checkpoint 'end'\n");
}

TEST_F(Ctl, GrabsAndReleasesAParticle) {
  const auto pull_of = [](const std::string& particle) {
    return ctl({"release", particle, "--json"}).json()["values"]["released"];
  };
  EXPECT_EQ(ctl({"grab", "12", "-0.5", "0", "-2", "--stiffness", "40"}).exit_code, 0);
  EXPECT_EQ(pull_of("12"), "[-0.5, 0, -2] m, 40 N/m");
  EXPECT_EQ(ctl({"grab", "--json", "12", "1e-3", "-0.5", "3"}).json()["outcome"], "applied");
  EXPECT_EQ(pull_of("12"), "[0.001, -0.5, 3] m, 0 N/m");
  const auto again = ctl({"release", "12"});
  EXPECT_EQ(again.exit_code, 1);
  EXPECT_EQ(again.err, "flexcast-ctl: rejected: particle 12 is not grabbed\n");
}

TEST_F(Ctl, SaysWhatIsNotSupported) {
  const auto result = ctl({"load", "name", "--json"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.json()["outcome"], "unsupported");
}

TEST_F(Ctl, StatusIsReadable) {
  const auto status = ctl({"status"});
  EXPECT_EQ(status.exit_code, 0);
  EXPECT_NE(status.out.find("world             beam\n"), std::string::npos) << status.out;
}

TEST_F(Ctl, WatchPrintsALineForEveryStatusUntilInterrupted) {
  const auto previous = std::signal(SIGINT, SIG_IGN);  // should the watch not be there yet
  std::jthread user([](const std::stop_token& stop) {
    for (int i = 0; !stop.stop_requested(); ++i) {
      std::this_thread::sleep_for(100ms);
      if (i >= 6) raise(SIGINT);
    }
  });
  const auto watched = ctl({"--world", "beam", "status", "--watch", "--json"});
  user.request_stop();
  user.join();
  std::signal(SIGINT, previous);
  EXPECT_EQ(watched.exit_code, 0);
  std::istringstream lines(watched.out);
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) EXPECT_EQ(Json::parse(line)["world"], "beam");
  EXPECT_GE(count, 2);
}

TEST(CtlAlone, FailsWithoutAServerAndSaysWhatItLookedFor) {
  const auto result = ctl({"--wait", "0.1", "--world", "beam", "pause"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err, "flexcast-ctl: no world 'beam' on domain " + std::to_string(flexcast::test::test_domain()) +
                            " (profile loopback): waited 0.1 s\n");
  EXPECT_EQ(ctl({"list", "--json"}).out, "{\"worlds\":[]}\n");
}

TEST(CtlAlone, AnswersBadUsageWithCodeTwo) {
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{},
                                             {"fly"},
                                             {"set"},
                                             {"load"},
                                             {"load", "a", "b"},
                                             {"save"},
                                             {"restore", "a", "b"},
                                             {"grab", "1", "0", "0"},
                                             {"grab", "-1", "0", "0", "0"},
                                             {"grab", "1", "0", "0", "up"},
                                             {"release"},
                                             {"release", "tip"},
                                             {"run-until"},
                                             {"step", "0"},
                                             {"set", "a=1", "--if-revision", "x"},
                                             {"get", "a", "--if-revision", "1"},
                                             {"step", "many"},
                                             {"pause", "now"},
                                             {"list", "--nonsense"}}) {
    const auto result = ctl(words);
    EXPECT_EQ(result.exit_code, 2) << (words.empty() ? "" : words.back());
    EXPECT_EQ(result.out, "");
    EXPECT_NE(result.err, "");
  }
}

TEST(CtlAlone, HelpAndVersionGoToStdout) {
  const auto help = ctl({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_NE(help.out.find("Examples:"), std::string::npos);
  for (const std::string verb : {"save", "restore", "load", "grab", "release"}) {
    const auto of_verb = ctl({verb, "--help"});
    EXPECT_EQ(of_verb.exit_code, 0);
    EXPECT_NE(of_verb.out.find(verb == "grab" ? "--stiffness" : "REQUIRED"), std::string::npos) << of_verb.out;
  }
  EXPECT_EQ(ctl({"--version"}).out, "flexcast-ctl " FLEXCAST_VERSION "\n");
}

}  // namespace
}  // namespace flexcast::ctl
