#include "server/end_signals.h"

#include <fmt/format.h>
#include <pthread.h>
#include <spdlog/spdlog.h>

#include <algorithm>

namespace flexcast::server {
namespace {

const char* name_of(int signal) {
  return signal == SIGINT ? "SIGINT" : "SIGTERM";
}

timespec to_timespec(Clock::duration duration) {
  const auto nanoseconds = std::chrono::duration_cast<std::chrono::nanoseconds>(duration).count();
  return {static_cast<time_t>(nanoseconds / 1'000'000'000), static_cast<long>(nanoseconds % 1'000'000'000)};
}

}  // namespace

EndSignals::EndSignals() {
  sigemptyset(&signals_);
  sigaddset(&signals_, SIGINT);
  sigaddset(&signals_, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals_, nullptr);
}

void EndSignals::wait(Clock::duration longest) {
  const timespec time = to_timespec(std::max(longest, Clock::duration::zero()));
  const int signal = sigtimedwait(&signals_, nullptr, &time);
  if (signal != SIGINT && signal != SIGTERM) return;
  again_ = asked();
  last_ = signal;
  if (again_) return;
  first_ = signal;
  asked_at_ = Clock::now();
  spdlog::info("ending on {}", name_of(signal));
}

std::string EndSignals::reason() const {
  if (again_) return fmt::format("at a second signal, {}", name_of(last_));
  return fmt::format("{:g} s after {}", seconds(grace), name_of(first_));
}

void EndSignals::let_kill() const {
  pthread_sigmask(SIG_UNBLOCK, &signals_, nullptr);
}

}  // namespace flexcast::server
