// flexcast-ctl against a real server: what it prints parses, and its exit codes are 0, 1 and 2.
#include <gtest/gtest.h>

#include "idl/wire/fill.h"
#include "idl/wire/writer.h"
#include "tests/system/scenes.h"
#include "tests/system/system_test.h"

namespace flexcast::test {
namespace {

using CtlSystem = SystemTest;

TEST_F(CtlSystem, EverythingItPrintsWithJsonParses) {
  const auto server = start_server(write_file("pair.toml", pair_scene()), {"--paused"});
  const Json worlds = ctl_json({"list"})["worlds"];
  ASSERT_EQ(worlds.size(), 1U);
  EXPECT_EQ(worlds[0]["world"], "pair");
  EXPECT_EQ(worlds[0]["state"], "paused");

  const Json described = ctl_json({"describe"});
  const Json values = ctl_json({"get"})["values"];
  EXPECT_EQ(described["descriptors"].size(), values.size());
  for (const Json& descriptor : described["descriptors"]) {
    const auto name = descriptor["name"].get<std::string>();
    EXPECT_TRUE(values.contains(name)) << name;
    EXPECT_FALSE(descriptor["description"].get<std::string>().empty()) << name;
    EXPECT_EQ(descriptor["initial"], values[name]) << name;
  }
  EXPECT_EQ(values["beam.young"], 1e5);
  EXPECT_EQ(values["gravity"], Json::parse("[0.0, 0.0, -9.81]"));
  EXPECT_EQ(values["time.integrator"], "symplectic_euler");
  EXPECT_EQ(ctl_json({"get", "rope.damping"})["values"], Json::parse(R"({"rope.damping": 0.01})"));

  const Json status = ctl_json({"status"});
  EXPECT_EQ(status["step"], 0);
  EXPECT_EQ(status["report"]["kinetic"].is_number(), true);
  EXPECT_EQ(status["probes"]["end"]["position"], Json::parse("[1.0, 0.0, 1.0]"));
  EXPECT_EQ(ctl_json({"--world", "pair", "run-until", "0.01"})["applied_step"], 10);
  EXPECT_EQ(ctl_json({"status"})["report"]["step"], 10);
}

TEST_F(CtlSystem, ReadsWellWithoutJson) {
  const auto server = start_server(write_file("pair.toml", pair_scene()), {"--paused"});
  const std::vector<std::pair<Arguments, std::string>> said = {
      {{"list"}, "pair"},
      {{"describe"}, "rope.stiffness"},
      {{"get", "rope.stiffness"}, "50"},
      {{"status"}, "paused"},
      {{"step", "2"}, "step 2"},
      {{"set", "rope.damping=0.5"}, "0.5"},
      {{"run-until", "0.005"}, "step 5"},
      {{"reset"}, "step 0"},
      {{"resume"}, "running"},
      {{"pause"}, "paused"},
  };
  for (const auto& [arguments, part] : said) {
    const Ended ended = ctl(arguments);
    EXPECT_EQ(ended.code, 0) << arguments[0] << ": " << ended.err;
    EXPECT_EQ(ended.err, "") << arguments[0];
    EXPECT_NE(ended.out.find(part), std::string::npos) << arguments[0] << ": " << ended.out;
  }
}

TEST_F(CtlSystem, StatusTellsAStoppedServerFromAnEndedOneAndADeadOne) {
  const auto scene = write_file("pair.toml", pair_scene());
  auto server = start_server(scene);
  EXPECT_EQ(ctl_json({"status"})["health"], "ok");
  const auto watch = start("flexcast-ctl", {"--domain", std::to_string(domain()), "status", "--watch"});
  ASSERT_TRUE(watch->wait_for_line("running", patience));
  end(*server, SIGTERM);
  EXPECT_TRUE(watch->wait_for_line("'pair' is ended", patience)) << watch->err();
  server = start_server(scene);
  EXPECT_TRUE(watch->wait_for_line("'pair' is back", patience)) << watch->err();
  server->send(SIGKILL);
  EXPECT_TRUE(watch->wait_for_line("'pair' is gone", patience)) << watch->err();
  end(*watch, SIGINT);
}

TEST_F(CtlSystem, StatusSaysThatTheStepLoopStandsStill) {
  const auto server = start_server(write_file("pair.toml", pair_scene()));
  EXPECT_EQ(ctl({"set", "time.substeps=1000000", "time.integrator=rk4"}).code, 0);  // a step of many seconds
  const Ended ended = ctl({"status", "--json"});
  EXPECT_EQ(ended.code, 1);
  EXPECT_EQ(Json::parse(ended.out)["health"], "hung");
  EXPECT_NE(ended.err.find("its step loop stands still"), std::string::npos) << ended.err;
}

TEST_F(CtlSystem, SetIfRevisionTakesOneOfTwoThatDecidedOnTheSame) {
  const auto server = start_server(write_file("pair.toml", pair_scene()), {"--paused"});
  const std::string revision = ctl_json({"get"})["parameter_revision"].dump();
  EXPECT_EQ(ctl({"set", "--if-revision", revision, "rope.damping=0.5"}).code, 0);
  const Ended second = ctl({"set", "--if-revision", revision, "rope.damping=0.7"});
  EXPECT_EQ(second.code, 1);
  EXPECT_NE(second.err.find("is in force, not " + revision), std::string::npos) << second.err;
  EXPECT_EQ(ctl_json({"get", "rope.damping"})["values"]["rope.damping"], 0.5);
}

// Two programs that decide on the same revision at the same time: one wins, and the other is told.
TEST_F(CtlSystem, OfTwoSetsThatRaceForARevisionExactlyOneWins) {
  const auto server = start_server(write_file("pair.toml", pair_scene()), {"--rate", "max"});
  for (int round = 0; round < 8; ++round) {
    const std::string revision = ctl_json({"get"})["parameter_revision"].dump();
    const std::vector<std::string> wanted = {std::to_string(2 * round + 1), std::to_string(2 * round + 2)};
    std::vector<std::unique_ptr<Process>> racers;
    for (const std::string& value : wanted) {
      racers.push_back(start("flexcast-ctl", {"--domain", std::to_string(domain()), "set", "--if-revision", revision,
                                              "rope.stiffness=" + value}));
    }
    std::vector<std::string> won;
    for (std::size_t i = 0; i < 2; ++i) {
      const auto code = racers[i]->wait(patience);
      ASSERT_TRUE(code == 0 || code == 1) << racers[i]->err();
      if (code == 0) {
        won.push_back(wanted[i]);
      } else {
        EXPECT_NE(racers[i]->err().find("is in force, not " + revision), std::string::npos);
      }
    }
    ASSERT_EQ(won.size(), 1U) << "round " << round;
    EXPECT_EQ(ctl_json({"get", "rope.stiffness"})["values"]["rope.stiffness"], std::stod(won[0]));
    EXPECT_EQ(ctl_json({"get"})["parameter_revision"], std::stoull(revision) + 1);
  }
}

std::string level_of(const Json& doctor, const std::string& name) {
  for (const Json& check : doctor["checks"]) {
    if (check["check"] == name) return check["level"];
  }
  return "no such check";
}

TEST_F(CtlSystem, TheDoctorIsContentWithAServerThatIsWellAlsoAfterASecondOfItsNameWasRefused) {
  const auto scene = write_file("pair.toml", pair_scene());
  const auto server = start_server(scene);
  for (const bool second : {false, true}) {
    if (second) {
      EXPECT_EQ(run("flexcast-server", {scene.string(), "--domain", std::to_string(domain())}).code, 1);
    }
    const Ended ended = ctl({"--wait", "1", "doctor", "--json"});
    EXPECT_EQ(ended.code, 0) << ended.out;
    EXPECT_EQ(Json::parse(ended.out)["healthy"], true) << ended.out;
    EXPECT_EQ(level_of(Json::parse(ended.out), "names"), "ok") << ended.out;
  }
}

TEST_F(CtlSystem, TheDoctorFindsThatNoServerIsThereBeforeOneComesAndAfterItEnded) {
  const auto expect_none = [&] {
    const Ended ended = ctl({"--wait", "0.5", "doctor", "--json"});
    EXPECT_EQ(ended.code, 1) << ended.out;
    EXPECT_EQ(level_of(Json::parse(ended.out), "servers"), "fail") << ended.out;
  };
  expect_none();
  const auto server = start_server(write_file("pair.toml", pair_scene()));
  EXPECT_EQ(ctl({"--wait", "1", "doctor"}).code, 0);
  end(*server, SIGTERM);
  expect_none();
}

// Beside the real server one of another version, as far as its status says.
TEST_F(CtlSystem, TheDoctorFindsAServerOfAnotherVersion) {
  const auto server = start_server(write_file("pair.toml", pair_scene()));
  const auto participant = wire::Participant::create({.domain = domain()}).value();
  const auto statuses = wire::Writer<flexcast_Status>::create(participant).value();
  wire::Owned<flexcast_Status> status;
  wire::set_string(status->world, "ancient");
  wire::set_string(status->version, "0.0.1");
  status->server_id = 7;
  EXPECT_TRUE(statuses.write(*status).ok());
  const Json json = Json::parse(ctl({"--wait", "1", "doctor", "--json"}).out);
  EXPECT_EQ(level_of(json, "versions"), "warn") << json;
  EXPECT_EQ(level_of(json, "names"), "ok") << json;
}

TEST_F(CtlSystem, NoServerIsAFailureWithinTheWaitAndBadUsageIsTold) {
  for (const Arguments& arguments : {Arguments{"--wait", "0.3", "status"}, Arguments{"--wait", "0.3", "get"},
                                     Arguments{"--wait", "0.3", "--world", "nobody", "pause"}}) {
    const Ended ended = ctl(arguments);
    EXPECT_EQ(ended.code, 1) << ended.err;
    EXPECT_NE(ended.err.find("domain " + std::to_string(domain())), std::string::npos) << ended.err;
    EXPECT_EQ(ended.out, "");
  }
  EXPECT_EQ(ctl_json({"list"})["worlds"].size(), 0U);
  for (const Arguments& arguments : {Arguments{},
                                     {"fly"},
                                     {"set"},
                                     {"step", "-1"},
                                     {"step", "x"},
                                     {"run-until"},
                                     {"--domain", "999", "list"},
                                     {"--wait", "soon", "list"}}) {
    const Ended ended = run("flexcast-ctl", arguments);
    EXPECT_EQ(ended.code, 2) << ended.err;
    EXPECT_FALSE(ended.err.empty());
    EXPECT_EQ(ended.out, "");
  }
}

TEST_F(CtlSystem, EveryProgramKnowsHelpVersionAndBadUsage) {
  for (const std::string program :
       {"flexcast-server", "flexcast-record", "flexcast-ctl", "flexcast-lab", "flexcast-verify"}) {
    const Ended help = run(program, {"--help"});
    EXPECT_EQ(help.code, 0) << program;
    EXPECT_NE(help.out.find("xample"), std::string::npos) << program;
    const Ended version = run(program, {"--version"});
    EXPECT_EQ(version.code, 0) << program;
    EXPECT_NE(version.out.find(program), std::string::npos) << program;
    const Ended bad = run(program, {"--no-such-option"});
    EXPECT_EQ(bad.code, 2) << program;
    EXPECT_EQ(bad.out, "") << program;
    EXPECT_FALSE(bad.err.empty()) << program;
  }
}

}  // namespace
}  // namespace flexcast::test
