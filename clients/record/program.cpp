#include "clients/record/program.h"

#include <fmt/format.h>
#include <pthread.h>

#include <csignal>

#include "clients/record/progress_line.h"
#include "clients/record/recorder.h"
#include "clients/record/recovery.h"

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

void record(Recorder& recorder, const Options& options, EndSignals& signals) {
  ProgressLine line;
  line.say(fmt::format("{}: world {} on domain {} -> {}", recorder.is_paused() ? "paused" : "recording",
                       recorder.world(), recorder.domain(), options.file));
  while (!recorder.ended() && !signals.arrived(tend_period)) {
    if (const std::string news = recorder.tend(); !news.empty()) line.say(news);
    line.show(recorder.progress(), recorder.bytes_written());
  }
}

int fail(const std::string& error) {
  fmt::print(stderr, "flexcast-record: {}\n", error);
  return 1;
}

int recover_file(const Options& options) {
  const auto recovery = recover(options.file);
  if (!recovery) return fail(recovery.error().message);
  fmt::print("{}", options.json ? to_json(recovery.value()) + "\n" : to_text(recovery.value()));
  return 0;
}

}  // namespace

int run_program(const Options& options) {
  if (options.recover) return recover_file(options);
  EndSignals signals;
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error of the write
  const auto started = Recorder::start(options, [&signals] { return signals.arrived(std::chrono::nanoseconds(0)); });
  if (!started) return fail(started.error().message);
  record(*started.value(), options, signals);
  const auto report = started.value()->finish();
  if (!report) return fail(report.error().message);
  fmt::print("{}", options.json ? to_json(report.value()) + "\n" : to_text(report.value()));
  return report.value().failure.empty() ? 0 : fail(report.value().failure);
}

}  // namespace flexcast::record
