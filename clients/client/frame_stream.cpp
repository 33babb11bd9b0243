#include "clients/client/frame_stream.h"

#include <algorithm>

#include "clients/client/clock.h"
#include "idl/wire/fill.h"

namespace flexcast::client {

FrameStream::FrameStream(std::shared_ptr<const wire::Participant> participant,
                         wire::Reader<flexcast_ParticleFrame> reader, std::string world)
    : participant_(std::move(participant)), reader_(std::move(reader)), world_(std::move(world)) {}

void FrameStream::take() {
  const auto samples = reader_.take();
  if (!samples) return;
  for (const auto [sample, info] : samples.value()) {
    if (!info.valid || wire::text(sample.world) != world_) continue;
    if (auto frame = assembler_.add(sample)) ready_.push_back(std::move(*frame));
  }
}

std::optional<Frame> FrameStream::next(std::chrono::nanoseconds timeout) {
  const Deadline deadline(timeout);
  for (;;) {
    if (ready_.empty()) take();
    if (!ready_.empty()) {
      Frame frame = std::move(ready_.front());
      ready_.pop_front();
      return frame;
    }
    if (deadline.passed()) return {};
    reader_.wait(deadline.left());
  }
}

Result<Frame> FrameStream::wait_for_frame(const std::function<bool(const Frame&)>& wanted,
                                          std::chrono::nanoseconds timeout) {
  const Deadline deadline(timeout);
  std::string seen = "there was none";
  while (auto frame = next(deadline.left())) {
    if (wanted(*frame)) return std::move(*frame);
    seen = "the last one was frame " + std::to_string(frame->frame) + ", step " + std::to_string(frame->step);
    if (deadline.passed()) break;
  }
  return Error{"no such frame of world '" + world_ + "' within " + seconds_text(timeout) + ": " + seen};
}

}  // namespace flexcast::client
