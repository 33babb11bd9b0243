// LockstepRecorder: takes a world's frames one by one and tells the server what it has in hand, as a recorder in
// lockstep does. It queues no more than a server may be ahead of it, so one that does not wait runs away from it.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <utility>

#include "idl/wire/fill.h"
#include "idl/wire/reader.h"
#include "idl/wire/writer.h"

namespace flexcast::test {

class LockstepRecorder {
 public:
  struct Taken {
    std::uint64_t run_id = 0;
    std::uint64_t frame = 0;
    std::uint64_t state_hash = 0;
  };

  LockstepRecorder(const wire::Participant& participant, std::string world, const std::string& id)
      : world_(std::move(world)),
        frames_(wire::Reader<flexcast_ParticleFrame>::create(participant, {.depth = 0, .max_samples = queue}).value()),
        writer_(wire::Writer<flexcast_RecorderInfo>::create(participant).value()) {
    wire::set_string(info_->world, world_);
    wire::set_string(info_->recorder_id, id);
    info_->lockstep = true;
    tell(flexcast_RECORDER_WAITING);
  }

  // The next frame of the world that is newer than the last; none within the timeout. It is not in hand yet.
  std::optional<Taken> next(std::chrono::nanoseconds timeout) {
    const auto limit = std::chrono::steady_clock::now() + timeout;
    while (std::chrono::steady_clock::now() < limit) {
      frames_.wait(std::chrono::milliseconds(50));
      const auto samples = frames_.take(1);
      for (const auto [frame, info] : samples.value()) {
        if (!info.valid || wire::text(frame.world) != world_ || !is_newer(frame)) continue;
        newest_ = {frame.run_id, frame.frame, frame.state_hash};
        return newest_;
      }
    }
    return std::nullopt;
  }

  // The frame and all before it are in hand.
  void acknowledge(const Taken& taken) {
    info_->run_id = taken.run_id;
    info_->next_frame = taken.frame + 1;
    tell(flexcast_RECORDER_RECORDING);
  }

  void tell(flexcast_RecorderState state) {
    info_->state = state;
    (void)writer_.write(*info_);
  }
  void dispose() const { (void)writer_.dispose(*info_); }

 private:
  // Never full while the server waits: a full reader blocks every other of its process, and its own deletion.
  static constexpr std::int32_t queue = 64;

  bool is_newer(const flexcast_ParticleFrame& frame) const {
    return !newest_ || frame.run_id > newest_->run_id ||
           (frame.run_id == newest_->run_id && frame.frame > newest_->frame);
  }

  std::string world_;
  wire::Reader<flexcast_ParticleFrame> frames_;
  wire::Writer<flexcast_RecorderInfo> writer_;
  wire::Owned<flexcast_RecorderInfo> info_;
  std::optional<Taken> newest_;
};

}  // namespace flexcast::test
