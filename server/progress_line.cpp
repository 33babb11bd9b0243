#include "server/progress_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace flexcast::server {
namespace {

const char* state_text(WorldState state) {
  switch (state) {
    case WorldState::running:
      return "running";
    case WorldState::paused:
      return "paused";
    case WorldState::finished:
      return "finished";
    case WorldState::failed:
      return "failed";
  }
  return "?";
}

}  // namespace

std::string progress_text(const Publisher::Latest& latest) {
  const auto& [status, delivery] = latest;
  const std::string skipped = status.frames_skipped > 0 ? fmt::format(", {} skipped", status.frames_skipped) : "";
  return fmt::format("{}  step {}  time {:.6g} s  rate {:.3g}  frames {}{}  readers {}", state_text(status.state),
                     status.report.report.step, status.report.report.time, status.real_time_factor,
                     delivery.frames_published, skipped, delivery.readers);
}

ProgressLine::ProgressLine() : terminal_(isatty(STDERR_FILENO) != 0) {}

ProgressLine::~ProgressLine() {
  if (!shown_.empty()) std::fputs("\n", stderr);
}

void ProgressLine::show(const std::string& text) {
  if (!terminal_ || text == shown_) return;
  std::fprintf(stderr, "\r\x1b[K%s", text.c_str());
  std::fflush(stderr);
  shown_ = text;
}

}  // namespace flexcast::server
