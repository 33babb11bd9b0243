#include "core/forces/drag.h"

#include <algorithm>

#include "core/base/parallel.h"

namespace flexcast {
namespace {

class Drag final : public Force {
 public:
  Drag(const Model& model, std::size_t body) : model_(model), body_(model.bodies[body]) {}

  bool is_active() const override { return body_.mass_damping > 0.0 || body_.drag > 0.0; }
  bool has_damping() const override { return true; }
  void add_conservative(const VecX&, VecX&) const override {}

  double add_damping(const VecX&, const VecX& v, VecX& f) const override {
    return parallel_sum(body_.particles.count, 1024, partial_, [&](std::int64_t first, std::int64_t end) {
      return damp(body_.particles.first + first, body_.particles.first + end, v.data(), f.data());
    });
  }

  void add_damping_matrix(const VecX&, double scale, BlockMatrix& A) const override {
    for (std::int32_t i = body_.particles.first; i < body_.particles.end(); ++i) {
      A.add(i, i, scale * coefficient(i) * Mat3::Identity());
    }
  }

  void add_damping_blocks(const VecX&, const VecX& v, double scale, std::span<const std::int32_t> particles,
                          std::span<Vec3> f, std::span<Mat3> K) const override {
    for (std::size_t i = 0; i < particles.size(); ++i) {
      const std::int32_t particle = particles[i];
      if (particle < body_.particles.first || particle >= body_.particles.end()) continue;
      f[i] -= coefficient(particle) * block3(v, particle);
      K[i].diagonal().array() += scale * coefficient(particle);
    }
  }

  std::int32_t body() const override { return static_cast<std::int32_t>(&body_ - model_.bodies.data()); }
  ModeBound calc_mode_bound() const override {
    const auto masses = model_.masses.segment(body_.particles.first, body_.particles.count);
    return {0.0, body_.mass_damping + body_.drag / masses.minCoeff(),
            body_.mass_damping + body_.drag / masses.maxCoeff()};
  }

 private:
  // add_damping for particles [first, end). Four of them at a time, each number with a sum of its own, so that
  // additions need not wait for each other.
  double damp(std::int64_t first, std::int64_t end, const double* v, double* f) const {
    constexpr std::int64_t together = 4;
    const double of_mass = body_.mass_damping, constant = body_.drag, *masses = model_.masses.data();
    double power[3 * together] = {};
    std::int64_t i = first;
    for (; i + together <= end; i += together) {
      double force[3 * together], taken[3 * together];
      for (std::int64_t k = 0; k < 3 * together; ++k) {
        force[k] = (of_mass * masses[i + k / 3] + constant) * v[3 * i + k];
        taken[k] = force[k] * v[3 * i + k];
      }
      for (std::int64_t k = 0; k < 3 * together; ++k) f[3 * i + k] -= force[k];
      for (std::int64_t k = 0; k < 3 * together; ++k) power[k] += taken[k];
    }
    for (; i < end; ++i) {
      for (std::int64_t k = 0; k < 3; ++k) {
        const double force = coefficient(i) * v[3 * i + k];
        f[3 * i + k] -= force;
        power[k] += force * v[3 * i + k];
      }
    }
    double sum = 0.0;
    for (const double one : power) sum += one;
    return sum;
  }
  double coefficient(std::int64_t particle) const { return body_.mass_damping * model_.masses[particle] + body_.drag; }

  const Model& model_;
  const Body& body_;
  mutable std::vector<double> partial_;  // W, of blocks
};

}  // namespace

void make_drag(const Model& model, std::vector<std::unique_ptr<Force>>& forces) {
  for (std::size_t body = 0; body < model.bodies.size(); ++body) forces.push_back(std::make_unique<Drag>(model, body));
}

}  // namespace flexcast
