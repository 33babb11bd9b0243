// flexcast-server: parses, wires and waits.
#include <pthread.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>

#include "core/base/parallel.h"
#include "server/options.h"
#include "server/progress_line.h"
#include "server/server.h"

namespace {

using namespace flexcast;
using namespace flexcast::server;

// Every thread leaves these signals to wait_for_end.
sigset_t block_end_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  return signals;
}

void set_up_log() {
  auto log = spdlog::stderr_color_mt("flexcast-server");
  // On a terminal a message takes the place of the progress line.
  log->set_pattern(isatty(STDERR_FILENO) != 0 ? "\r\x1b[K[%H:%M:%S.%e] [%^%l%$] %v" : "[%H:%M:%S.%e] [%l] %v");
  spdlog::set_default_logger(log);
}

void wait_for_end(const Server& server, const sigset_t& signals, bool exit_at_end) {
  constexpr timespec period{0, 100'000'000};
  ProgressLine progress;
  while (!(exit_at_end && server.ended())) {
    const int signal = sigtimedwait(&signals, nullptr, &period);
    if (signal == SIGINT || signal == SIGTERM) {
      spdlog::info("ending on {}", signal == SIGINT ? "SIGINT" : "SIGTERM");
      return;
    }
    progress.show(progress_text(server.latest()));
  }
}

}  // namespace

int main(int argc, char** argv) {
  const auto parsed = parse_options(argc, argv);
  if (const int* code = std::get_if<int>(&parsed)) return *code;
  const Options& options = std::get<Options>(parsed);
  const sigset_t signals = block_end_signals();
  set_up_log();
  set_thread_count(options.threads);

  auto started = Server::start(options);
  if (!started) {
    spdlog::error("{}", started.error().message);
    return 1;
  }
  Server& server = *started.value();
  std::printf("ready: %s\n", server.description().c_str());
  std::fflush(stdout);
  wait_for_end(server, signals, options.exit);
  const bool failed = options.exit && server.state() == WorldState::failed;
  server.stop();
  return failed ? 1 : 0;
}
