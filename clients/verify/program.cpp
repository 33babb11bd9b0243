#include "clients/verify/program.h"

#include <pthread.h>
#include <unistd.h>

#include <chrono>
#include <csignal>

#include "clients/verify/report_text.h"
#include "core/base/parallel.h"

namespace flexcast::verify {
namespace {

// Blocks SIGINT and SIGTERM as long as it lives and remembers whether one came.
class EndSignals {
 public:
  EndSignals() {
    sigemptyset(&signals_);
    sigaddset(&signals_, SIGINT);
    sigaddset(&signals_, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &signals_, &before_);
  }
  ~EndSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  EndSignals(const EndSignals&) = delete;
  EndSignals& operator=(const EndSignals&) = delete;

  bool arrived() {
    constexpr timespec now{0, 0};
    if (!arrived_) arrived_ = sigtimedwait(&signals_, nullptr, &now) > 0;
    return arrived_;
  }

 private:
  sigset_t signals_{}, before_{};
  bool arrived_ = false;
};

// Looks and shows ten times a second, however long a step takes.
class Overseer {
 public:
  explicit Overseer(std::ostream& err) : err_(err), terminal_(isatty(STDERR_FILENO) != 0) {}
  ~Overseer() {
    if (shown_) err_ << "\r\x1b[K" << std::flush;
  }
  Overseer(const Overseer&) = delete;
  Overseer& operator=(const Overseer&) = delete;

  bool look(const Progress& progress) {
    const auto now = Clock::now();
    if (now - last_ < std::chrono::milliseconds(100)) return true;
    last_ = now;
    if (terminal_) {
      err_ << "\rrun " << progress.run << " of " << progress.runs << ", step " << progress.step << " of "
           << progress.last_step << "\x1b[K" << std::flush;
      shown_ = true;
    }
    return !signals_.arrived();
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::ostream& err_;
  bool terminal_;
  bool shown_ = false;
  Clock::time_point last_{};
  EndSignals signals_;
};

}  // namespace

int run_program(const Options& options, std::ostream& out, std::ostream& err) {
  const auto fail = [&](const std::string& message) {
    err << "flexcast-verify: " << message << "\n";
    return 1;
  };
  set_thread_count(options.threads);
  auto recording = recording::Recording::open(options.file);
  if (!recording) return fail(recording.error().message);
  std::optional<Overseer> overseer(err);
  const auto report = verify_recording(recording.value(), options.run,
                                       [&](const Progress& progress) { return overseer->look(progress); });
  overseer.reset();
  if (!report) return fail(report.error().message);
  for (const std::string& warning : report.value().warnings) err << "flexcast-verify: warning: " << warning << "\n";
  out << (options.json ? to_json(report.value()) + "\n" : to_text(report.value())) << std::flush;
  return report.value().verified() ? 0 : 1;
}

}  // namespace flexcast::verify
