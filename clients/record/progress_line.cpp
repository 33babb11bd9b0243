#include "clients/record/progress_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace flexcast::record {
namespace {

constexpr std::chrono::milliseconds redraw_period{250};

std::string missing_text(const Progress& progress) {
  return progress.missing == 0 ? "no gaps" : fmt::format("{} missing", progress.missing);
}

}  // namespace

ProgressLine::ProgressLine() : terminal_(isatty(STDERR_FILENO) != 0), last_{Clock::now()} {}

ProgressLine::~ProgressLine() {
  if (shown_) std::fputs("\n", stderr);
}

void ProgressLine::show(const Progress& progress, std::uint64_t bytes) {
  const auto now = Clock::now();
  if (!terminal_ || now - last_.time < redraw_period) return;
  const double seconds = std::chrono::duration<double>(now - last_.time).count();
  const double frame_rate = static_cast<double>(progress.frames - last_.frames) / seconds;
  const double byte_rate = static_cast<double>(bytes - last_.bytes) / seconds;
  fmt::print(stderr, "\r\x1b[K{} frames  {:.0f}/s  {:.1f} MB/s  {}  {:.1f} MB", progress.frames, frame_rate,
             byte_rate / 1e6, missing_text(progress), static_cast<double>(bytes) / 1e6);
  std::fflush(stderr);
  last_ = {now, progress.frames, bytes};
  shown_ = true;
}

void ProgressLine::say(const std::string& line) {
  fmt::print(stderr, "{}{}\n", shown_ ? "\r\x1b[K" : "", line);
  std::fflush(stderr);
  shown_ = false;
}

}  // namespace flexcast::record
