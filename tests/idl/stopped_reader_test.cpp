// A reader in another process is stopped (SIGSTOP): a watcher must never slow the writer.
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "idl/wire/reader.h"
#include "idl/wire/writer.h"
#include "tests/idl/samples.h"
#include "tests/support/network.h"

namespace flexcast::wire {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

// The other process: this program again, running the disabled test below.
class Child {
 public:
  explicit Child(int domain) {
    std::vector<std::string> environment{"FLEXCAST_TEST_DOMAIN=" + std::to_string(domain)};
    // The sanitizer of the parent is that of the child.
    if (const char* given = std::getenv("TSAN_OPTIONS")) environment.push_back("TSAN_OPTIONS=" + std::string(given));
    std::vector<std::string> arguments{"child", "--gtest_filter=Child.DISABLED_Reads",
                                       "--gtest_also_run_disabled_tests"};
    posix_spawn(&pid_, "/proc/self/exe", nullptr, nullptr, pointers(arguments).data(), pointers(environment).data());
  }
  ~Child() {
    signal(SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  void signal(int number) const { kill(pid_, number); }

 private:
  static std::vector<char*> pointers(std::vector<std::string>& strings) {
    std::vector<char*> list;
    for (auto& string : strings) list.push_back(string.data());
    list.push_back(nullptr);
    return list;
  }
  pid_t pid_ = 0;
};

TEST(Child, DISABLED_Reads) {
  const Participant participant = test::join_test_domain();
  const auto reader = Reader<flexcast_ParticleFrame>::create(participant, topic(TopicId::frames).recorder).value();
  for (const auto end = Clock::now() + 60s; Clock::now() < end; reader.wait(100ms)) (void)reader.take();
}

// Longest single write of `count` frames of `numbers` floats while a matched reader stands still.
Clock::duration longest_write(std::size_t numbers, int count) {
  const Participant participant = test::join_test_domain();
  const auto writer =
      Writer<flexcast_ParticleFrame>::create(participant, frames_writer_qos(numbers * sizeof(float))).value();
  const Child child(participant.domain());
  for (int i = 0; i < 1000 && writer.matched().current == 0; ++i) std::this_thread::sleep_for(10ms);
  EXPECT_EQ(writer.matched().current, 1u);
  const std::vector<float> positions(numbers, 1.0f);
  Owned<flexcast_ParticleFrame> frame;
  set_string(frame->world, "beam");
  view(frame->positions, positions);
  EXPECT_TRUE(writer.write(*frame).ok());
  child.signal(SIGSTOP);
  Clock::duration longest{};
  for (int i = 0; i < count; ++i) {
    frame->frame++;
    const auto start = Clock::now();
    EXPECT_TRUE(writer.write(*frame).ok());
    longest = std::max(longest, Clock::now() - start);
  }
  EXPECT_EQ(writer.matched().current, 1u) << "the reader was gone before the end";
  return longest;
}

TEST(StoppedReader, DoesNotHoldUpWritesOfSmallFrames) {
  EXPECT_LT(longest_write(6'000, 2000), 2s);
}

// Many times what the history (64 MiB) and the writer's high-water mark (4 MiB) hold.
TEST(StoppedReader, DoesNotHoldUpWritesOfLargeFrames) {
  EXPECT_LT(longest_write(262'144, 300), 2s);
}

}  // namespace
}  // namespace flexcast::wire
