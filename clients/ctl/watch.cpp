#include "clients/ctl/watch.h"

#include <csignal>

#include "clients/ctl/json.h"
#include "clients/ctl/text.h"

namespace flexcast::ctl {
namespace {

volatile std::sig_atomic_t interrupted = 0;

// SIGINT and SIGTERM end the watch, not the process, while one of these lives.
class Interruptible {
 public:
  Interruptible() {
    interrupted = 0;
    for (std::size_t i = 0; i < 2; ++i) previous_[i] = std::signal(signals[i], [](int) { interrupted = 1; });
  }
  ~Interruptible() {
    for (std::size_t i = 0; i < 2; ++i) std::signal(signals[i], previous_[i]);
  }
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;

 private:
  static constexpr int signals[2] = {SIGINT, SIGTERM};
  void (*previous_[2])(int) = {};
};

// In slices, so that an interruption is noticed soon.
client::Result<client::Status> next_status(client::Connection& connection, std::chrono::nanoseconds timeout) {
  const client::Deadline deadline(timeout);
  for (;;) {
    auto status =
        connection.status(std::min<std::chrono::nanoseconds>(std::chrono::milliseconds(200), deadline.left()));
    if (status || interrupted) return status;
    if (deadline.passed()) return status;
  }
}

}  // namespace

int run_status(const Options& options, client::Connection& connection, std::ostream& out, std::ostream& err) {
  const Interruptible interruptible;
  do {
    const auto status = next_status(connection, options.connect.timeout);
    if (interrupted) break;
    if (!status) {
      err << "flexcast-ctl: " << status.error().message << "\n";
      return 1;
    }
    if (options.json)
      out << to_json(*status.value()).dump() << std::endl;
    else
      out << (options.watch ? status_line(*status.value()) : status_text(*status.value())) << std::flush;
  } while (options.watch && !interrupted);
  return 0;
}

}  // namespace flexcast::ctl
