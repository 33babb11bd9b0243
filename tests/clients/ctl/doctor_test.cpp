// Every finding of the doctor, its level and its remedy.
#include "clients/ctl/doctor.h"

#include <dds/dds.h>
#include <gtest/gtest.h>

#include "clients/ctl/checks.h"
#include "tests/clients/ctl/ctl.h"
#include "tests/support/fake_server.h"

namespace flexcast::ctl {
namespace {

using flexcast::test::FakeServer;
using test::ctl;

// A machine and a domain without trouble.
Findings sound() {
  Findings f;
  f.profile = "loopback";
  f.interfaces = {{"lo", "127.0.0.1", true, false}, {"eth0", "10.0.0.2", false, true}};
  f.wanted_buffer = f.granted_buffer = 4 << 20;
  f.servers = {{"beam", 1, FLEXCAST_VERSION, wire::Guid{1}, Health::ok, 0.0}};
  f.participants = {wire::Guid{1}};
  f.writers = {{wire::Guid{1}, "flexcast/status", "flexcast::Status"}};
  f.readable = {wire::Guid{1}};
  return f;
}

Diagnosis examine(const Findings& findings, std::string_view name) {
  for (const Check& check : check_table()) {
    if (check.name == name) return check.examine(findings);
  }
  throw std::runtime_error("no such check");
}

void expect(const Findings& findings, std::string_view name, Level level, const std::string& finding,
            const std::string& remedy) {
  const Diagnosis diagnosis = examine(findings, name);
  EXPECT_EQ(diagnosis.level, level) << diagnosis.finding;
  EXPECT_NE(diagnosis.finding.find(finding), std::string::npos) << diagnosis.finding;
  EXPECT_NE(diagnosis.remedy.find(remedy), std::string::npos) << diagnosis.remedy;
}

TEST(Doctor, HasNothingToSayOfASoundMachine) {
  for (const Check& check : check_table()) {
    const Diagnosis diagnosis = check.examine(sound());
    EXPECT_EQ(diagnosis.level, Level::ok) << check.name << ": " << diagnosis.finding;
    EXPECT_EQ(diagnosis.remedy, "") << check.name;
  }
  std::ostringstream out;
  EXPECT_EQ(report({}, sound(), out), 0);
}

TEST(Doctor, NamesTheSysctlOfASmallReceiveBuffer) {
  Findings f = sound();
  f.granted_buffer = 212992;
  expect(f, "receive buffer", Level::warn, "208 KiB of receive buffer of 4096 KiB", "net.core.rmem_max=4194304");
  std::ostringstream out;
  EXPECT_EQ(report({}, f, out), 0) << "a warning is no failure";
}

TEST(Doctor, SaysWhatTheEnvironmentOverrides) {
  Findings f = sound();
  f.environment = "file:///x.xml";
  expect(f, "environment", Level::warn, "file:///x.xml", "unset CYCLONEDDS_URI");
  f.profile_given = true;
  expect(f, "environment", Level::ok, "--profile overrides it", "");
}

TEST(Doctor, WantsOneInterfaceWithMulticastForTheLan) {
  Findings f = sound();
  f.profile = "lan";
  expect(f, "interface", Level::ok, "eth0 10.0.0.2", "");
  f.interfaces.push_back({"wlan0", "10.1.0.2", false, true});
  expect(f, "interface", Level::warn, "eth0 10.0.0.2, wlan0 10.1.0.2", "NetworkInterface name");
  f.interfaces = {{"lo", "127.0.0.1", true, true}, {"ppp0", "10.2.0.2", false, false}};
  expect(f, "interface", Level::fail, "no interface", "--profile loopback");
}

TEST(Doctor, SaysWhereServersAreWhenNoneIsHere) {
  Findings f = sound();
  f.world = "rope";
  expect(f, "servers", Level::fail, "no server of world 'rope' on domain 0 with profile loopback", "--world");
  f.servers.clear();
  f.world.clear();
  expect(f, "servers", Level::fail, "no server on domain 0", "flexcast-server SCENE.toml --domain 0");
  f.elsewhere = {"beam"};
  f.elsewhere_profile = "lan";
  expect(f, "servers", Level::fail, "under profile lan: beam", "--profile lan");
}

TEST(Doctor, FindsTwoServersOfOneNameOtherVersionsAndStepLoopsThatStandStill) {
  Findings f = sound();
  f.servers.push_back({"beam", 2, "0.0.1", wire::Guid{2}, Health::hung, 0.7});
  expect(f, "names", Level::fail, "2 servers call themselves 'beam'", "--world");
  expect(f, "versions", Level::warn, "the server of 'beam' is 0.0.1", "one version");
  expect(f, "step loops", Level::fail, "stands still for 0.7 s", "log");
}

TEST(Doctor, FindsStatusesOfAnotherFormAndDomainsOfOthers) {
  Findings f = sound();
  f.writers.push_back({wire::Guid{9}, "flexcast/status", "flexcast::Status"});
  expect(f, "types", Level::fail, "1 of the participants", "same source");
  f = sound();
  f.servers.clear();
  f.readable.clear();
  f.writers = {{wire::Guid{1}, "rt/chatter", "std_msgs::String"}};
  expect(f, "types", Level::warn, "none writes a topic of flexcast", "--domain");
  f.participants.assign(48, wire::Guid{1});
  expect(f, "participants", Level::warn, "beside this one: 48", "another --domain");
}

TEST(Doctor, ADomainThatCannotBeJoinedIsAFailure) {
  Findings f = sound();
  f.join_error = "domain 3, profile lan cannot be opened: Error";
  expect(f, "domain", Level::fail, "cannot be opened", "--domain");
}

// ---- with servers

std::string level_of(const Json& json, const std::string& name) {
  for (const Json& check : json["checks"]) {
    if (check["check"] == name) return check["level"];
  }
  return "no such check";
}

TEST(DoctorOnADomain, FindsNoServer) {
  const auto participant = flexcast::test::join_test_domain();  // keeps it from looking under another profile
  const auto result = ctl({"--wait", "0.3", "doctor", "--json"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.json()["healthy"], false);
  EXPECT_EQ(level_of(result.json(), "servers"), "fail");
  EXPECT_EQ(level_of(result.json(), "types"), "warn") << "somebody is there";
}

TEST(DoctorOnADomain, FindsAServerThatIsWell) {
  const FakeServer server("beam", 1, FLEXCAST_VERSION);
  const auto result = ctl({"--wait", "0.5", "doctor"});
  EXPECT_EQ(result.exit_code, 0) << result.out;
  EXPECT_NE(result.out.find("ok    servers         one world on domain"), std::string::npos) << result.out;
}

TEST(DoctorOnADomain, FindsTwoServersOfOneNameOneOfThemOldAndHung) {
  const FakeServer server("beam", 1, FLEXCAST_VERSION);
  FakeServer other("beam", 2, "0.0.1");
  other.stuck = true;
  const auto json = ctl({"--wait", "1", "doctor", "--json"}).json();
  EXPECT_EQ(level_of(json, "names"), "fail") << json;
  EXPECT_EQ(level_of(json, "versions"), "warn") << json;
  EXPECT_EQ(level_of(json, "step loops"), "fail") << json;
}

TEST(DoctorOnADomain, FindsAStatusThatDoesNotMatch) {
  const auto participant = flexcast::test::join_test_domain();
  const wire::Entity topic(
      dds_create_topic(participant.handle(), &flexcast_ProbeInfo_desc, "flexcast/status", nullptr, nullptr));
  const wire::Entity writer(dds_create_writer(participant.handle(), topic.handle(), nullptr, nullptr));
  ASSERT_GT(writer.handle(), 0);
  const auto json = ctl({"--wait", "0.3", "doctor", "--json"}).json();
  EXPECT_EQ(level_of(json, "types"), "fail") << json;
}

}  // namespace
}  // namespace flexcast::ctl
