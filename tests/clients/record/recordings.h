// Recordings made in this process, and what is in them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "clients/mcap/mapped_file.h"
#include "clients/record/recorder.h"
#include "tests/clients/mcap/contents.h"
#include "tests/clients/record/publisher.h"

namespace flexcast::record::test {

using namespace std::chrono_literals;

// Waits until `condition` holds; false after ten seconds.
template <class Condition>
bool eventually(Condition condition) {
  for (int i = 0; i < 2000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(5ms);
  }
  return condition();
}

// A path of its own for every test, removed at the end.
class TemporaryFile {
 public:
  TemporaryFile() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string(test->test_suite_name()) + "." + test->name() + "." + std::to_string(getpid());
    std::replace(name.begin(), name.end(), '/', '-');
    path_ = testing::TempDir() + name + ".mcap";
    std::filesystem::remove(path_);
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::string& path() const { return path_; }
  bool exists() const { return std::filesystem::exists(path_); }

 private:
  std::string path_;
};

inline Options options_for(const TemporaryFile& file, const std::string& world = "beam") {
  return {.file = file.path(),
          .world = world,
          .domain = flexcast::test::test_domain(),
          .profile = "loopback",
          .frames = {},
          .duration = {}};
}

inline std::unique_ptr<Recorder> start(const Options& options) {
  auto started = Recorder::start(options, [] { return false; });
  if (!started) throw std::runtime_error(started.error().message);  // ends the test
  return std::move(started).value();
}

// Ends the recording once it has so many whole frames.
inline Report finish(Recorder& recorder, std::uint64_t frames) {
  EXPECT_TRUE(eventually([&] { return recorder.progress().frames >= frames; })) << recorder.progress().frames;
  auto report = recorder.finish();
  if (!report) ADD_FAILURE() << report.error().message;
  return report ? std::move(report).value() : Report{};
}

// The whole file, which must be complete and sound.
inline mcap::test::Contents read(const TemporaryFile& file) {
  const auto mapped = mcap::MappedFile::open(file.path());
  if (!mapped) {
    ADD_FAILURE() << mapped.status().message();
    return {};
  }
  auto contents = mcap::test::read(mapped.value().bytes());
  EXPECT_EQ(contents.end.ending, mcap::Ending::kComplete) << contents.end.message;
  return contents;
}

inline std::vector<mcap::test::MessageCopy> messages_of(const mcap::test::Contents& contents, std::string_view topic) {
  std::vector<mcap::test::MessageCopy> messages;
  for (const auto& message : contents.messages) {
    if (message.topic == topic) messages.push_back(message);
  }
  return messages;
}

inline std::vector<std::uint32_t> sequences_of(const mcap::test::Contents& contents, std::string_view topic) {
  std::vector<std::uint32_t> sequences;
  for (const auto& message : messages_of(contents, topic)) sequences.push_back(message.sequence);
  return sequences;
}

}  // namespace flexcast::record::test
