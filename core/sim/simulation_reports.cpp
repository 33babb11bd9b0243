// What a simulation says of its present state.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "core/forces/system.h"
#include "core/integrators/integrator.h"
#include "core/sim/element_health.h"
#include "core/sim/simulation.h"
#include "core/sim/stable_step.h"
#include "core/sim/state_hash.h"

namespace flexcast {
namespace {

constexpr std::int64_t stable_step_lasts = 500;  // steps

}  // namespace

StepReport Simulation::calc_report() const {
  StepReport report;
  report.step = state_.step;
  report.time = state_.time;
  report.kinetic = system_->calc_kinetic(state_.velocities);
  report.elastic = system_->calc_energy(EnergyKind::elastic, state_.positions);
  report.gravity = system_->calc_energy(EnergyKind::gravity, state_.positions);
  report.contact = system_->calc_energy(EnergyKind::contact, state_.positions);
  const double external = system_->calc_energy(EnergyKind::external, state_.positions);
  report.work = books_.calc_work(external);
  report.dissipated = books_.dissipated;
  report.numerical = books_.calc_numerical(report.elastic + report.gravity + report.contact + external);
  for (std::int64_t i = 0; i < model_->particle_count(); ++i) {
    const Vec3 momentum = model_->masses[i] * block3(state_.velocities, i);
    report.momentum += momentum;
    report.angular_momentum += block3(state_.positions, i).cross(momentum);
  }
  report.statistics = statistics_;
  const double limit = calc_stable_step();
  report.error_estimate = calc_error_estimate();
  const double margin = limit * choice_.substeps / settings_.time.step;
  if (std::isfinite(margin)) report.stability_margin = margin;
  for (const Body& body : model_->bodies) {
    const ElementHealth health = calc_element_health(*model_, body, state_.positions);
    report.inverted += health.inverted;
    if (health.min_j) report.min_j = std::min(report.min_j.value_or(*health.min_j), *health.min_j);
  }
  return report;
}

std::vector<BodyReport> Simulation::calc_body_reports() const {
  std::vector<BodyReport> reports;
  for (const Body& body : model_->bodies) {
    const ElementHealth health = calc_element_health(*model_, body, state_.positions);
    BodyReport report{body.name,    body.particles.count, body.is_fem() ? body.tetrahedra.count : body.springs.count,
                      health.min_j, health.inverted,      Vec3::Zero()};
    double mass = 0.0;
    for (std::int64_t i = body.particles.first; i < body.particles.end(); ++i) {
      mass += model_->masses[i];
      report.center_of_mass += model_->masses[i] * block3(state_.positions, i);
    }
    report.center_of_mass /= mass;
    reports.push_back(report);
  }
  return reports;
}

// m a - F over the handle's particles; without inertia -F.
std::vector<HandleReport> Simulation::calc_handle_reports() const {
  std::vector<HandleReport> reports;
  if (model_->handles.empty()) return reports;
  const bool inertia = settings_.time.integrator != "quasi_static";
  VecX force;
  system_->calc_force(state_.positions, state_.velocities, force);
  for (const Handle& handle : model_->handles) {
    const HandleMotion motion = system_->calc_motion(handle, state_.time);
    HandleReport report{handle.name};
    for (std::size_t i = 0; i < handle.particles.size(); ++i) {
      const std::int32_t particle = handle.particles[i];
      Vec3 reaction = -block3(force, particle);
      if (inertia) reaction += model_->masses[particle] * motion.calc_acceleration(handle.base[i]);
      report.force += reaction;
      const Vec3 arm = block3(state_.positions, particle) - (motion.about + motion.translation);
      report.torque += arm.cross(reaction);
    }
    reports.push_back(std::move(report));
  }
  return reports;
}

std::uint64_t Simulation::calc_state_hash() const {
  return flexcast::calc_state_hash(state_);
}

double Simulation::calc_stable_step() const {
  const IntegratorRow& row = *find_integrator(settings_.time.integrator);
  if (row.implicit) return std::numeric_limits<double>::infinity();
  const std::int64_t age = state_.step - stable_step_from_;
  if (stable_step_ && age >= 0 && age < stable_step_lasts) return *stable_step_;
  stable_step_ = find_stable_step(state_.positions);
  stable_step_from_ = state_.step;
  return *stable_step_;
}

// The same at once, so that nobody's questions change what it says.
double Simulation::find_stable_step(const VecX& positions) const {
  const IntegratorRow& row = *find_integrator(settings_.time.integrator);
  if (row.implicit) return std::numeric_limits<double>::infinity();
  return flexcast::calc_stable_step(*system_, *model_, positions, row);
}

// Of the positions, m: what the substeps of the last step added to it.
std::optional<double> Simulation::calc_error_estimate() const {
  const double substeps = statistics_.substeps;
  if (substeps == 0.0) return std::nullopt;
  if (measured_) return measured_->position * substeps;
  const IntegratorRow& row = *find_integrator(settings_.time.integrator);
  const VelocityDerivatives derivatives = track_.calc_derivatives();
  if (!row.leading_error.is_known() || derivatives.known <= row.order) return std::nullopt;
  const double h = settings_.time.step / substeps;
  return settings_.time.step * std::abs(row.leading_error.position) * std::pow(h, row.order) *
         derivatives.rms[static_cast<std::size_t>(row.order)];
}

std::vector<std::string> Simulation::calc_warnings() const {
  std::vector<std::string> warnings;
  const double limit = calc_stable_step();
  const double h = settings_.time.step / choice_.substeps;
  if (h > limit) {
    char text[200];
    std::snprintf(text, sizeof text, "%s: the step of %.4g s is above the stable limit of about %.4g s (margin %.3g)",
                  settings_.time.integrator.c_str(), h, limit, limit / h);
    warnings.emplace_back(text);
  }
  if (has_tolerance() && choice_.substeps >= ToleranceControl::most_substeps) {
    warnings.push_back("time.tolerance = " + to_text(settings_.time.tolerance) +
                       " cannot be kept: it wants more than " + std::to_string(ToleranceControl::most_substeps) +
                       " substeps");
  }
  for (const Body& body : model_->bodies) {
    if (body.is_fem() && !body.is_quadratic() && body.poisson >= 0.45) {
      warnings.push_back(body.name + ": linear tetrahedra lock towards poisson = 0.5 (now " + to_text(body.poisson) +
                         "): the body is stiffer than its material; element = \"tet10\" is not");
    }
  }
  return warnings;
}

}  // namespace flexcast
