#include "clients/replay/tape.h"

#include <cassert>
#include <utility>

namespace flexcast::replay {

Tape::Tape(recording::Recording recording, recording::Index index, std::vector<Clip> clips)
    : recording_(std::move(recording)), index_(std::move(index)), clips_(std::move(clips)) {
  assert(!clips_.empty());
  go_to(0, clips_.front().begin);
  // From the start of the file everything comes in its own time.
  jumped_ = first_ordinal() > 0;
  recording_.seek(first_ordinal());
}

bool Tape::is_from_start() const {
  return std::all_of(clips_.begin(), clips_.end(), [](const Clip& clip) { return clip.from_start; });
}

void Tape::go_to(std::size_t clip, std::size_t frame) {
  clip_ = clip;
  next_ = frame;
  jumped_ = true;
}

// What came between a run's first frame and the frame before it (of another run) belongs to it: its first events, say.
std::uint64_t Tape::first_ordinal() const {
  const Clip& clip = clips_[clip_];
  if (next_ != clip.begin || !clip.from_start) return next().first;
  return next_ == 0 ? 0 : index_.frames()[next_ - 1].last + 1;
}

void Tape::play(const Sink& sink) {
  if (std::exchange(jumped_, false)) play_in_force(sink);
  while (recording_.ordinal() <= next().last) {
    const recording::RecordedMessage* message = recording_.next();
    if (message == nullptr) break;
    sink(*message);
  }
  played_ = next_++;
  played_clip_ = clip_;
  const Clip& clip = clips_[clip_];
  if (next_ < clip.end) return;
  if (++clip_ == clips_.size()) return;
  const bool goes_on = clip.to_end && clips_[clip_].from_start && clips_[clip_].begin == next_;
  if (!goes_on) go_to(clip_, clips_[clip_].begin);
}

void Tape::play_in_force(const Sink& sink) {
  recording_.seek(next().first);
  const recording::RecordedMessage* message = recording_.next();
  if (message == nullptr) return;
  if (const auto head = wire::peek_frame_head(message->bytes)) {
    for (const std::uint64_t ordinal : index_.find_in_force(head.value(), next().first)) {
      recording_.seek(ordinal);
      if (const auto* definition = recording_.next()) sink(*definition);
    }
  }
  recording_.seek(first_ordinal());
}

void Tape::play_rest(const Sink& sink) {
  if (!clips_.back().to_end || clips_.back().end != index_.frames().size()) return;
  while (const recording::RecordedMessage* message = recording_.next()) sink(*message);
}

void Tape::play_last_again(const Sink& sink) {
  const std::uint64_t here = recording_.ordinal();
  const recording::FrameEntry& frame = index_.frames()[played_];
  recording_.seek(frame.first);
  while (recording_.ordinal() <= frame.last) {
    const recording::RecordedMessage* message = recording_.next();
    if (message == nullptr) break;
    if (message->topic == wire::TopicId::frames) sink(*message);
  }
  recording_.seek(here);
}

}  // namespace flexcast::replay
