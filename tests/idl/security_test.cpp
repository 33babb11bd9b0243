#include <gtest/gtest.h>

#include <filesystem>

#include "idl/wire/raw_reader.h"
#include "idl/wire/writer.h"
#include "tests/support/identities.h"
#include "tests/support/network.h"

namespace flexcast::wire {
namespace {

namespace fs = std::filesystem;

// One authority and a foreign one, made once: each needs eight runs of openssl.
class Security : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    test::make_identities(folder(), {"op:operator", "eye:watcher"});
    test::make_identities(folder() / "foreign", {"op:operator"});
  }
  static void TearDownTestSuite() { fs::remove_all(folder()); }
  static fs::path folder() { return fs::temp_directory_path() / ("flexcast-identities-" + std::to_string(getpid())); }

  static Result<Participant> join(const fs::path& identity) {
    return Participant::create({.domain = test::test_domain(), .profile = "loopback", .security = identity.string()});
  }
  static std::string error_of(const fs::path& identity) {
    const auto participant = join(identity);
    return participant ? "" : participant.error().message;
  }
  // A copy of the watcher's identity that may be spoilt.
  static fs::path copy_of_watcher(const std::string& name) {
    fs::copy(folder() / "eye", folder() / name);
    return folder() / name;
  }
};

TEST_F(Security, AMissingFolderOrFileIsNamed) {
  EXPECT_EQ(error_of("/nowhere/op"), "there is no folder /nowhere/op with an identity");
  for (const char* name :
       {"identity_ca.pem", "permissions_ca.pem", "cert.pem", "key.pem", "governance.p7s", "permissions.p7s"}) {
    const fs::path identity = copy_of_watcher(std::string("without-") + name);
    fs::remove(identity / name);
    EXPECT_EQ(error_of(identity), "the identity in " + identity.string() + " lacks " + name + ", or it cannot be read");
  }
}

TEST_F(Security, PermissionsOfSomebodyElseAreRefusedWithTheReason) {
  const fs::path identity = copy_of_watcher("promoted");
  fs::copy(folder() / "op/permissions.p7s", identity / "permissions.p7s", fs::copy_options::overwrite_existing);
  const std::string error = error_of(identity);
  EXPECT_NE(error.find("cannot join domain"), std::string::npos) << error;
  EXPECT_NE(error.find(identity.string()), std::string::npos) << error;
  EXPECT_NE(error.find("Subject name is invalid"), std::string::npos) << error;
}

TEST_F(Security, ACertificateOfAnotherAuthorityIsRefusedAndTheDomainIsFreeAgain) {
  const fs::path identity = copy_of_watcher("foreigner");
  for (const char* name : {"cert.pem", "key.pem"})
    fs::copy(folder() / "foreign/op" / name, identity / name, fs::copy_options::overwrite_existing);
  EXPECT_NE(error_of(identity), "");
  EXPECT_EQ(error_of(folder() / "eye"), "");
}

TEST_F(Security, OneProcessHasOneIdentityPerDomain) {
  const auto first = join(folder() / "op");
  ASSERT_TRUE(first.ok()) << first.error().message;
  EXPECT_EQ(first.value().security(), (folder() / "op").string());
  EXPECT_TRUE(join(folder() / "op").ok());
  EXPECT_NE(error_of(folder() / "eye").find("already open in this process with the identity"), std::string::npos);
  EXPECT_NE(error_of("").find("already open"), std::string::npos);
}

// Whether the participant may write what flexcast/`name` carries.
template <class T>
std::string why_not_write(const Participant& participant) {
  const auto writer = Writer<T>::create(participant);
  return writer ? "" : writer.error().message;
}

TEST_F(Security, AWatcherReadsEveryTopicAndWritesNothingButRecorders) {
  const auto eye = join(folder() / "eye");
  ASSERT_TRUE(eye.ok()) << eye.error().message;
  for (const TopicRow& row : topic_table()) {
    const auto reader = RawReader::create(eye.value(), row);
    EXPECT_TRUE(reader.ok()) << reader.error().message;
  }
  EXPECT_EQ(why_not_write<flexcast_RecorderInfo>(eye.value()), "");
  const std::string error = why_not_write<flexcast_Command>(eye.value());
  EXPECT_NE(error.find("cannot write flexcast/commands"), std::string::npos) << error;
  EXPECT_NE(why_not_write<flexcast_RecorderCommand>(eye.value()), "");
  EXPECT_NE(why_not_write<flexcast_Status>(eye.value()), "");
  EXPECT_NE(why_not_write<flexcast_ParticleFrame>(eye.value()), "");
}

TEST_F(Security, AnOperatorWritesEveryTopic) {
  const auto op = join(folder() / "op");
  ASSERT_TRUE(op.ok()) << op.error().message;
  EXPECT_EQ(why_not_write<flexcast_Command>(op.value()), "");
  EXPECT_EQ(why_not_write<flexcast_ParticleFrame>(op.value()), "");
  EXPECT_EQ(why_not_write<flexcast_RecorderCommand>(op.value()), "");
}

}  // namespace
}  // namespace flexcast::wire
