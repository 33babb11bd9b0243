#include "core/sim/frame_payload.h"

#include <algorithm>
#include <limits>
#include <span>

#include "core/sim/frame_kernels.h"

namespace flexcast {
namespace {

constexpr double most_quanta = 65535.0;
constexpr std::size_t block_numbers = 2040;  // whole particles and vectors; with their floats they fit the first cache

std::span<const double> all_of(const VecX& numbers) {
  return {numbers.data(), static_cast<std::size_t>(numbers.size())};
}

struct Wanted {
  bool floats = false, doubles = false;
};

// One pass: calls visit(block) for every block and converts it.
template <class Visit>
void convert(std::span<const double> numbers, Wanted wanted, std::vector<float>& floats, std::vector<double>& doubles,
             Visit visit) {
  floats.resize(wanted.floats ? numbers.size() : 0);
  doubles.resize(wanted.doubles ? numbers.size() : 0);
  for (std::size_t first = 0; first < numbers.size(); first += block_numbers) {
    const auto block = numbers.subspan(first, std::min(block_numbers, numbers.size() - first));
    visit(block);
    if (wanted.floats) convert_to_floats(block.data(), std::ssize(block), floats.data() + first);
    if (wanted.doubles) std::copy(block.begin(), block.end(), doubles.data() + first);
  }
}

void to_floats(const VecX& numbers, bool wanted, std::vector<float>& floats) {
  floats.resize(wanted ? static_cast<std::size_t>(numbers.size()) : 0);
  convert_to_floats(numbers.data(), std::ssize(floats), floats.data());
}

VecX dequantize(const std::vector<std::uint16_t>& fractions, const std::array<double, 6>& bounds) {
  VecX positions(static_cast<Eigen::Index>(fractions.size()));
  for (std::size_t i = 0; i < fractions.size(); ++i) {
    const double low = bounds[i % 3], high = bounds[i % 3 + 3];
    positions[static_cast<Eigen::Index>(i)] = low + (high - low) * (fractions[i] / most_quanta);
  }
  return positions;
}

template <class T>
VecX widen(std::span<const T> numbers) {
  VecX wide(static_cast<Eigen::Index>(numbers.size()));
  std::copy(numbers.begin(), numbers.end(), wide.data());
  return wide;
}

}  // namespace

void reserve_payload(std::int64_t particles, const StreamFormat& format, FramePayload& payload) {
  using enum StreamPrecision;
  const auto n = static_cast<std::size_t>(particles);
  const bool doubles = format.precision == float64;
  if (format.positions && format.precision == float32) payload.positions.reserve(3 * n);
  if (format.positions && doubles) payload.positions64.reserve(3 * n);
  if (format.positions && format.precision == quantized16) payload.positions16.reserve(3 * n);
  if (format.velocities) doubles ? payload.velocities64.reserve(3 * n) : payload.velocities.reserve(3 * n);
  if (format.stretch) payload.stretch.reserve(n);
  if (format.stress) payload.stress.reserve(n);
}

void fill_payload(const FrameSource& source, const StreamFormat& format, FramePayload& payload, StateHash* hash) {
  using enum StreamPrecision;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto positions = all_of(source.positions), velocities = all_of(source.velocities);
  const bool doubles = format.precision == float64;
  auto& bounds = payload.bounds;
  bounds = {infinity, infinity, infinity, -infinity, -infinity, -infinity};
  convert(positions, {format.positions && format.precision == float32, format.positions && doubles}, payload.positions,
          payload.positions64, [&](std::span<const double> block) {
            if (hash != nullptr) hash->add(block);
            widen_bounds(block.data(), std::ssize(block), &bounds[0], &bounds[3]);
          });
  if (positions.empty()) bounds = {};
  const bool quantized = format.positions && format.precision == quantized16;
  payload.positions16.resize(quantized ? positions.size() : 0);
  quantize(positions.data(), std::ssize(payload.positions16), &bounds[0], &bounds[3], payload.positions16.data());
  convert(velocities, {format.velocities && !doubles, format.velocities && doubles}, payload.velocities,
          payload.velocities64, [&](std::span<const double> block) {
            if (hash != nullptr) hash->add(block);
          });
  to_floats(source.stretch, format.stretch, payload.stretch);
  to_floats(source.stress, format.stress, payload.stress);
}

VecX decode_positions(const FramePayload& payload) {
  if (!payload.positions16.empty()) return dequantize(payload.positions16, payload.bounds);
  if (!payload.positions64.empty()) return widen(std::span<const double>(payload.positions64));
  return widen(std::span<const float>(payload.positions));
}

}  // namespace flexcast
