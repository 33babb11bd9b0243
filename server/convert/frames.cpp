#include "server/convert/frames.h"

#include <algorithm>

#include "core/sim/state_hash.h"
#include "idl/wire/fill.h"
#include "server/convert/chunks.h"

namespace flexcast::server {
namespace {

void to_floats(const VecX& numbers, bool wanted, std::vector<float>& floats) {
  floats.resize(wanted ? static_cast<std::size_t>(numbers.size()) : 0);
  for (std::size_t i = 0; i < floats.size(); ++i) {
    floats[i] = static_cast<float>(numbers[static_cast<Eigen::Index>(i)]);
  }
}

std::size_t calc_particle_bytes(const StreamFormat& format) {
  const std::size_t vectors = (format.positions ? 1 : 0) + (format.velocities ? 1 : 0);
  return vectors * 3 * (format.doubles ? sizeof(double) : sizeof(float));
}

void fill_bounds(const VecX& positions, double (&bounds)[6]) {
  if (positions.size() == 0) return;
  Vec3 low = block3(positions, 0);
  Vec3 high = low;
  for (std::int64_t i = 1; i < positions.size() / 3; ++i) {
    low = low.cwiseMin(block3(positions, i));
    high = high.cwiseMax(block3(positions, i));
  }
  std::copy_n(low.data(), 3, bounds);
  std::copy_n(high.data(), 3, bounds + 3);
}

// A run of particles of a flat array; of an empty one nothing.
template <class T>
std::span<const T> slice(std::span<const T> flat, const ChunkRun& particles) {
  return flat.empty() ? flat : flat.subspan(3 * particles.first, 3 * particles.count);
}

}  // namespace

FrameSize calc_frame_size(std::int64_t particles, const StreamFormat& format) {
  const auto count = static_cast<std::size_t>(particles);
  const std::size_t particle_bytes = calc_particle_bytes(format);
  const std::uint32_t chunks = count_chunks(count, particle_bytes);
  return {count * particle_bytes + chunks * chunk_overhead, chunks};
}

FrameMessage::FrameMessage(std::string_view world) {
  wire::set_string(message_->world, world);
}

void FrameMessage::assign(const Frame& frame) {
  frame_ = &frame;
  const FrameHeader& header = frame.header;
  const auto particles = static_cast<std::size_t>(frame.positions.size()) / 3;
  message_->run_id = header.run_id;
  message_->frame = header.frame;
  message_->step = static_cast<std::uint64_t>(header.step);
  message_->time = header.time;
  message_->parameter_revision = header.parameter_revision;
  message_->topology_revision = header.topology_revision;
  message_->state_hash = calc_state_hash(header.step, frame.positions, frame.velocities);
  message_->chunks = calc_frame_size(static_cast<std::int64_t>(particles), header.format).chunks;
  message_->total = static_cast<std::uint32_t>(particles);
  fill_bounds(frame.positions, message_->bounds);
  to_floats(frame.positions, header.format.positions && !header.format.doubles, positions_);
  to_floats(frame.velocities, header.format.velocities && !header.format.doubles, velocities_);
}

const flexcast_ParticleFrame& FrameMessage::chunk(std::uint32_t chunk) {
  const StreamFormat& format = frame_->header.format;
  const auto doubles = [&](const VecX& numbers, bool wanted) {
    return wanted && format.doubles ? std::span<const double>(numbers.data(), static_cast<std::size_t>(numbers.size()))
                                    : std::span<const double>();
  };
  const ChunkRun run = chunk_run(message_->total, chunk, message_->chunks);
  message_->chunk = chunk;
  message_->first = static_cast<std::uint32_t>(run.first);
  wire::view(message_->positions, slice(std::span<const float>(positions_), run));
  wire::view(message_->velocities, slice(std::span<const float>(velocities_), run));
  wire::view(message_->positions64, slice(doubles(frame_->positions, format.positions), run));
  wire::view(message_->velocities64, slice(doubles(frame_->velocities, format.velocities), run));
  return *message_;
}

}  // namespace flexcast::server
