#include "core/sim/simulation.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "core/forces/system.h"
#include "core/integrators/integrator.h"
#include "core/sim/element_health.h"
#include "core/sim/failure_search.h"
#include "core/sim/state_hash.h"

namespace flexcast {
namespace {

std::vector<ParameterDescriptor> make_descriptors(const Model& model, const Settings& settings) {
  using Scope = ParameterRow::Scope;
  std::vector<ParameterDescriptor> descriptors;
  for (const ParameterRow& row : parameter_rows()) {
    if (row.scope == Scope::scene) descriptors.push_back({std::string(row.name), &row, 0, row.get(model, settings, 0)});
  }
  for (std::size_t body = 0; body < model.bodies.size(); ++body) {
    for (const ParameterRow& row : parameter_rows()) {
      const bool fits = row.scope == Scope::any_body ||
                        row.scope == (model.bodies[body].is_fem() ? Scope::fem_body : Scope::spring_body);
      if (!fits) continue;
      const std::string name = model.bodies[body].name + "." + std::string(row.name);
      descriptors.push_back({name, &row, body, row.get(model, settings, body)});
    }
  }
  return descriptors;
}

}  // namespace

Simulation::Simulation(Model model, Settings settings, State initial, std::vector<Probe> probes)
    : model_(std::make_unique<Model>(std::move(model))),
      settings_(std::move(settings)),
      initial_(std::move(initial)),
      state_(initial_),
      before_(initial_),
      probes_(std::move(probes)) {
  FLEXCAST_CHECK(initial_.positions.size() == model_->rest_positions.size());
  FLEXCAST_CHECK(initial_.velocities.size() == model_->rest_positions.size());
  FLEXCAST_CHECK(static_cast<std::int64_t>(model_->fixed.size()) == model_->rest_positions.size());
  update_masses(*model_);
  system_ = std::make_unique<System>(*model_);
  initial_.velocities = initial_.velocities.cwiseProduct(system_->free());
  state_ = initial_;
  base_step_ = initial_.step;
  base_time_ = initial_.time;
  parameters_ = make_descriptors(*model_, settings_);
  refresh();
}

Simulation::~Simulation() = default;

// What follows from model and settings is made anew, so that a changed scene is a scene loaded that way.
void Simulation::refresh() {
  update_masses(*model_);
  system_->refresh();
  integrator_ = find_integrator(settings_.time.integrator)->make(*system_, settings_.solver);
  power_ = calc_dissipated_power();
}

double Simulation::calc_dissipated_power() const {
  if (!system_->has_damping()) return 0.0;
  VecX force;
  system_->calc_damping(state_.positions, state_.velocities, force);
  return -force.dot(state_.velocities);
}

bool Simulation::step() {
  if (failure_) return false;
  before_.positions = state_.positions;
  before_.velocities = state_.velocities;
  statistics_ = {};
  const double h = settings_.time.step / settings_.time.substeps;
  for (int i = 0; i < settings_.time.substeps; ++i) integrator_->step(*system_, h, state_, statistics_);
  if (!is_publishable(state_) || !std::isfinite(statistics_.residual)) {
    note_failure();
    return false;
  }
  ++state_.step;
  state_.time = base_time_ + static_cast<double>(state_.step - base_step_) * settings_.time.step;
  if (system_->has_damping()) {
    const double power = calc_dissipated_power();
    dissipated_ += 0.5 * settings_.time.step * (power_ + power);
    power_ = power;
  }
  return true;
}

void Simulation::note_failure() {
  failure_ = find_failure(*model_, before_, state_);
  failure_->step = state_.step + 1;
  const IntegratorRow& row = *find_integrator(settings_.time.integrator);
  const double limit = calc_stable_step();
  if (!row.implicit && settings_.time.step / settings_.time.substeps > limit) {
    char text[160];
    std::snprintf(text, sizeof text,
                  "the step is above the stable one: set time.step to at most %.3g s, or more "
                  "time.substeps, or time.integrator to backward_euler",
                  limit * settings_.time.substeps);
    failure_->suggestion = text;
  } else {
    failure_->suggestion = "lower time.step or the stiffness, raise the damping, or reset";
  }
  state_.positions = before_.positions;
  state_.velocities = before_.velocities;
  integrator_->invalidate();
}

void Simulation::reset(bool keep_parameters) {
  failure_.reset();
  statistics_ = {};
  state_ = initial_;
  base_step_ = initial_.step;
  base_time_ = initial_.time;
  booked_work_ = 0.0;
  dissipated_ = 0.0;
  if (!keep_parameters) {
    std::vector<ParameterAssignment> scene_values;
    for (const ParameterDescriptor& descriptor : parameters_) {
      if (parameter(descriptor) != descriptor.initial) scene_values.push_back({descriptor.name, descriptor.initial});
    }
    apply_values(scene_values);
    if (!scene_values.empty()) ++parameter_revision_;
  }
  refresh();
}

const ParameterDescriptor* Simulation::find_parameter(std::string_view name) const {
  const auto found = std::find_if(parameters_.begin(), parameters_.end(),
                                  [&](const ParameterDescriptor& descriptor) { return descriptor.name == name; });
  return found == parameters_.end() ? nullptr : &*found;
}

ParameterValue Simulation::parameter(const ParameterDescriptor& descriptor) const {
  return descriptor.row->get(*model_, settings_, descriptor.body);
}

void Simulation::apply_values(std::span<const ParameterAssignment> assignments) {
  for (const ParameterAssignment& assignment : assignments) {
    const ParameterDescriptor* descriptor = find_parameter(assignment.name);
    descriptor->row->set(*model_, settings_, descriptor->body, assignment.value);
  }
}

Result<void> Simulation::set_parameters(std::span<const ParameterAssignment> assignments) {
  std::vector<ParameterAssignment> converted;
  for (const ParameterAssignment& assignment : assignments) {
    const ParameterDescriptor* descriptor = find_parameter(assignment.name);
    if (!descriptor) return Error{assignment.name + " is not a parameter of this scene"};
    if (!descriptor->row->live) return Error{assignment.name + " is fixed when the scene is loaded"};
    auto value = convert_parameter(assignment.name, *descriptor->row, assignment.value);
    if (!value) return value.error();
    converted.push_back({assignment.name, std::move(value).value()});
  }
  const auto calc_total = [this] {
    return system_->calc_kinetic(state_.velocities) + system_->calc_energy(EnergyKind::elastic, state_.positions) +
           system_->calc_energy(EnergyKind::gravity, state_.positions);
  };
  const double energy = calc_total();
  const TimeSettings old = settings_.time;
  apply_values(converted);
  if (settings_.time.step != old.step) {
    base_step_ = state_.step;
    base_time_ = state_.time;
  }
  failure_.reset();
  refresh();
  booked_work_ += calc_total() - energy;
  ++parameter_revision_;
  return {};
}

StepReport Simulation::calc_report() const {
  StepReport report;
  report.step = state_.step;
  report.time = state_.time;
  report.kinetic = system_->calc_kinetic(state_.velocities);
  report.elastic = system_->calc_energy(EnergyKind::elastic, state_.positions);
  report.gravity = system_->calc_energy(EnergyKind::gravity, state_.positions);
  report.work = booked_work_;
  if (model_->external_forces.size() > 0) {
    report.work += model_->external_forces.dot(state_.positions - initial_.positions);
  }
  report.dissipated = dissipated_;
  for (std::int64_t i = 0; i < model_->particle_count(); ++i) {
    const Vec3 momentum = model_->masses[i] * block3(state_.velocities, i);
    report.momentum += momentum;
    report.angular_momentum += block3(state_.positions, i).cross(momentum);
  }
  report.statistics = statistics_;
  const double limit = calc_stable_step();
  if (std::isfinite(limit)) report.stability_margin = limit * settings_.time.substeps / settings_.time.step;
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

std::uint64_t Simulation::calc_state_hash() const {
  return flexcast::calc_state_hash(state_);
}

double Simulation::calc_stable_step() const {
  const IntegratorRow& row = *find_integrator(settings_.time.integrator);
  double limit = std::numeric_limits<double>::infinity();
  for (const ModeBound& bound : system_->calc_mode_bounds()) {
    const double omega = std::sqrt(bound.omega_squared);
    if (omega == 0.0 && bound.damping_rate == 0.0) continue;
    // Damping shortens the step of some schemes and lengthens that of others.
    limit = std::min({limit, row.calc_stable_step(omega, bound.damping_rate),
                      row.calc_stable_step(omega, bound.least_damping_rate)});
  }
  return limit;
}

std::vector<std::string> Simulation::calc_warnings() const {
  std::vector<std::string> warnings;
  const double limit = calc_stable_step();
  const double h = settings_.time.step / settings_.time.substeps;
  if (h > limit) {
    char text[200];
    std::snprintf(text, sizeof text, "%s: the step of %.4g s is above the stable limit of about %.4g s (margin %.3g)",
                  settings_.time.integrator.c_str(), h, limit, limit / h);
    warnings.emplace_back(text);
  }
  for (const Body& body : model_->bodies) {
    if (body.is_fem() && body.poisson >= 0.45) {
      warnings.push_back(body.name + ": linear tetrahedra lock towards poisson = 0.5 (now " + to_text(body.poisson) +
                         "): the body is stiffer than its material");
    }
  }
  return warnings;
}

std::int64_t Simulation::step_at(double time) const {
  return state_.step + std::llround((time - state_.time) / settings_.time.step);
}

}  // namespace flexcast
