#include "clients/replay/program.h"

#include <fmt/format.h>
#include <pthread.h>

#include <csignal>

#include "clients/replay/progress_line.h"
#include "clients/replay/replay.h"

namespace flexcast::replay {
namespace {

// Every thread leaves these signals to arrived().
class EndSignals {
 public:
  EndSignals() {
    sigemptyset(&signals_);
    sigaddset(&signals_, SIGINT);
    sigaddset(&signals_, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &signals_, nullptr);
  }

  bool arrived() {
    constexpr timespec period{0, 100'000'000};
    return sigtimedwait(&signals_, nullptr, &period) > 0;
  }

 private:
  sigset_t signals_;
};

}  // namespace

int run_program(const Options& options) {
  EndSignals signals;
  ProgressLine line;
  const auto started = Replay::start(options, {[&](const std::string& text) { line.say("flexcast-replay: " + text); },
                                               [&](std::uint64_t messages) { line.show_reading(messages); }});
  if (!started) {
    line.say("flexcast-replay: " + started.error().message);
    return 1;
  }
  Replay& replay = *started.value();
  fmt::print("ready: {}\n", replay.description());
  std::fflush(stdout);
  while (!(options.exit && replay.ended()) && !signals.arrived()) line.show(replay.latest());
  replay.stop();
  return 0;
}

}  // namespace flexcast::replay
