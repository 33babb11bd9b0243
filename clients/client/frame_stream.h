// FrameStream: the frames of one world, for monitors and integration tests.
#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "clients/client/frame.h"
#include "clients/client/value.h"
#include "idl/wire/reader.h"

namespace flexcast::client {

enum class Keep {
  every,   // all frames, in order; a reader that lags by more than 256 MiB loses some (missed() counts)
  newest,  // whatever is newest when asked
};

// Frames are those published after the stream began, and the one before if the world stands still. Use from one thread
// at a time.
class FrameStream {
 public:
  // Through Connection::frames().
  FrameStream(std::shared_ptr<const wire::Participant> participant, wire::Reader<flexcast_ParticleFrame> reader,
              std::string world);

  // The next frame; none within the timeout. Zero: only what is here already.
  std::optional<Frame> next(std::chrono::nanoseconds timeout);

  // The first frame for which `wanted` is true; those before it are passed over. The error says how long it waited and
  // what it saw last.
  Result<Frame> wait_for_frame(const std::function<bool(const Frame&)>& wanted, std::chrono::nanoseconds timeout);

  // Frames of the present run that are missing between those that came: not published, or lost.
  std::uint64_t missed() const { return assembler_.missed(); }

 private:
  void take();

  std::shared_ptr<const wire::Participant> participant_;  // shared: the stream may outlive its connection
  wire::Reader<flexcast_ParticleFrame> reader_;
  std::string world_;
  FrameAssembler assembler_;
  std::deque<Frame> ready_;
};

}  // namespace flexcast::client
