#include "idl/wire/profile.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "idl/wire/participant.h"
#include "tests/support/network.h"

namespace flexcast::wire {
namespace {

class Profiles : public testing::Test {
 protected:
  void SetUp() override { unsetenv("CYCLONEDDS_URI"); }
  void TearDown() override {
    unsetenv("CYCLONEDDS_URI");
    std::filesystem::remove(path);
  }
  void write(const std::string& text) const { std::ofstream(path) << text; }

  const std::string path =
      (std::filesystem::temp_directory_path() / ("flexcast-profile-" + std::to_string(getpid()) + ".xml")).string();
};

std::string error_of(const Result<Profile>& result) {
  return result ? "" : result.error().message;
}

TEST_F(Profiles, LoopbackIsTheDefault) {
  EXPECT_EQ(resolve_profile("").value().name, "loopback");
  EXPECT_EQ(resolve_profile("").value().config, resolve_profile("loopback").value().config);
}

TEST_F(Profiles, TheEnvironmentReplacesTheDefaultOnly) {
  setenv("CYCLONEDDS_URI", "file:///etc/mine.xml", 1);
  EXPECT_EQ(resolve_profile("").value().name, "environment");
  EXPECT_EQ(resolve_profile("").value().config, "file:///etc/mine.xml");
  EXPECT_EQ(resolve_profile("loopback").value().name, "loopback");
}

TEST_F(Profiles, UnknownNamesAndMissingFilesAreErrorsThatSayWhatIsAllowed) {
  EXPECT_EQ(error_of(resolve_profile("wlan")), "profile 'wlan' is unknown: loopback, lan or the path of an .xml file");
  EXPECT_EQ(error_of(resolve_profile("/nowhere/x.xml")), "cannot read the profile /nowhere/x.xml");
  write("just text");
  EXPECT_EQ(error_of(resolve_profile(path)), "the profile " + path + " is not XML");
}

TEST_F(Profiles, CycloneAcceptsTheLoopbackProfile) {
  const auto participant = Participant::create({.domain = test::test_domain(), .profile = "loopback"});
  ASSERT_TRUE(participant.ok());
  EXPECT_EQ(participant.value().profile(), "loopback");
  EXPECT_EQ(participant.value().domain(), test::test_domain());
}

// Tied to the loopback interface: a test must not speak to the network.
TEST_F(Profiles, CycloneAcceptsTheLanProfileFromAFile) {
  std::string lan = resolve_profile("lan").value().config;
  const std::string general = "<General>";
  ASSERT_NE(lan.find(general), std::string::npos);
  lan.insert(lan.find(general) + general.size(), "<Interfaces><NetworkInterface name=\"lo\"/></Interfaces>");
  write("<?xml version=\"1.0\" encoding=\"UTF-8\" ?>\n<!-- mine -->\n" + lan);
  const auto participant = Participant::create({.domain = test::test_domain(), .profile = path});
  EXPECT_TRUE(participant.ok()) << participant.error().message;
}

TEST_F(Profiles, ConfigurationsThatCycloneRefusesAreErrors) {
  write("<CycloneDDS><Domain><NoSuchThing/></Domain></CycloneDDS>");
  const auto participant = Participant::create({.domain = test::test_domain(), .profile = path});
  ASSERT_FALSE(participant.ok());
  EXPECT_NE(participant.error().message.find(path), std::string::npos);
}

TEST_F(Profiles, OneProcessUsesOneProfilePerDomain) {
  const Participant first = test::join_test_domain();
  const Participant second = test::join_test_domain();
  const auto third = Participant::create({.domain = test::test_domain(), .profile = "lan"});
  ASSERT_FALSE(third.ok());
  EXPECT_NE(third.error().message.find("already open"), std::string::npos);
  EXPECT_NE(first.guid(), second.guid());
}

TEST_F(Profiles, DomainsOutOfRangeAreRefused) {
  for (const int domain : {-1, 231, 1'000'000}) {
    const auto participant = Participant::create({.domain = domain, .profile = "loopback"});
    ASSERT_FALSE(participant.ok());
    EXPECT_EQ(participant.error().message, "domain " + std::to_string(domain) + " is not in 0..230");
  }
}

}  // namespace
}  // namespace flexcast::wire
