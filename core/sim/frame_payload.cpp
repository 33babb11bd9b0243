#include "core/sim/frame_payload.h"

#include <algorithm>

namespace flexcast {
namespace {

constexpr double most_quanta = 65535.0;

std::array<double, 6> calc_bounds(const VecX& positions) {
  std::array<double, 6> bounds = {};
  if (positions.size() == 0) return bounds;
  Vec3 low = block3(positions, 0);
  Vec3 high = low;
  for (std::int64_t i = 1; i < positions.size() / 3; ++i) {
    low = low.cwiseMin(block3(positions, i));
    high = high.cwiseMax(block3(positions, i));
  }
  std::copy_n(low.data(), 3, bounds.begin());
  std::copy_n(high.data(), 3, bounds.begin() + 3);
  return bounds;
}

void to_floats(const VecX& numbers, bool wanted, std::vector<float>& floats) {
  floats.resize(wanted ? static_cast<std::size_t>(numbers.size()) : 0);
  for (std::size_t i = 0; i < floats.size(); ++i) {
    floats[i] = static_cast<float>(numbers[static_cast<Eigen::Index>(i)]);
  }
}

std::span<const double> view(const VecX& numbers, bool wanted) {
  return wanted ? std::span(numbers.data(), static_cast<std::size_t>(numbers.size())) : std::span<const double>();
}

// The fraction is in [0, 1] even where the extent is too small for a reciprocal.
void quantize(const VecX& positions, const std::array<double, 6>& bounds, bool wanted,
              std::vector<std::uint16_t>& fractions) {
  fractions.resize(wanted ? static_cast<std::size_t>(positions.size()) : 0);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double low = bounds[axis], extent = bounds[axis + 3] - low;
    for (std::size_t i = axis; i < fractions.size(); i += 3) {
      const double fraction = extent > 0.0 ? (positions[static_cast<Eigen::Index>(i)] - low) / extent : 0.0;
      fractions[i] = static_cast<std::uint16_t>(fraction * most_quanta + 0.5);
    }
  }
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

void fill_payload(const FrameSource& source, const StreamFormat& format, FramePayload& payload) {
  using enum StreamPrecision;
  const bool doubles = format.precision == float64;
  payload.bounds = calc_bounds(source.positions);
  to_floats(source.positions, format.positions && format.precision == float32, payload.positions);
  to_floats(source.velocities, format.velocities && !doubles, payload.velocities);
  payload.positions64 = view(source.positions, format.positions && doubles);
  payload.velocities64 = view(source.velocities, format.velocities && doubles);
  quantize(source.positions, payload.bounds, format.positions && format.precision == quantized16, payload.positions16);
  to_floats(source.stretch, format.stretch, payload.stretch);
  to_floats(source.stress, format.stress, payload.stress);
}

VecX decode_positions(const FramePayload& payload) {
  if (!payload.positions16.empty()) return dequantize(payload.positions16, payload.bounds);
  if (!payload.positions64.empty()) return widen(payload.positions64);
  return widen(std::span<const float>(payload.positions));
}

}  // namespace flexcast
