// A domain with identities: who has none, or one of another authority, sees and does nothing; a watcher sees; an
// operator commands.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "idl/wire/fill.h"
#include "idl/wire/writer.h"
#include "tests/support/identities.h"
#include "tests/system/recording.h"
#include "tests/system/scenes.h"
#include "tests/system/system_test.h"

namespace flexcast::test {
namespace {

class SecuritySystem : public SystemTest {
 protected:
  SecuritySystem() { make_identities(path("ours"), {"server:operator", "op:operator", "eye:watcher"}); }

  std::string identity(const std::string& name) const { return path("ours/" + name).string(); }

  std::unique_ptr<Process> start_secure_server(Arguments arguments = {}) const {
    arguments.insert(arguments.end(), {"--security", identity("server")});
    return start_server(write_file("rope.toml", rope_scene()), arguments);
  }

  client::Connection connect_as(const std::string& name) const {
    auto connection = client::Connection::open({.domain = domain(), .security = identity(name), .wait = patience});
    if (!connection) throw std::runtime_error(connection.error().message);
    return std::move(connection).value();
  }

  // What recorders tell, once a second, for an identity.
  struct Announcements {
    wire::Participant participant;
    wire::Reader<flexcast_RecorderInfo> reader;
  };
  Announcements read_announcements(const std::string& name) const {
    auto participant = wire::Participant::create({.domain = domain(), .security = identity(name)}).value();
    auto reader = wire::Reader<flexcast_RecorderInfo>::create(participant).value();
    return {std::move(participant), std::move(reader)};
  }
  static void wait_for_recorded(const Announcements& announcements, std::uint64_t frames) {
    for (const client::Deadline deadline(patience); !deadline.passed(); announcements.reader.wait(deadline.left())) {
      const auto samples = announcements.reader.take();
      for (const auto [recorder, info] : samples.value())
        if (info.valid && recorder.frames >= frames) return;
    }
    throw std::runtime_error("the recorder does not get " + std::to_string(frames) + " frames");
  }

  // Our watcher's certificate and key, with the rights of an operator from an authority of its own: what its own side
  // of DDS Security believes and the server must not.
  std::string forge_operator() const {
    std::filesystem::create_directory(path("forged"));
    const auto take = [&](const std::string& from, const std::string& file) {
      std::filesystem::copy_file(path(from + "/eye/" + file), path("forged/" + file),
                                 std::filesystem::copy_options::overwrite_existing);
    };
    for (const std::string file : {"identity_ca.pem", "cert.pem", "key.pem"}) take("ours", file);
    for (const std::string file : {"permissions_ca.pem", "governance.p7s", "permissions.p7s"}) take("theirs", file);
    return path("forged").string();
  }

  Ended ctl_as(const std::string& name, Arguments arguments) const {
    arguments.insert(arguments.begin(), {"--security", identity(name)});
    return ctl(std::move(arguments));
  }
};

// Somebody who reads frames and writes commands as hard as he can.
class Intruder {
 public:
  Intruder(int domain, const std::string& security)
      : participant_(wire::Participant::create({.domain = domain, .security = security}).value()) {
    wire::set_string(command_->world, "rope");
    wire::set_string(command_->client_id, "intruder");
    command_->kind = flexcast_COMMAND_PAUSE;
  }

  // One attempt; counts what it gets.
  void act() {
    ++command_->request_id;
    (void)commands_.write(*command_);
    frames_.wait(50ms);
    got_ += frames_.take().value().size() + statuses_.take().value().size() + replies_.take().value().size();
    matched_ += commands_.matched().total + frames_.matched().total + statuses_.matched().total;
  }

  std::size_t got() const { return got_; }
  std::size_t matched() const { return matched_; }

 private:
  wire::Participant participant_;
  wire::Reader<flexcast_ParticleFrame> frames_ = wire::Reader<flexcast_ParticleFrame>::create(participant_).value();
  wire::Reader<flexcast_Status> statuses_ = wire::Reader<flexcast_Status>::create(participant_).value();
  wire::Reader<flexcast_Reply> replies_ = wire::Reader<flexcast_Reply>::create(participant_).value();
  wire::Writer<flexcast_Command> commands_ = wire::Writer<flexcast_Command>::create(participant_).value();
  wire::Owned<flexcast_Command> command_;
  std::size_t got_ = 0, matched_ = 0;
};

TEST_F(SecuritySystem, StrangersGetNoFramesAndPlaceNoCommandsWhileAnAuthorisedRecorderGetsEveryFrame) {
  make_identities(path("theirs"), {"op:operator", "eye:operator"});
  const auto server = start_secure_server();
  for (const std::string& security : {std::string(), path("theirs/op").string(), forge_operator()}) {
    SCOPED_TRACE(security.empty() ? "no identity" : security);
    Intruder intruder(domain(), security);
    intruder.act();
    // It joined before the recorder did, and tries on until that one has its frames.
    const auto recorder =
        start_waiting_recorder("run.mcap", {"--force", "--security", identity("eye"), "--frames", "1000"});
    for (const client::Deadline deadline(patience); recorder->runs() && !deadline.passed();) intruder.act();
    EXPECT_EQ(intruder.got(), 0U);
    EXPECT_EQ(intruder.matched(), 0U);
    ASSERT_FALSE(recorder->runs());
    EXPECT_EQ(await_recorder(*recorder)["frames"], 1000);
  }
  auto op = connect_as("op");
  const auto status = op.status(patience);
  ASSERT_TRUE(status.ok()) << status.error().message;
  EXPECT_EQ(status.value()->state, flexcast_WORLD_RUNNING);  // no pause was obeyed
  EXPECT_EQ(end(*server, SIGINT).find("intruder"), std::string::npos);
}

TEST_F(SecuritySystem, AWatcherGetsFramesAndStatusesAndIsToldThatItMayNotCommand) {
  const auto server = start_secure_server();
  auto eye = connect_as("eye");
  EXPECT_EQ(eye.world(), "rope");
  auto frames = eye.frames(client::Keep::newest);
  ASSERT_TRUE(frames.ok()) << frames.error().message;
  EXPECT_TRUE(frames.value().next(patience));
  EXPECT_TRUE(eye.status(patience).ok());
  const auto reply = eye.pause();
  ASSERT_FALSE(reply.ok());
  EXPECT_NE(reply.error().message.find("the identity in " + identity("eye") + " may not command world 'rope'"),
            std::string::npos)
      << reply.error().message;

  EXPECT_NE(ctl_as("eye", {"list"}).out.find("rope"), std::string::npos);
  EXPECT_NE(ctl_as("eye", {"status"}).out.find("running"), std::string::npos);
  const Ended refused = ctl_as("eye", {"pause"});
  EXPECT_EQ(refused.code, 1);
  EXPECT_NE(refused.err.find("may not command"), std::string::npos) << refused.err;
}

TEST_F(SecuritySystem, AnOperatorCommandsAndAWatchersRecordingHasTheCommandsRepliesAndEvents) {
  const auto server = start_secure_server({"--paused"});
  const auto recorder = start_recorder("run.mcap", {"--security", identity("eye")});
  auto op = connect_as("op");
  const auto announcements = read_announcements("op");
  wait_for_recorded(announcements, 1);
  EXPECT_EQ(applied(op.step(7, patience)).applied_step, 7U);
  wait_for_recorded(announcements, 8);  // long enough for the recorder to find the writer of commands, too
  EXPECT_EQ(applied(op.step(5, patience)).applied_step, 12U);
  wait_for_recorded(announcements, 13);
  const Json summary = end_recorder(*recorder);
  EXPECT_EQ(summary["gaps"], 0);

  const Recording recording = read_recording(path("run.mcap"));
  expect_complete(recording);
  expect_contiguous(recording.frames, 0);
  EXPECT_EQ(recording.frames.size(), 13U);
  EXPECT_GE(recording.messages.at("flexcast/commands"), 1U);
  EXPECT_EQ(recording.messages.at("flexcast/replies"), 2U);
  EXPECT_EQ(recording.command_events(flexcast_COMMAND_STEP).size(), 2U);
}

TEST_F(SecuritySystem, AWorldsNameIsTakenOnceAlsoAmongIdentities) {
  const auto server = start_secure_server();
  const Ended second = run("flexcast-server", {path("rope.toml").string(), "--domain", std::to_string(domain()),
                                               "--security", identity("op")});
  EXPECT_EQ(second.code, 1);
  EXPECT_NE(second.err.find("already"), std::string::npos) << second.err;
}

// Past every client, with the bare writer: what is left are the rights themselves.
TEST_F(SecuritySystem, AWatcherCannotEvenHaveAWriterOfCommands) {
  const auto server = start_secure_server();
  {
    const auto participant = wire::Participant::create({.domain = domain(), .security = identity("eye")}).value();
    EXPECT_FALSE(wire::Writer<flexcast_Command>::create(participant).ok());
    EXPECT_TRUE(wire::Reader<flexcast_Command>::create(participant).ok()) << "it may read them";
  }
  auto op = connect_as("op");
  EXPECT_EQ(op.status(patience).value()->state, flexcast_WORLD_RUNNING);
}

// The folder that Cyclone's library was loaded from is where its plugins are looked for.
TEST_F(SecuritySystem, AMissingPluginIsNamed) {
  std::filesystem::create_directory(path("lib"));
  std::ifstream maps("/proc/self/maps");
  std::string library;
  for (std::string line; library.empty() && std::getline(maps, line);) {
    if (line.find("libddsc.so") != std::string::npos) library = line.substr(line.find('/'));
  }
  ASSERT_FALSE(library.empty());
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(library).parent_path())) {
    const std::string name = entry.path().filename();  // one of them is what the loader looks for
    if (name.starts_with("libddsc.so")) std::filesystem::copy_file(entry.path(), path("lib/" + name));
  }
  const char* before = std::getenv("LD_LIBRARY_PATH");
  const std::string kept = before != nullptr ? before : "";
  setenv("LD_LIBRARY_PATH", path("lib").c_str(), 1);
  const Ended listed = ctl_as("op", {"--wait", "0.3", "list"});
  kept.empty() ? unsetenv("LD_LIBRARY_PATH") : setenv("LD_LIBRARY_PATH", kept.c_str(), 1);
  EXPECT_EQ(listed.code, 1) << listed.out;
  EXPECT_NE(listed.err.find("the plugin libdds_security_auth.so of Cyclone DDS is neither in " + path("lib").string()),
            std::string::npos)
      << listed.err;
}

TEST_F(SecuritySystem, ProgramsNameTheFileThatIsMissing) {
  std::filesystem::remove(path("ours/eye/key.pem"));
  const Ended listed = ctl_as("eye", {"list"});
  EXPECT_EQ(listed.code, 1);
  EXPECT_NE(listed.err.find("key.pem"), std::string::npos) << listed.err;
  const Ended recorded = run("flexcast-record", {"-o", path("run.mcap").string(), "--security", identity("eye")});
  EXPECT_EQ(recorded.code, 1);
  EXPECT_NE(recorded.err.find("key.pem"), std::string::npos) << recorded.err;
  const Ended served = run("flexcast-server", {write_file("rope.toml", rope_scene()).string(), "--security",
                                               identity("eye"), "--domain", std::to_string(domain())});
  EXPECT_EQ(served.code, 1);
  EXPECT_NE(served.err.find("key.pem"), std::string::npos) << served.err;
}

}  // namespace
}  // namespace flexcast::test
