#include "core/sim/velocity_track.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"

namespace flexcast {
namespace {

constexpr std::int64_t block = 3 * 1024;
using Weights = std::array<std::array<double, 4>, 4>;  // of derivative k: of point i, the newest first

// Newton's divided differences, times k!: exact for polynomials of the degree k.
Weights calc_weights(const std::array<double, 4>& times, std::size_t count) {
  Weights weights{};
  Weights differences{};
  for (std::size_t i = 0; i < count; ++i) differences[i][i] = 1.0;
  weights[0] = differences[0];
  double factorial = 1.0;
  for (std::size_t k = 1; k < count; ++k) {
    factorial *= static_cast<double>(k);
    for (std::size_t i = 0; i + k < count; ++i) {
      for (std::size_t j = 0; j < count; ++j)
        differences[i][j] = (differences[i][j] - differences[i + 1][j]) / (times[i] - times[i + k]);
    }
    for (std::size_t j = 0; j < count; ++j) weights[k][j] = factorial * differences[0][j];
  }
  return weights;
}

Vec3 calc_mean(const VecX& vectors) {
  return Eigen::Map<const Eigen::Matrix3Xd>(vectors.data(), 3, vectors.size() / 3).rowwise().mean();
}

}  // namespace

void VelocityTrack::begin(double time, const VecX& velocities) {
  for (Point& point : points_) point.velocities.resize(velocities.size());
  count_ = 0;
  observe(time, velocities);
}

void VelocityTrack::observe(double time, const VecX& velocities) {
  newest_ = (newest_ + 1) % size;
  points_[newest_].time = time;
  points_[newest_].velocities = velocities;
  count_ = std::min(count_ + 1, size);
}

VelocityDerivatives VelocityTrack::calc_derivatives() const {
  VelocityDerivatives derivatives;
  derivatives.known = static_cast<int>(count_);
  if (count_ == 0) return derivatives;
  std::array<double, size> times{};
  std::array<const double*, size> data{};
  for (std::size_t i = 0; i < size; ++i) {
    const Point& at = point(std::min(i, count_ - 1));
    times[i] = at.time;
    data[i] = at.velocities.data();
  }
  const Weights weights = calc_weights(times, count_);
  const std::int64_t dofs = point(0).velocities.size();
  const Vec3 mean = calc_mean(point(0).velocities);
  partial_.assign(static_cast<std::size_t>((dofs + block - 1) / block), {});
  parallel_for(static_cast<std::int64_t>(partial_.size()), 1, [&](std::int64_t first, std::int64_t end) {
    for (std::int64_t b = first; b < end; ++b) {
      std::array<double, size> sums{};
      for (std::int64_t i = b * block; i < std::min(dofs, (b + 1) * block); ++i) {
        const double own = data[0][i] - mean[i % 3];
        sums[0] += own * own;
        for (std::size_t k = 1; k < count_; ++k) {
          double value = 0.0;
          for (std::size_t j = 0; j <= k; ++j) value += weights[k][j] * data[j][i];
          sums[k] += value * value;
        }
      }
      partial_[static_cast<std::size_t>(b)] = sums;
    }
  });
  for (const auto& sums : partial_) {
    for (std::size_t k = 0; k < count_; ++k) derivatives.rms[k] += sums[k];
  }
  for (double& value : derivatives.rms) value = std::sqrt(3.0 * value / static_cast<double>(dofs));
  return derivatives;
}

VecX VelocityTrack::save() const {
  const Eigen::Index dofs = count_ > 0 ? point(0).velocities.size() : 0;
  VecX saved(1 + static_cast<Eigen::Index>(count_) * (1 + dofs));
  saved[0] = static_cast<double>(count_);
  for (std::size_t age = 0; age < count_; ++age) {
    const Eigen::Index first = 1 + static_cast<Eigen::Index>(age) * (1 + dofs);
    saved[first] = point(age).time;
    saved.segment(first + 1, dofs) = point(age).velocities;
  }
  return saved;
}

bool VelocityTrack::restore(const VecX& saved, Eigen::Index dofs) {
  if (saved.size() == 0 || !(saved[0] >= 1.0 && saved[0] <= most) || saved[0] != std::floor(saved[0])) return false;
  const auto count = static_cast<Eigen::Index>(saved[0]);
  if (saved.size() != 1 + count * (1 + dofs) || !saved.allFinite()) return false;
  for (Eigen::Index age = count - 1; age >= 0; --age) {
    const Eigen::Index first = 1 + age * (1 + dofs);
    if (age < count - 1 && !(saved[first] > points_[newest_].time)) return false;
    if (age == count - 1) {
      begin(saved[first], saved.segment(first + 1, dofs));
    } else {
      observe(saved[first], saved.segment(first + 1, dofs));
    }
  }
  return true;
}

}  // namespace flexcast
