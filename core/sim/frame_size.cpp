#include "core/sim/frame_size.h"

#include <array>

#include "core/sim/chunks.h"

namespace flexcast {
namespace {

constexpr std::size_t cdr_header = 4;
constexpr std::size_t fixed_part = 124;  // up to the characters of the world's name, without the header

struct Sequence {
  std::size_t element = 4;  // bytes
  std::size_t numbers = 0;  // a particle; 0: empty
};

// In the order of the IDL.
std::array<Sequence, 7> list_sequences(const StreamFormat& format) {
  using enum StreamPrecision;
  const auto vectors = [](bool wanted) { return std::size_t{wanted ? 3u : 0u}; };
  const auto scalars = [](bool wanted) { return std::size_t{wanted ? 1u : 0u}; };
  const bool doubles = format.precision == float64;
  return {{{4, vectors(format.positions && format.precision == float32)},
           {4, vectors(format.velocities && !doubles)},
           {8, vectors(format.positions && doubles)},
           {8, vectors(format.velocities && doubles)},
           {2, vectors(format.positions && format.precision == quantized16)},
           {4, scalars(format.stretch)},
           {4, scalars(format.stress)}}};
}

std::size_t align(std::size_t at, std::size_t alignment) {
  return (at + alignment - 1) / alignment * alignment;
}

std::size_t calc_sample_bytes(std::size_t particles, const StreamFormat& format, std::size_t name_length) {
  std::size_t at = fixed_part + name_length + 1;
  for (const Sequence& sequence : list_sequences(format)) {
    at = align(at, 4) + 4;  // the count
    const std::size_t numbers = particles * sequence.numbers;
    if (numbers > 0) at = align(at, sequence.element) + numbers * sequence.element;
  }
  return cdr_header + align(at, 4);
}

}  // namespace

std::size_t calc_particle_bytes(const StreamFormat& format) {
  std::size_t bytes = 0;
  for (const Sequence& sequence : list_sequences(format)) bytes += sequence.numbers * sequence.element;
  return bytes;
}

FrameSize calc_frame_size(std::int64_t particles, const StreamFormat& format) {
  const auto count = static_cast<std::size_t>(particles);
  const std::size_t particle_bytes = calc_particle_bytes(format);
  const std::uint32_t chunks = count_chunks(count, particle_bytes);
  return {count * particle_bytes + chunks * chunk_overhead, chunks};
}

std::size_t calc_wire_bytes(std::int64_t particles, const StreamFormat& format, std::size_t name_length) {
  const auto count = static_cast<std::size_t>(particles);
  const std::uint32_t chunks = calc_frame_size(particles, format).chunks;
  std::size_t bytes = 0;
  for (std::uint32_t chunk = 0; chunk < chunks; ++chunk) {
    bytes += calc_sample_bytes(chunk_run(count, chunk, chunks).count, format, name_length);
  }
  return bytes;
}

}  // namespace flexcast
