#include "clients/export/program.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "clients/export/report.h"

namespace flexcast::exporting {
namespace {

// One line on stderr, rewritten in place on a terminal; silent in a pipe.
class Line {
 public:
  void show(std::uint64_t done, std::uint64_t all, const char* what) {
    if (!terminal_ || (done % 64 != 0 && done + 1 < all)) return;
    fmt::print(stderr, "\r\x1b[K{} {}", done, what);
    std::fflush(stderr);
    shown_ = true;
  }
  void say(const std::string& text) {
    fmt::print(stderr, "{}flexcast-export: {}\n", shown_ ? "\r\x1b[K" : "", text);
    shown_ = false;
  }
  void clear() {
    if (shown_) fmt::print(stderr, "\r\x1b[K");
    shown_ = false;
  }

 private:
  bool terminal_ = isatty(STDERR_FILENO) != 0;
  bool shown_ = false;
};

int fail(Line& line, const wire::Error& error) {
  line.say(error.message);
  return 1;
}

}  // namespace

int run_program(const Options& options) {
  Line line;
  auto recording = recording::Recording::open(options.file);
  if (!recording) return fail(line, recording.error());
  const auto index = recording::Index::make(recording.value(),
                                            [&](std::uint64_t messages) { line.show(messages, 0, "messages read"); });
  if (!index) return fail(line, index.error());
  if (!index.value().trouble().empty()) line.say(index.value().trouble() + "; it is exported as far as it goes");
  const auto selection = select(index.value(), options);
  if (!selection) return fail(line, selection.error());
  if (index.value().runs().size() > 1) line.say("exporting " + describe_run(index.value(), selection.value().run));
  const std::uint64_t frames = selection.value().frames.size();
  const auto summary = export_frames(recording.value(), index.value(), selection.value(), options,
                                     [&](std::uint64_t done) { line.show(done, frames, "frames written"); });
  if (!summary) return fail(line, summary.error());
  line.clear();
  const std::string missing = missing_text(selection.value(), summary.value());
  if (!missing.empty()) line.say(options.file + ": " + missing);
  fmt::print("{}\n",
             options.json ? to_json(summary.value(), selection.value(), options.file) : to_text(summary.value()));
  return 0;
}

}  // namespace flexcast::exporting
