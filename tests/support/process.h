// Process: a program as a child of the test. It ends when this object does and, by the kernel, when the test dies.
//
//   Process server(bin("flexcast-server"), {"rope.toml", "--paused"});
//   server.wait_for_line("ready:", 30s);
//   server.send(SIGTERM);
//   EXPECT_EQ(server.wait(30s), 0);
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <exception>
#include <filesystem>
#include <iostream>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

namespace flexcast::test {

class Process {
 public:
  using Clock = std::chrono::steady_clock;

  // Starts the program; its input is empty. Throws when there is no such program.
  Process(const std::filesystem::path& program, std::vector<std::string> arguments);

  // Kills what still runs. In a test that has failed it prints what the program said.
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  pid_t pid() const { return pid_; }
  const std::string& command() const { return command_; }

  // The first whole line of either stream that contains `part`; none within the timeout, or if the program ends
  // without it.
  std::optional<std::string> wait_for_line(std::string_view part, std::chrono::nanoseconds timeout);

  void send(int signal) const {
    if (!status_) kill(pid_, signal);
  }

  // The exit code, 128 + number after a signal, as a shell says it; none: it still runs. Afterwards all it said is
  // here.
  std::optional<int> wait(std::chrono::nanoseconds timeout);
  bool runs() { return !wait(std::chrono::nanoseconds(0)); }

  std::string out() const { return text(0); }
  std::string err() const { return text(1); }

 private:
  struct Pipe {
    Pipe() {
      std::array<int, 2> ends{};
      if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
      read = ends[0];
      write = ends[1];
    }
    ~Pipe() {
      close(read);
      close_write();
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    void close_write() {
      if (write >= 0) close(std::exchange(write, -1));
    }
    int read = -1, write = -1;
  };

  [[noreturn]] static void become(char* const* argv, const std::array<int, 2>& streams, pid_t parent);
  void listen();
  std::string text(std::size_t stream) const;
  std::optional<std::string> find_line(std::string_view part) const;

  std::string command_;
  std::array<Pipe, 2> pipes_;  // standard output and error
  pid_t pid_ = -1;
  std::optional<int> status_;
  mutable std::mutex mutex_;  // guards the rest
  std::condition_variable said_;
  std::array<std::string, 2> texts_;
  bool silent_ = false;  // both streams are closed
  std::thread listener_;
};

inline Process::Process(const std::filesystem::path& program, std::vector<std::string> arguments) {
  if (access(program.c_str(), X_OK) != 0) throw std::runtime_error(program.string() + " is not a program");
  arguments.insert(arguments.begin(), program.string());
  std::vector<char*> argv;
  for (std::string& argument : arguments) {
    command_ += (command_.empty() ? "" : " ") + argument;
    argv.push_back(argument.data());
  }
  argv.push_back(nullptr);
  const pid_t parent = getpid();
  const std::array streams{pipes_[0].write, pipes_[1].write};
  pid_ = fork();
  if (pid_ < 0) throw std::runtime_error("no process for " + command_);
  if (pid_ == 0) become(argv.data(), streams, parent);
  for (Pipe& pipe : pipes_) pipe.close_write();
  listener_ = std::thread(&Process::listen, this);
}

// In the child: only what is allowed between fork and exec in a program with threads.
inline void Process::become(char* const* argv, const std::array<int, 2>& streams, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);  // it died before
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  const int nothing = open("/dev/null", O_RDONLY);
  dup2(nothing, STDIN_FILENO);
  dup2(streams[0], STDOUT_FILENO);
  dup2(streams[1], STDERR_FILENO);
  execv(argv[0], argv);
  _exit(127);
}

inline Process::~Process() {
  send(SIGKILL);
  wait(std::chrono::hours(1));
  if (!testing::Test::HasFailure() && std::uncaught_exceptions() == 0) return;
  std::cerr << "---- " << command_ << "\n---- ended with " << *status_ << ", standard output:\n"
            << texts_[0] << "---- standard error:\n"
            << texts_[1] << "----\n";
}

inline void Process::listen() {
  std::array<pollfd, 2> watched{pollfd{pipes_[0].read, POLLIN, 0}, pollfd{pipes_[1].read, POLLIN, 0}};
  std::array<char, 65536> buffer;
  while (watched[0].fd >= 0 || watched[1].fd >= 0) {
    poll(watched.data(), watched.size(), -1);
    for (std::size_t i = 0; i < watched.size(); ++i) {
      if (watched[i].fd < 0 || watched[i].revents == 0) continue;
      const ssize_t count = read(watched[i].fd, buffer.data(), buffer.size());
      const std::scoped_lock lock(mutex_);
      if (count > 0) texts_[i].append(buffer.data(), static_cast<std::size_t>(count));
      if (count == 0) watched[i].fd = -1;
      said_.notify_all();
    }
  }
  const std::scoped_lock lock(mutex_);
  silent_ = true;
  said_.notify_all();
}

inline std::string Process::text(std::size_t stream) const {
  const std::scoped_lock lock(mutex_);
  return texts_[stream];
}

inline std::optional<std::string> Process::find_line(std::string_view part) const {
  for (const std::string& said : texts_) {
    for (std::size_t begin = 0, end; (end = said.find('\n', begin)) != std::string::npos; begin = end + 1) {
      const std::string_view line(said.data() + begin, end - begin);
      if (line.find(part) != std::string_view::npos) return std::string(line);
    }
  }
  return std::nullopt;
}

inline std::optional<std::string> Process::wait_for_line(std::string_view part, std::chrono::nanoseconds timeout) {
  const auto latest = Clock::now() + timeout;
  std::unique_lock lock(mutex_);
  std::optional<std::string> line;
  said_.wait_until(lock, latest, [&] { return (line = find_line(part)) || silent_; });
  return line;
}

inline std::optional<int> Process::wait(std::chrono::nanoseconds timeout) {
  const auto latest = Clock::now() + timeout;
  while (!status_) {
    int status = 0;
    if (waitpid(pid_, &status, WNOHANG) == pid_) {
      status_ = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
      listener_.join();
    } else if (Clock::now() >= latest) {
      return std::nullopt;
    } else {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  }
  return status_;
}

}  // namespace flexcast::test
