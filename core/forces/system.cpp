#include "core/forces/system.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "core/forces/force_table.h"
#include "core/forces/friction.h"

namespace flexcast {
namespace {

constexpr std::int64_t copy_grain = 1 << 14;  // numbers

void assign(const VecX& from, VecX& to) {
  to.resize(from.size());
  parallel_for(from.size(), copy_grain, [&](std::int64_t first, std::int64_t end) {
    std::copy(from.data() + first, from.data() + end, to.data() + first);
  });
}

}  // namespace

System::System(const Model& model) : model_(model) {
  for (const ForceRow& row : force_rows()) row.make(model, forces_);
  const Eigen::Map<const Eigen::Matrix3Xd> rest(model.rest_positions.data(), 3, model.particle_count());
  if (rest.cols() > 0) size_ = (rest.rowwise().maxCoeff() - rest.rowwise().minCoeff()).norm();
  refresh();
}

void System::refresh() {
  refresh_inertia();
  refresh_forces();
  stiffness_norm_.reset();
}

void System::refresh_inertia() {
  const std::int64_t n = model_.particle_count();
  dof_masses_.resize(3 * n);
  inverse_masses_.resize(3 * n);
  free_.resize(3 * n);
  for (std::int64_t i = 0; i < 3 * n; ++i) {
    dof_masses_[i] = model_.masses[i / 3];
    free_[i] = model_.fixed[static_cast<std::size_t>(i)] ? 0.0 : 1.0;
  }
  for (const Handle& handle : model_.handles) {
    for (const std::int32_t particle : handle.particles) block3(free_, particle).setZero();
  }
  inverse_masses_ = free_.cwiseQuotient(dof_masses_);
}

void System::refresh_forces() {
  if (!model_.obstacles.empty()) {
    std::vector<ModeBound> elastic(model_.bodies.size());
    for (const auto& force : forces_) {
      if (force->energy_kind() == EnergyKind::elastic && force->is_active())
        elastic[static_cast<std::size_t>(force->body())] = force->calc_mode_bound();
    }
    for (const auto& force : forces_) force->follow_parameters(elastic);
  }
  active_.clear();
  varying_.clear();
  has_damping_ = has_friction_ = false;
  constant_.setZero(dofs());
  for (const auto& force : forces_) {
    if (!force->is_active()) continue;
    active_.push_back(force.get());
    has_damping_ = has_damping_ || force->has_damping();
    has_friction_ = has_friction_ || force->has_friction();
    if (force->is_constant()) {
      force->add_conservative(dof_masses_, constant_);  // any positions will do
    } else {
      varying_.push_back(force.get());
    }
  }
}

double System::calc_force(const VecX& x, const VecX& v, VecX& f) const {
  assign(constant_, f);
  double power = 0.0;
  for (const Force* force : varying_) power += force->add_force(x, v, f);
  return power;
}

void System::calc_conservative(const VecX& x, VecX& f) const {
  assign(constant_, f);
  for (const Force* force : varying_) force->add_conservative(x, f);
}

double System::calc_damping(const VecX& x, const VecX& v, VecX& f) const {
  f.setZero(dofs());
  double power = 0.0;
  for (const Force* force : varying_) {
    if (force->has_damping()) power += force->add_damping(x, v, f);
  }
  return power;
}

void System::calc_position_dependent(const VecX& x, VecX& f) const {
  f.setZero(dofs());
  for (const Force* force : varying_) force->add_conservative(x, f);
}

double System::calc_energy(EnergyKind kind, const VecX& x) const {
  double energy = 0.0;
  for (const Force* force : active_) {
    if (force->energy_kind() == kind) energy += force->calc_energy(x);
  }
  return energy;
}

double System::calc_potential(const VecX& x) const {
  double energy = 0.0;
  for (const Force* force : active_) energy += force->calc_energy(x);
  return energy;
}

double System::calc_kinetic(const VecX& v) const {
  return 0.5 * v.dot(dof_masses_.cwiseProduct(v));
}

double System::calc_position_dependent_energy(const VecX& x) const {
  double energy = 0.0;
  for (const Force* force : varying_) energy += force->calc_energy(x);
  return energy;
}

std::vector<std::pair<std::int32_t, std::int32_t>> System::make_couplings() const {
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  for (const auto& force : forces_) force->add_couplings(pairs);
  return pairs;
}

BlockMatrix System::make_matrix() const {
  if (!pattern_) {
    pattern_ = std::make_shared<BlockPattern>(static_cast<std::int32_t>(model_.particle_count()), make_couplings());
  }
  return BlockMatrix(pattern_);
}

void System::add_stiffness(const VecX& x, double scale, Tangent kind, BlockMatrix& A) const {
  for (const Force* force : active_) force->add_stiffness(x, scale, kind, A);
}

void System::add_damping_matrix(const VecX& x, double scale, BlockMatrix& A) const {
  for (const Force* force : active_) {
    if (force->has_damping()) force->add_damping_matrix(x, scale, A);
  }
}

void System::prescribe(double time, VecX& x, VecX& v) const {
  for (const Handle& handle : model_.handles) {
    const HandleMotion motion = calc_motion(handle, time);
    for (std::size_t i = 0; i < handle.particles.size(); ++i) {
      block3(x, handle.particles[i]) = motion.calc_position(handle.base[i]);
      block3(v, handle.particles[i]) = motion.calc_velocity(handle.base[i]);
    }
  }
}

void System::find_friction_points(const VecX& x, std::vector<FrictionPoint>& points) const {
  points.clear();
  for (const Force* force : varying_) {
    if (force->has_friction()) force->add_friction_points(x, points);
  }
}

void System::apply_friction(double h, std::span<const FrictionPoint> points, const VecX& F, VecX& v,
                            StepStatistics& statistics) const {
  for (std::size_t first = 0, end = 0; first < points.size(); first = end) {
    const std::int32_t particle = points[first].particle;
    while (end < points.size() && points[end].particle == particle) ++end;
    const Vec3 w = block3(inverse_masses_, particle);
    const Vec3 before = block3(v, particle);
    Vec3 now = before;
    for (std::size_t k = first; k < end; ++k) {
      const Vec3 sliding = calc_tangential(points[k], now).cwiseProduct(block3(free_, particle));
      const double speed = sliding.norm();
      if (speed > 0.0) now -= std::min(1.0, points[k].limit * h * w.maxCoeff() / speed) * sliding;
    }
    block3(v, particle) = now;
    const Vec3 impulse = model_.masses[particle] * (now - before);  // N.s
    const Vec3 start = before - h * w.cwiseProduct(block3(F, particle));
    statistics.dissipated -= 0.5 * impulse.dot(before + now);
    // Its own work, and that of F along the new velocity instead of the old one.
    statistics.force_work += 0.5 * impulse.dot(start + now) + 0.5 * h * block3(F, particle).dot(now - before);
  }
}

void System::find_free_bodies(std::vector<const Body*>& bodies) const {
  bodies.clear();
  if (!model_.obstacles.empty()) return;
  for (const Body& body : model_.bodies) {
    const auto inside = [&](std::int32_t i) { return i >= body.particles.first && i < body.particles.end(); };
    const bool held =
        (free_.segment(3 * body.particles.first, 3 * body.particles.count).array() == 0.0).any() ||
        std::any_of(model_.grabs.begin(), model_.grabs.end(), [&](const Grab& grab) { return inside(grab.particle); });
    if (!held) bodies.push_back(&body);
  }
}

std::vector<ModeBound> System::calc_mode_bounds() const {
  // A body has one elastic force; what damps, touches or pulls acts on top of it.
  std::vector<ModeBound> bounds(model_.bodies.size());
  for (const Force* force : active_) {
    const ModeBound one = force->calc_mode_bound();
    for (std::size_t b = 0; b < bounds.size(); ++b) {
      if (force->body() >= 0 && static_cast<std::size_t>(force->body()) != b) continue;
      bounds[b].omega_squared += one.omega_squared;
      bounds[b].damping_rate += one.damping_rate;
      bounds[b].least_damping_rate += one.least_damping_rate;
    }
  }
  return bounds;
}

double System::stiffness_norm() const {
  if (!stiffness_norm_) stiffness_norm_ = calc_stiffness_norm();
  return *stiffness_norm_;
}

double System::calc_stiffness_norm() const {
  const std::vector<ModeBound> bounds = calc_mode_bounds();
  double sum = 0.0;
  for (std::size_t b = 0; b < bounds.size(); ++b) {
    const IndexRange particles = model_.bodies[b].particles;
    sum += dof_masses_.segment(3 * particles.first, 3 * particles.count).squaredNorm() * bounds[b].omega_squared *
           bounds[b].omega_squared;
  }
  return std::sqrt(sum);
}

}  // namespace flexcast
