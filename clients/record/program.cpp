#include "clients/record/program.h"

#include <fmt/format.h>
#include <pthread.h>

#include <csignal>

#include "clients/record/progress_line.h"
#include "clients/record/recorder.h"

namespace flexcast::record {
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

  // Waits for `timeout` (below a second) and remembers.
  bool arrived(std::chrono::nanoseconds timeout) {
    const timespec time{0, static_cast<long>(timeout.count())};
    if (!arrived_) arrived_ = sigtimedwait(&signals_, nullptr, &time) > 0;
    return arrived_;
  }

 private:
  sigset_t signals_;
  bool arrived_ = false;
};

constexpr std::chrono::milliseconds tend_period{50};

}  // namespace

int run_program(const Options& options) {
  EndSignals signals;
  const auto started = Recorder::start(options, [&signals] { return signals.arrived(std::chrono::nanoseconds(0)); });
  if (!started) {
    fmt::print(stderr, "flexcast-record: {}\n", started.error().message);
    return 1;
  }
  Recorder& recorder = *started.value();
  {
    ProgressLine line;
    line.say(fmt::format("recording: world {} on domain {} -> {}", recorder.world(), recorder.domain(), options.file));
    while (!recorder.ended() && !signals.arrived(tend_period)) {
      if (const std::string news = recorder.tend(); !news.empty()) line.say(news);
      line.show(recorder.progress(), recorder.bytes_written());
    }
  }
  const auto report = recorder.finish();
  if (!report) {
    fmt::print(stderr, "flexcast-record: {}\n", report.error().message);
    return 1;
  }
  fmt::print("{}", options.json ? to_json(report.value()) + "\n" : to_text(report.value()));
  return 0;
}

}  // namespace flexcast::record
