#include "core/sim/simulation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "core/forces/system.h"
#include "core/integrators/integrator.h"
#include "core/sim/failure_search.h"
#include "core/sim/largest_mode.h"

namespace flexcast {
namespace {

bool is_usable(const VecX& masses) {
  return std::all_of(masses.begin(), masses.end(), [](double mass) { return ranges::positive.contains(mass); });
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
  model_->jump_time = initial_.time;
  system_ = std::make_unique<System>(*model_);
  initial_.velocities = initial_.velocities.cwiseProduct(system_->free());
  system_->prescribe(initial_.time, initial_.positions, initial_.velocities);
  fingerprint_ = calc_fingerprint(*model_, initial_);
  state_ = initial_;
  base_step_ = initial_.step;
  base_time_ = initial_.time;
  parameters_ = make_descriptors(*model_, settings_);
  refresh({});
  restart_contract();
  book_start();
}

Simulation::~Simulation() = default;

// Masses, active forces, where handles are.
void Simulation::follow_model() {
  update_masses(*model_);
  model_->jump_time = state_.time;
  system_->refresh();
  VecX velocities = state_.velocities;
  system_->prescribe(state_.time, state_.positions, velocities);
  if (settings_.time.integrator != "quasi_static") state_.velocities = velocities;  // it knows no velocities
  stable_step_.reset();
}

// What follows from model and settings is made anew, so that a changed scene is a scene loaded that way.
void Simulation::refresh(const VecX& history) {
  follow_model();
  integrator_ = make_integrator();
  integrator_->limit_iterations(choice_.iterations);
  integrator_->set_history(history);
  twin_integrator_.reset();
}

std::unique_ptr<Integrator> Simulation::make_integrator() const {
  return find_integrator(settings_.time.integrator)->make(*system_, settings_.solver);
}

void Simulation::book_start() {
  books_ = {};
  books_.start_potential = system_->calc_potential(state_.positions);
  books_.start_external = system_->calc_energy(EnergyKind::external, state_.positions);
}

template <class Change>
void Simulation::book_jump(Change change) {
  // Differences first: a change that is none leaves the books as they are.
  const auto measure = [this] {
    return std::array{system_->calc_kinetic(state_.velocities), system_->calc_potential(state_.positions),
                      system_->calc_energy(EnergyKind::external, state_.positions)};
  };
  const auto [kinetic, potential, external] = measure();
  change();
  const auto [kinetic_now, potential_now, external_now] = measure();
  books_.potential_jump += potential_now - potential;
  books_.external_jump += external_now - external;
  books_.jump += (kinetic_now - kinetic) + (potential_now - potential) - (external_now - external);
}

double Simulation::time_at(std::int64_t step) const {
  return base_time_ + static_cast<double>(step - base_step_) * settings_.time.step;
}

// Handles without duration whose time has come.
void Simulation::jump() {
  const bool any = std::any_of(model_->handles.begin(), model_->handles.end(), [this](const Handle& handle) {
    return handle.duration == 0.0 && calc_progress(handle, model_->jump_time) != calc_progress(handle, state_.time);
  });
  if (any) {
    book_jump([this] {
      model_->jump_time = state_.time;
      system_->prescribe(state_.time, state_.positions, state_.velocities);
    });
    integrator_->invalidate();
  }
  model_->jump_time = state_.time;
}

void Simulation::reset(bool keep_parameters) {
  failure_.reset();
  statistics_ = {};
  model_->grabs.clear();
  if (!keep_parameters) {
    std::vector<ParameterAssignment> scene_values;
    for (const ParameterDescriptor& descriptor : parameters_) {
      if (parameter(descriptor) != descriptor.initial) scene_values.push_back({descriptor.name, descriptor.initial});
    }
    assign(scene_values);
    if (!scene_values.empty()) ++parameter_revision_;
  }
  state_ = initial_;
  base_step_ = initial_.step;
  base_time_ = initial_.time;
  choice_ = {};
  refresh({});
  restart_contract();
  book_start();
}

const ParameterDescriptor* Simulation::find_parameter(std::string_view name) const {
  const auto found = std::find_if(parameters_.begin(), parameters_.end(),
                                  [&](const ParameterDescriptor& descriptor) { return descriptor.name == name; });
  return found == parameters_.end() ? nullptr : &*found;
}

ParameterValue Simulation::parameter(const ParameterDescriptor& descriptor) const {
  return descriptor.row->get(*model_, settings_, descriptor.index);
}

Result<std::vector<ParameterAssignment>> Simulation::convert_values(
    std::span<const ParameterAssignment> assignments) const {
  std::vector<ParameterAssignment> converted;
  for (const ParameterAssignment& assignment : assignments) {
    const ParameterDescriptor* descriptor = find_parameter(assignment.name);
    if (!descriptor) return Error{assignment.name + " is not a parameter of this scene"};
    if (!descriptor->row->live) return Error{assignment.name + " is fixed when the scene is loaded"};
    auto value = convert_parameter(assignment.name, *descriptor->row, assignment.value);
    if (!value) return value.error();
    converted.push_back({assignment.name, std::move(value).value()});
  }
  return converted;
}

void Simulation::assign(std::span<const ParameterAssignment> assignments) {
  for (const ParameterAssignment& assignment : assignments) {
    const ParameterDescriptor* descriptor = find_parameter(assignment.name);
    descriptor->row->set(*model_, settings_, descriptor->index, assignment.value);
  }
  update_masses(*model_);
}

std::vector<ParameterAssignment> Simulation::values_of(std::span<const ParameterAssignment> assignments) const {
  std::vector<ParameterAssignment> values;
  for (const ParameterAssignment& assignment : assignments) {
    values.push_back({assignment.name, parameter(*find_parameter(assignment.name))});
  }
  return values;
}

// What ranges of single values cannot say of those just assigned.
Result<void> Simulation::check_assigned(std::span<const ParameterAssignment> assignments) const {
  if (auto checked = check_model(*model_); !checked) return checked;
  if (settings_.time.tolerance > 0.0 && settings_.time.budget > 0.0) {
    return Error{"time.tolerance = " + to_text(settings_.time.tolerance) + " and time.budget = " +
                 to_text(settings_.time.budget) + " exclude each other: set one of them to 0 with the other"};
  }
  const auto refuse = [&](const char* what) {
    std::string text;
    for (const ParameterAssignment& assignment : assignments) {
      text += (text.empty() ? "" : ", ") + assignment.name + " = " + to_text(assignment.value);
    }
    return Error{text + " gives " + what + " in double precision"};
  };
  if (!is_usable(model_->masses)) return refuse("particles a mass that is not > 0 and finite");
  const double energy = system_->calc_potential(state_.positions) + system_->calc_kinetic(state_.velocities);
  if (!std::isfinite(energy)) return refuse("energies that are not finite");
  return {};
}

Result<void> Simulation::set_parameters(std::span<const ParameterAssignment> assignments) {
  const auto converted = convert_values(assignments);
  if (!converted) return converted.error();
  const std::vector<ParameterAssignment> before = values_of(converted.value());
  const TimeSettings old = settings_.time;
  const EnergyBooks old_books = books_;
  const VecX history = integrator_->history(), positions = state_.positions, velocities = state_.velocities;
  Result<void> checked;
  book_jump([&] {
    assign(converted.value());
    follow_model();
    checked = check_assigned(converted.value());
  });
  if (!checked) {
    assign(before);
    follow_model();
    books_ = old_books;
    state_.positions = positions;
    state_.velocities = velocities;
    return checked;
  }
  if (settings_.time.step != old.step) {
    base_step_ = state_.step;
    base_time_ = state_.time;
  }
  failure_.reset();
  refresh(settings_.time.integrator == old.integrator ? history : VecX());
  follow_contract(old);
  ++parameter_revision_;
  return {};
}

double Simulation::choose_grab_stiffness(std::int32_t particle) const {
  const Body& body = *find_body_of_particle(*model_, particle);
  const double mass = model_->masses.segment(body.particles.first, body.particles.count).sum();
  const double wanted = mass * 400.0;  // the body as a whole swings about the target with 20 rad/s
  // A fifth of what the body's fastest mode has costs explicit schemes a tenth of their step. Of the present state, so
  // that nobody's questions change what happens.
  const auto index = static_cast<std::size_t>(&body - model_->bodies.data());
  const double fastest = calc_largest_modes(*system_, *model_, state_.positions)[index].omega_squared;
  return fastest > 0.0 ? std::min(wanted, 0.2 * fastest * model_->masses[particle]) : wanted;
}

Result<void> Simulation::grab(std::int64_t particle, const Vec3& target, double stiffness) {
  if (particle < 0 || particle >= model_->particle_count()) {
    return Error{"there is no particle " + std::to_string(particle) + " (allowed: 0 to " +
                 std::to_string(model_->particle_count() - 1) + ")"};
  }
  if (!target.allFinite() || target.cwiseAbs().maxCoeff() > largest_magnitude) {
    return Error{"the target " + to_text(ParameterValue(target)) + " m is out of range (allowed: finite numbers)"};
  }
  if (!ranges::non_negative.contains(stiffness)) {
    return Error{"the stiffness " + to_text(ParameterValue(stiffness)) +
                 " N/m is out of range (allowed: > 0, or 0 for one that fits)"};
  }
  const auto index = static_cast<std::int32_t>(particle);
  if (Vec3(block3(system_->free(), particle)) != Vec3::Ones()) {
    return Error{"particle " + std::to_string(particle) + " is held by a pin or a handle"};
  }
  book_jump([&] {
    auto found = std::find_if(model_->grabs.begin(), model_->grabs.end(),
                              [&](const Grab& grab) { return grab.particle == index; });
    if (found == model_->grabs.end()) {
      const double chosen = stiffness > 0.0 ? stiffness : choose_grab_stiffness(index);
      model_->grabs.push_back({index, target, chosen});
    } else {
      found->target = target;
      if (stiffness > 0.0) found->stiffness = stiffness;
    }
    follow_model();
  });
  integrator_->invalidate();
  return {};
}

Result<void> Simulation::release(std::int64_t particle) {
  const auto found = std::find_if(model_->grabs.begin(), model_->grabs.end(),
                                  [&](const Grab& grab) { return grab.particle == particle; });
  if (found == model_->grabs.end()) return Error{"particle " + std::to_string(particle) + " is not grabbed"};
  book_jump([&] {
    model_->grabs.erase(found);
    follow_model();
  });
  integrator_->invalidate();
  return {};
}

Checkpoint Simulation::save() const {
  Checkpoint checkpoint{fingerprint_, state_,        base_step_,      base_time_, integrator_->history(),
                        books_,       model_->grabs, save_contract(), {}};
  for (const ParameterDescriptor& descriptor : parameters_) {
    if (descriptor.row->live) checkpoint.values.push_back({descriptor.name, parameter(descriptor)});
  }
  return checkpoint;
}

// Numbers are finite, sizes fit, and grabs are such as grab() makes.
bool Simulation::is_restorable(const Checkpoint& checkpoint) const {
  const State& state = checkpoint.state;
  if (!is_publishable(state) || !std::isfinite(state.time) || !std::isfinite(checkpoint.base_time)) return false;
  const Eigen::Index history = checkpoint.history.size();
  if ((history != 0 && history != 1 + 2 * state.positions.size()) || !checkpoint.history.allFinite()) return false;
  std::vector<std::int32_t> seen;
  return std::all_of(checkpoint.grabs.begin(), checkpoint.grabs.end(), [&](const Grab& grab) {
    if (grab.particle < 0 || grab.particle >= model_->particle_count() || !grab.target.allFinite()) return false;
    if (Vec3(block3(system_->free(), grab.particle)) != Vec3::Ones()) return false;
    if (!ranges::positive.contains(grab.stiffness)) return false;
    const bool first = std::find(seen.begin(), seen.end(), grab.particle) == seen.end();
    seen.push_back(grab.particle);
    return first;
  });
}

Result<void> Simulation::restore(const Checkpoint& checkpoint) {
  const std::int64_t size = model_->rest_positions.size();
  if (checkpoint.fingerprint != fingerprint_ || checkpoint.state.positions.size() != size ||
      checkpoint.state.velocities.size() != size) {
    return Error{"the checkpoint belongs to another scene, or to this one before it was changed"};
  }
  const auto converted = convert_values(checkpoint.values);
  if (!converted) return Error{"the checkpoint does not fit: " + converted.error().message};
  if (!is_restorable(checkpoint)) return Error{"the checkpoint has a state or a grab that no simulation can have"};
  const std::vector<ParameterAssignment> before = values_of(converted.value());
  assign(converted.value());
  if (auto checked = check_model(*model_); !checked) {
    assign(before);
    return checked;
  }
  failure_.reset();
  statistics_ = {};
  state_ = checkpoint.state;
  base_step_ = checkpoint.base_step;
  base_time_ = checkpoint.base_time;
  model_->grabs = checkpoint.grabs;
  refresh(checkpoint.history);
  state_ = checkpoint.state;
  if (!restore_contract(checkpoint.contract)) restart_contract();
  books_ = checkpoint.books;
  ++parameter_revision_;
  return {};
}

std::int64_t Simulation::step_at(double time) const {
  return state_.step + std::llround((time - state_.time) / settings_.time.step);
}

}  // namespace flexcast
