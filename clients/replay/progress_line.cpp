#include "clients/replay/progress_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "idl/wire/names.h"

namespace flexcast::replay {

ProgressLine::ProgressLine() : terminal_(isatty(STDERR_FILENO) != 0) {}

ProgressLine::~ProgressLine() {
  if (!shown_.empty()) std::fputs("\n", stderr);
}

void ProgressLine::show_reading(std::uint64_t messages) {
  const auto now = Clock::now();
  if (!terminal_ || now < next_) return;
  next_ = now + std::chrono::milliseconds(250);
  rewrite(fmt::format("reading: {} messages", messages));
}

void ProgressLine::show(const Replay::Latest& latest) {
  rewrite(fmt::format("{}  step {}  time {:.6g} s  frame {}", wire::name_of(latest.state), latest.shown.step,
                      latest.shown.time, latest.shown.frame));
}

void ProgressLine::say(const std::string& line) {
  const std::scoped_lock lock(mutex_);
  fmt::print(stderr, "{}{}\n", shown_.empty() ? "" : "\r\x1b[K", line);
  std::fflush(stderr);
  shown_.clear();
}

void ProgressLine::rewrite(const std::string& text) {
  const std::scoped_lock lock(mutex_);
  if (!terminal_ || text == shown_) return;
  fmt::print(stderr, "\r\x1b[K{}", text);
  std::fflush(stderr);
  shown_ = text;
}

}  // namespace flexcast::replay
