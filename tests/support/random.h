// Random numbers that are the same on every machine: SplitMix64 (Steele, Lea, Flood, OOPSLA 2014).
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/base/math.h"

namespace flexcast::test {

class SplitMix64 {
 public:
  explicit SplitMix64(std::uint64_t seed) : state_(seed) {}

  std::uint64_t next() {
    state_ += 0x9e3779b97f4a7c15ULL;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }

  // In [0, 1), from the top 53 bits.
  double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  // Standard normal (Box and Muller 1958).
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }

 private:
  std::uint64_t state_;
};

// Entries in [-size, size].
inline Vec3 make_random_vector(SplitMix64& random, double size = 1.0) {
  Vec3 v;
  for (int i = 0; i < 3; ++i) v[i] = random.uniform(-size, size);
  return v;
}

inline Mat3 make_random_matrix(SplitMix64& random, double size = 1.0) {
  Mat3 m;
  for (int i = 0; i < 9; ++i) m(i / 3, i % 3) = random.uniform(-size, size);
  return m;
}

inline VecX make_random_vector(SplitMix64& random, Eigen::Index count, double size) {
  VecX v(count);
  for (Eigen::Index i = 0; i < count; ++i) v[i] = random.uniform(-size, size);
  return v;
}

// Uniform over all rotations (a normalised Gaussian quaternion).
inline Mat3 make_random_rotation(SplitMix64& random) {
  Eigen::Quaterniond q;
  for (int i = 0; i < 4; ++i) q.coeffs()[i] = random.normal();
  return q.normalized().toRotationMatrix();
}

inline Mat3 make_rotation(const Vec3& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

}  // namespace flexcast::test
