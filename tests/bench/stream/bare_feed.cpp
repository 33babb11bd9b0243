#include "tests/bench/stream/bare_feed.h"

#include <span>

#include "core/sim/chunks.h"
#include "core/sim/frame_size.h"
#include "idl/wire/fill.h"
#include "tests/bench/stream/frame_tally.h"

namespace flexcast::bench {

BareFeed::BareFeed(const wire::Participant& participant, std::int64_t particles)
    : writer_(wire::Writer<flexcast_ParticleFrame>::create(
                  participant, wire::frames_writer_qos(static_cast<std::size_t>(12 * particles)))
                  .value()),
      positions_(static_cast<std::size_t>(3 * particles), 1.0f) {
  wire::set_string(frame_->world, "bare");
  frame_->chunks = calc_frame_size(particles, StreamFormat{}).chunks;
  frame_->total = static_cast<std::uint32_t>(particles);
}

void BareFeed::push() {
  frame_->time = monotonic_seconds();
  for (frame_->chunk = 0; frame_->chunk < frame_->chunks; ++frame_->chunk) {
    const ChunkRun run = chunk_run(frame_->total, frame_->chunk, frame_->chunks);
    wire::view(frame_->positions, std::span<const float>(positions_).subspan(3 * run.first, 3 * run.count));
    (void)writer_.write(*frame_);
  }
  ++frame_->frame;
}

}  // namespace flexcast::bench
