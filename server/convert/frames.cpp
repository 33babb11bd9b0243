#include "server/convert/frames.h"

#include <algorithm>

#include "core/sim/chunks.h"
#include "core/sim/frame_size.h"
#include "idl/wire/fill.h"

namespace flexcast::server {
namespace {

// Lets a sequence show a run of particles that have `each` numbers; of an empty array nothing.
template <class Sequence, class Array>
void view_run(Sequence& sequence, const Array& numbers, const ChunkRun& run, std::size_t each) {
  const std::span all(numbers.data(), numbers.size());
  wire::view(sequence, all.empty() ? all : all.subspan(each * run.first, each * run.count));
}

}  // namespace

FrameMessage::FrameMessage(std::string_view world) {
  wire::set_string(message_->world, world);
}

void FrameMessage::assign(const Frame& frame) {
  const FrameHeader& header = frame.header;
  message_->run_id = header.run_id;
  message_->frame = header.frame;
  message_->step = static_cast<std::uint64_t>(header.step);
  message_->time = header.time;
  message_->parameter_revision = header.parameter_revision;
  message_->topology_revision = header.topology_revision;
  message_->state_hash = frame.state_hash;
  message_->chunks = calc_frame_size(frame.particles, header.format).chunks;
  message_->total = frame.particles;
  payload_ = &frame.payload;
  std::copy(payload_->bounds.begin(), payload_->bounds.end(), message_->bounds);
}

const flexcast_ParticleFrame& FrameMessage::chunk(std::uint32_t chunk) {
  const ChunkRun run = chunk_run(message_->total, chunk, message_->chunks);
  message_->chunk = chunk;
  message_->first = static_cast<std::uint32_t>(run.first);
  view_run(message_->positions, payload_->positions, run, 3);
  view_run(message_->velocities, payload_->velocities, run, 3);
  view_run(message_->positions64, payload_->positions64, run, 3);
  view_run(message_->velocities64, payload_->velocities64, run, 3);
  view_run(message_->positions16, payload_->positions16, run, 3);
  view_run(message_->stretch, payload_->stretch, run, 1);
  view_run(message_->stress, payload_->stress, run, 1);
  return *message_;
}

}  // namespace flexcast::server
