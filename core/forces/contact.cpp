#include "core/forces/contact.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"

namespace flexcast {
namespace {

struct Touch {
  double depth = 0.0;          // m, <= 0: none
  Vec3 normal = Vec3::Zero();  // of unit length, out of the obstacle
  double curvature = 0.0;      // 1/m, of the surface: 1/distance from a sphere's centre
};

Touch find_touch_of_box(const Obstacle& box, const Vec3& x) {
  Touch touch;
  touch.depth = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const double depth = side < 0.0 ? x[axis] - box.lo[axis] : box.hi[axis] - x[axis];
      if (depth < touch.depth) touch = {depth, side * Vec3::Unit(axis), 0.0};
    }
  }
  return touch;
}

// `normal`: the plane's, of unit length.
Touch find_touch(const Obstacle& obstacle, const Vec3& normal, const Vec3& x) {
  switch (obstacle.shape) {
    case Obstacle::Shape::plane:
      return {-normal.dot(x - obstacle.point), normal, 0.0};
    case Obstacle::Shape::sphere: {
      const Vec3 d = x - obstacle.center;
      const double distance = d.norm();
      if (distance >= obstacle.radius) return {};
      if (distance == 0.0) return {obstacle.radius, Vec3::UnitZ(), 0.0};
      return {obstacle.radius - distance, d / distance, 1.0 / distance};
    }
    case Obstacle::Shape::box:
      return find_touch_of_box(obstacle, x);
  }
  return {};
}

class Contact final : public Force {
 public:
  explicit Contact(const Model& model) : model_(model) {}

  bool is_active() const override { return true; }
  EnergyKind energy_kind() const override { return EnergyKind::contact; }

  void follow_parameters(std::span<const ModeBound> elastic) override {
    const Eigen::Map<const Eigen::Matrix3Xd> rest(model_.rest_positions.data(), 3, model_.particle_count());
    const double size = (rest.rowwise().maxCoeff() - rest.rowwise().minCoeff()).norm();
    const double by_weight = 1e4 * model_.gravity.norm() / (size > 0.0 ? size : 1.0);
    chosen_rates_.clear();
    for (const ModeBound& bound : elastic) chosen_rates_.push_back(std::max(0.25 * bound.omega_squared, by_weight));
    for (double& rate : chosen_rates_) {
      if (rate == 0.0) rate = 1e4;
    }
    normals_.clear();
    for (const Obstacle& obstacle : model_.obstacles) normals_.push_back(obstacle.normal.stableNormalized());
  }

  void add_conservative(const VecX& x, VecX& f) const override {
    for_bodies([&](const Body& body, double rate) {
      parallel_for(body.particles.count, grain, [&](std::int64_t first, std::int64_t end) {
        for_touches_in(body, rate, first, end, x,
                       [&](std::int32_t particle, const Touch& touch, double k, const Obstacle&) {
                         block3(f, particle) += k * touch.depth * touch.normal;
                       });
      });
    });
  }

  double calc_energy(const VecX& x) const override {
    double energy = 0.0;
    for_bodies([&](const Body& body, double rate) {
      energy += parallel_sum(body.particles.count, grain, partial_, [&](std::int64_t first, std::int64_t end) {
        double sum = 0.0;
        for_touches_in(body, rate, first, end, x, [&](std::int32_t, const Touch& touch, double k, const Obstacle&) {
          sum += 0.5 * k * touch.depth * touch.depth;
        });
        return sum;
      });
    });
    return energy;
  }

  void add_stiffness(const VecX& x, double scale, Tangent kind, BlockMatrix& A) const override {
    for_touches(x, [&](std::int32_t particle, const Touch& touch, double k, const Obstacle&) {
      A.add(particle, particle, scale * calc_block(touch, k, kind));
    });
  }

  void add_blocks(const VecX& x, std::span<const std::int32_t> particles, std::span<Vec3> f,
                  std::span<Mat3> K) const override {
    for_bodies([&](const Body& body, double rate) {
      for (std::size_t i = 0; i < particles.size(); ++i) {
        if (particles[i] < body.particles.first || particles[i] >= body.particles.end()) continue;
        for_touches_of(particles[i], rate, x, [&](std::int32_t, const Touch& touch, double k, const Obstacle&) {
          f[i] += k * touch.depth * touch.normal;
          K[i] += calc_block(touch, k, Tangent::positive_semidefinite);
        });
      }
    });
  }

  // One-sided: C = -depth, with the push k as its stiffness. A particle keeps four numbers for each obstacle: the
  // multiplier, and how far friction has moved it (m).
  std::int64_t constraint_count() const override {
    return 4 * model_.particle_count() * static_cast<std::int64_t>(model_.obstacles.size());
  }
  void sweep_constraints(const ConstraintSweep& sweep, std::span<double> lambda, VecX& u) const override;

  bool has_friction() const override {
    return std::any_of(model_.obstacles.begin(), model_.obstacles.end(),
                       [](const auto& o) { return o.friction > 0.0; });
  }
  void add_friction_points(const VecX& x, std::vector<FrictionPoint>& points) const override {
    points.reserve(static_cast<std::size_t>(model_.particle_count()));  // so that touching more allocates no more
    for_touches(x, [&](std::int32_t particle, const Touch& touch, double k, const Obstacle& obstacle) {
      const double limit = obstacle.friction * k * touch.depth;
      if (limit > 0.0) points.push_back({particle, touch.normal, limit});
    });
  }

  ModeBound calc_mode_bound() const override {
    ModeBound bound;
    for_bodies([&](const Body& body, double rate) {
      for (std::int32_t i = body.particles.first; i < body.particles.end(); ++i) {
        double sum = 0.0;
        for (const Obstacle& obstacle : model_.obstacles) sum += stiffness(obstacle, rate, i) / model_.masses[i];
        bound.omega_squared = std::max(bound.omega_squared, sum);
      }
    });
    return bound;
  }

 private:
  double stiffness(const Obstacle& obstacle, double rate, std::int32_t particle) const {
    return obstacle.stiffness > 0.0 ? obstacle.stiffness : rate * model_.masses[particle];
  }

  static Mat3 calc_block(const Touch& touch, double k, Tangent kind) {
    const Mat3 nn = touch.normal * touch.normal.transpose();
    if (kind == Tangent::positive_semidefinite) return k * nn;
    return k * nn - k * touch.depth * touch.curvature * (Mat3::Identity() - nn);
  }

  template <class Visit>
  void for_bodies(Visit visit) const {
    for (std::size_t b = 0; b < model_.bodies.size(); ++b) visit(model_.bodies[b], chosen_rates_[b]);
  }
  template <class Visit>
  void for_touches_of(std::int32_t particle, double rate, const VecX& x, Visit visit) const {
    for (std::size_t o = 0; o < model_.obstacles.size(); ++o) {
      const Obstacle& obstacle = model_.obstacles[o];
      const Touch touch = find_touch(obstacle, normals_[o], block3(x, particle));
      if (touch.depth > 0.0) visit(particle, touch, stiffness(obstacle, rate, particle), obstacle);
    }
  }
  // Of the body's particles [first, end).
  template <class Visit>
  void for_touches_in(const Body& body, double rate, std::int64_t first, std::int64_t end, const VecX& x,
                      Visit visit) const {
    for (std::int64_t i = first; i < end; ++i) {
      for_touches_of(body.particles.first + static_cast<std::int32_t>(i), rate, x, visit);
    }
  }
  template <class Visit>
  void for_touches(const VecX& x, Visit visit) const {
    for_bodies([&](const Body& body, double rate) { for_touches_in(body, rate, 0, body.particles.count, x, visit); });
  }

  static constexpr std::int64_t grain = 1024;  // particles

  const Model& model_;
  std::vector<double> chosen_rates_;     // 1/s^2, per body: stiffness over mass
  std::vector<Vec3> normals_;            // per obstacle, of unit length; of use for planes
  mutable std::vector<double> partial_;  // J, of blocks
};

void Contact::sweep_constraints(const ConstraintSweep& sweep, std::span<double> lambda, VecX& u) const {
  const std::size_t count = model_.obstacles.size();
  for_bodies([&](const Body& body, double rate) {
    for (std::int32_t i = body.particles.first; i < body.particles.end(); ++i) {
      const Vec3 w = block3(sweep.inverse_masses, i);
      for (std::size_t o = 0; o < count; ++o) {
        const std::size_t first = 4 * (static_cast<std::size_t>(i) * count + o);
        double& multiplier = lambda[first];
        Eigen::Map<Vec3> rubbed(&lambda[first + 1]);
        const Touch touch = find_touch(model_.obstacles[o], normals_[o], block3(sweep.start, i) + block3(u, i));
        if (!(touch.depth > 0.0) && multiplier == 0.0) continue;
        const double s = sweep.h * sweep.h * stiffness(model_.obstacles[o], rate, i);
        const Vec3 wn = w.cwiseProduct(touch.normal);
        const double unbounded = (s * touch.depth - multiplier) / (s * touch.normal.dot(wn) + 1.0);
        const double change = std::max(unbounded, -multiplier);  // it pushes, never pulls
        multiplier += change;
        block3(u, i) += change * wn;
        // Friction stops sliding with an impulse up to the coefficient times the normal one, over all sweeps.
        const Vec3 moved = block3(u, i) - rubbed;
        const Vec3 slid = w.cwiseSign().cwiseAbs().cwiseProduct(moved - touch.normal.dot(moved) * touch.normal);
        const double length = slid.norm();
        const double most = model_.obstacles[o].friction * multiplier * w.maxCoeff();
        const Vec3 held = length > 0.0 ? Vec3(-std::min(1.0, most / length) * slid) : Vec3(Vec3::Zero());
        block3(u, i) += held - rubbed;
        rubbed = held;
      }
    }
  });
}

}  // namespace

void make_contact(const Model& model, std::vector<std::unique_ptr<Force>>& forces) {
  if (!model.obstacles.empty()) forces.push_back(std::make_unique<Contact>(model));
}

}  // namespace flexcast
