// The program in a process of its own: this test program again, running the disabled test below.
#include "clients/record/program.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "tests/clients/record/recordings.h"

namespace flexcast::record {
namespace {

using test::eventually;
using test::Publisher;
using test::TemporaryFile;

TEST(Child, DISABLED_Records) {
  const char* file = std::getenv("FLEXCAST_TEST_FILE");
  ASSERT_NE(file, nullptr);
  const Options options{.file = file,
                        .world = "beam",
                        .domain = flexcast::test::test_domain(),
                        .profile = "loopback",
                        .frames = {},
                        .duration = {},
                        .json = true};
  EXPECT_EQ(run_program(options), 0);
}

std::string content(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

class Child {
 public:
  explicit Child(const std::string& file) : output_(file + ".out"), errors_(file + ".err") {
    std::vector<std::string> environment{"FLEXCAST_TEST_DOMAIN=" + std::to_string(flexcast::test::test_domain()),
                                         "FLEXCAST_TEST_FILE=" + file};
    // The sanitizer of the parent is that of the child.
    if (const char* given = std::getenv("TSAN_OPTIONS")) environment.push_back("TSAN_OPTIONS=" + std::string(given));
    std::vector<std::string> arguments{"child", "--gtest_filter=Child.DISABLED_Records",
                                       "--gtest_also_run_disabled_tests"};
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 1, output_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_addopen(&actions, 2, errors_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn(&pid_, "/proc/self/exe", &actions, nullptr, pointers(arguments).data(), pointers(environment).data());
    posix_spawn_file_actions_destroy(&actions);
  }
  ~Child() {
    if (pid_ > 0) {
      kill(pid_, SIGKILL);
      waitpid(pid_, nullptr, 0);
    }
    std::filesystem::remove(output_);
    std::filesystem::remove(errors_);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  std::string output() const { return content(output_); }
  std::string errors() const { return content(errors_); }

  // The exit code, or 256 if it was killed.
  int end(int signal) {
    kill(pid_, signal);
    int status = 0;
    waitpid(std::exchange(pid_, 0), &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 256;
  }

 private:
  static std::vector<char*> pointers(std::vector<std::string>& strings) {
    std::vector<char*> list;
    for (auto& string : strings) list.push_back(string.data());
    list.push_back(nullptr);
    return list;
  }
  std::string output_, errors_;
  pid_t pid_ = 0;
};

class Signals : public testing::TestWithParam<int> {};

TEST_P(Signals, CompleteTheFileWithEveryFrameSinceItSaidThatItRecords) {
  const Publisher server("beam");
  const std::string file = testing::TempDir() + "signals." + std::to_string(getpid()) + ".mcap";
  Child child(file);
  const std::string started =
      "recording: world beam on domain " + std::to_string(flexcast::test::test_domain()) + " -> " + file + "\n";
  ASSERT_TRUE(eventually([&] { return child.errors() == started; })) << child.errors();
  // No faster than a server: the writer keeps 64 frames for a reader that lags.
  for (std::uint64_t first = 0; first < 1000; first += 20) {
    server.publish_frames(1000, first, first + 19);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_EQ(child.end(GetParam()), 0);
  EXPECT_NE(child.output().find(R"("world":"beam","frames":1000,"gaps":0,"missing":[])"), std::string::npos)
      << child.output();
  const auto mapped = mcap::MappedFile::open(file);
  const auto contents = mcap::test::read(mapped.value().bytes());
  EXPECT_EQ(contents.end.ending, mcap::Ending::kComplete);
  EXPECT_EQ(test::messages_of(contents, "flexcast/frames").size(), 1000u);
  std::filesystem::remove(file);
}

INSTANTIATE_TEST_SUITE_P(Program, Signals, testing::Values(SIGINT, SIGTERM));

}  // namespace
}  // namespace flexcast::record
