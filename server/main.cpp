// flexcast-server: parses, wires and waits.
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <future>
#include <memory>
#include <optional>
#include <utility>

#include "server/end_signals.h"
#include "server/options.h"
#include "server/progress_line.h"
#include "server/server.h"

namespace {

using namespace flexcast;
using namespace flexcast::server;
using namespace std::chrono_literals;

void set_up_log() {
  auto log = spdlog::stderr_color_mt("flexcast-server");
  // On a terminal a message takes the place of the progress line.
  log->set_pattern(isatty(STDERR_FILENO) != 0 ? "\r\x1b[K[%H:%M:%S.%e] [%^%l%$] %v" : "[%H:%M:%S.%e] [%l] %v");
  spdlog::set_default_logger(log);
}

// Ends the process under the threads that still run.
[[noreturn]] void leave(const std::string& last_words) {
  spdlog::error("{}", last_words);
  std::fflush(stdout);
  std::_Exit(1);
}

// On a thread of its own, so that signals are heard while a scene is loaded.
Result<std::unique_ptr<Server>> start(const Options& options, EndSignals& signals) {
  std::optional<Result<std::unique_ptr<Server>>> started;
  auto starting = std::async(std::launch::async, [&] { started = Server::start(options); });
  while (starting.wait_for(20ms) != std::future_status::ready) {
    signals.wait(0ms);
    if (signals.impatient()) leave("the start had not ended " + signals.reason() + " and was cut off");
  }
  starting.get();
  return std::move(*started);
}

void wait_for_end(const Server& server, EndSignals& signals, bool exit_at_end) {
  ProgressLine progress;
  while (!signals.asked() && !(exit_at_end && server.ended())) {
    signals.wait(100ms);
    progress.show(progress_text(server.latest()));
  }
}

// In order, unless the step loop does not come to an end.
void stop(Server& server, EndSignals& signals) {
  server.begin_stop();
  while (!server.steps_ended()) {
    signals.wait(5ms);
    if (!signals.impatient()) continue;
    signals.let_kill();
    leave(server.cut_off(signals.reason()));
  }
  server.stop();
}

}  // namespace

int main(int argc, char** argv) {
  const auto parsed = parse_options(argc, argv);
  if (const int* code = std::get_if<int>(&parsed)) return *code;
  const Options& options = std::get<Options>(parsed);
  EndSignals signals;
  set_up_log();

  spdlog::info("loading {}", options.scene);
  auto started = start(options, signals);
  if (!started) {
    spdlog::error("{}", started.error().message);
    return 1;
  }
  Server& server = *started.value();
  std::printf("ready: %s\n", server.description().c_str());
  std::fflush(stdout);
  wait_for_end(server, signals, options.exit);
  const bool failed = options.exit && server.state() == WorldState::failed;
  stop(server, signals);
  return failed ? 1 : 0;
}
