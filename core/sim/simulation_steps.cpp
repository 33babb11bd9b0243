// How a simulation takes its steps.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/forces/system.h"
#include "core/integrators/integrator.h"
#include "core/sim/failure_search.h"
#include "core/sim/simulation.h"

namespace flexcast {
namespace {

constexpr std::int64_t lookup_interval = 500;    // steps between two looks at the stable step by the contract
constexpr std::int64_t doubling_interval = 128;  // steps between two estimates by half steps under a budget

double calc_rms(const VecX& vectors) {
  return std::sqrt(3.0 * vectors.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(vectors.size(), 1)));
}

}  // namespace

bool Simulation::step() {
  if (failure_) return false;
  state_.positions.swap(before_.positions);
  state_.velocities.swap(before_.velocities);
  before_.time = state_.time;
  if (!(has_tolerance() ? take_tolerated_step() : take_substeps())) {
    note_failure();
    return false;
  }
  ++state_.step;
  state_.time = time_at(state_.step);
  books_.force_work += statistics_.force_work;
  books_.handle_work += statistics_.handle_work;
  books_.dissipated += statistics_.dissipated;
  if (system_->has_handles()) jump();
  return true;
}

bool Simulation::has_tolerance() const {
  return settings_.time.tolerance > 0.0 && settings_.time.integrator != "quasi_static";
}

// From before_ to state_, all but its number and time. False: the books of a state that must not be published are no
// numbers.
bool Simulation::take_substeps() {
  const int count = choice_.substeps;
  statistics_ = {};
  statistics_.substeps = count;
  const double start = before_.time, h = settings_.time.step / count;
  const bool doubles = is_doubling();
  for (int i = 0; i < count; ++i) {
    if (doubles && i + 1 == count) start_twin(i);
    if (i == 0) {
      integrator_->step_from(*system_, h, before_, state_, statistics_);
    } else {
      state_.time = start + i * h;
      integrator_->step(*system_, h, state_, statistics_);
    }
    const bool wanted = i + 1 == count || (has_tolerance() && count - i <= VelocityTrack::most);
    if (tracks_ && wanted) track_.observe(start + (i + 1) * h, state_.velocities);
  }
  state_.time = start;
  const double moved = statistics_.force_work + statistics_.handle_work + statistics_.dissipated;
  if (!std::isfinite(statistics_.residual + moved)) return false;
  if (doubles) compare_twin();
  return true;
}

// Again and again with more substeps, until the contract is kept.
bool Simulation::take_tolerated_step() {
  if (state_.step % lookup_interval == 0) tolerance_.follow(settings_.time.step, find_stable_step(before_.positions));
  const VecX history = integrator_->history();
  for (;;) {
    choice_.substeps = tolerance_.substeps();
    const bool taken = take_substeps();
    if (taken ? tolerance_.accept(make_judged_step()) : !tolerance_.retry()) return taken;
    track_.begin(before_.time, before_.velocities);
    integrator_->invalidate();
    integrator_->set_history(history);
  }
}

JudgedStep Simulation::make_judged_step() const {
  const TimeSettings& time = settings_.time;
  JudgedStep step{*find_integrator(time.integrator),
                  time.step,
                  before_.time + time.step - contract_time_,
                  calc_rms(state_.velocities - contract_velocities_),
                  time.tolerance * system_->size(),
                  track_.calc_derivatives(),
                  {}};
  if (measured_ && !step.row.leading_error.is_known()) {
    // Velocities that are off move the positions for as long as the motion keeps its direction.
    const auto& rms = step.derivatives.rms;
    const double fast = rms[2] * rms[2] + rms[1] * rms[3], slow = rms[1] * rms[1] + rms[0] * rms[2];
    const double seconds = fast > 0.0 ? std::sqrt(slow / fast) : 0.0;
    step.measured = std::hypot(measured_->position, measured_->velocity * seconds) * choice_.substeps / time.step;
  }
  return step;
}

// By half steps: asked for by the parameter; by a contract where nothing cheaper is known.
bool Simulation::is_doubling() const {
  const TimeSettings& time = settings_.time;
  if (time.integrator == "quasi_static") return false;
  if (time.error_estimate == "doubling") return true;
  if (find_integrator(time.integrator)->leading_error.is_known()) return false;
  return time.tolerance > 0.0 || (time.budget > 0.0 && state_.step % doubling_interval == 0);
}

// Takes the last substep in two halves beside the simulation, from where it starts.
void Simulation::start_twin(int substep) {
  const State& from = substep == 0 ? before_ : state_;
  const double h = settings_.time.step / choice_.substeps;
  twin_.positions = from.positions;
  twin_.velocities = from.velocities;
  twin_.time = before_.time + substep * h;
  if (!twin_integrator_) twin_integrator_ = make_integrator();
  twin_integrator_->limit_iterations(choice_.iterations);
  twin_integrator_->invalidate();
  twin_integrator_->set_history(integrator_->history());
  StepStatistics unused;
  twin_integrator_->step(*system_, 0.5 * h, twin_, unused);
  twin_.time += 0.5 * h;
  twin_integrator_->step(*system_, 0.5 * h, twin_, unused);
}

// Richardson: of the error of a step of order p, two halves keep the 2^p-th part.
void Simulation::compare_twin() {
  const int p = std::max(find_integrator(settings_.time.integrator)->order, 1);
  const double factor = std::exp2(p) / (std::exp2(p) - 1.0);
  measured_ = StepError{factor * calc_rms(state_.positions - twin_.positions),
                        factor * calc_rms(state_.velocities - twin_.velocities)};
}

void Simulation::choose(const TimeChoice& choice) {
  FLEXCAST_CHECK(choice.substeps >= 1 && choice.iterations >= 0);
  if (settings_.time.budget == 0.0) return;
  choice_ = choice;
  integrator_->limit_iterations(choice.iterations);
}

bool Simulation::has_contract() const {
  return has_tolerance() || (settings_.time.budget > 0.0 && settings_.time.integrator != "quasi_static");
}

// After parameters have changed: a contract that is still the same goes on, but above the least substeps of the world
// as it is now.
void Simulation::follow_contract(const TimeSettings& old) {
  const TimeSettings& time = settings_.time;
  const bool same = time.integrator == old.integrator && time.step == old.step && time.tolerance == old.tolerance &&
                    (time.budget > 0.0) == (old.budget > 0.0) && time.error_estimate == old.error_estimate;
  if (!same || !has_contract()) return restart_contract();
  tolerance_.follow(time.step, find_stable_step(state_.positions));
  choice_.substeps = std::max(choice_.substeps, tolerance_.least());
}

VecX Simulation::save_contract() const {
  if (!has_contract()) return {};
  const VecX control = tolerance_.save(), track = track_.save();
  VecX saved(3 + control.size() + contract_velocities_.size() + track.size());
  saved << choice_.substeps, choice_.iterations, contract_time_, control, contract_velocities_, track;
  return saved;
}

bool Simulation::restore_contract(const VecX& saved) {
  const Eigen::Index dofs = has_tolerance() ? state_.velocities.size() : 0;
  const Eigen::Index head = 3 + ToleranceControl::saved_size;
  if (!has_contract() || saved.size() < head + dofs || !saved.allFinite()) return false;
  const auto is_count = [](double value) { return value >= 0.0 && value <= 1e6 && value == std::floor(value); };
  if (!is_count(saved[0]) || saved[0] == 0.0 || !is_count(saved[1])) return false;
  restart_contract();
  if (!tolerance_.restore(saved.segment(3, ToleranceControl::saved_size))) return false;
  if (!track_.restore(saved.tail(saved.size() - head - dofs), state_.velocities.size())) return false;
  contract_time_ = saved[2];
  contract_velocities_ = saved.segment(head, dofs);
  choice_ = {static_cast<int>(saved[0]), static_cast<int>(saved[1])};
  integrator_->limit_iterations(choice_.iterations);
  return true;
}

// After the contract, the scheme or anything else that the choices rest on has changed.
void Simulation::restart_contract() {
  track_.begin(state_.time, state_.velocities);
  contract_time_ = state_.time;
  contract_velocities_.resize(0);
  if (has_tolerance()) contract_velocities_ = state_.velocities;
  measured_.reset();
  tracks_ = has_tolerance() || find_integrator(settings_.time.integrator)->leading_error.is_known();
  const double limit = has_contract() ? find_stable_step(state_.positions) : 0.0;
  tolerance_.begin(settings_.time.step, limit);
  choice_ = {has_contract() ? tolerance_.least() : settings_.time.substeps, 0};
  if (has_tolerance()) choice_.substeps = tolerance_.substeps();
  integrator_->limit_iterations(0);
}

void Simulation::note_failure() {
  failure_ = find_failure(*model_, before_, state_);
  if (is_publishable(state_) && std::isfinite(statistics_.residual)) {
    failure_->cause = "the energies of the step passed the range of double precision";
  }
  failure_->step = state_.step + 1;
  const IntegratorRow& row = *find_integrator(settings_.time.integrator);
  const double limit = calc_stable_step();
  if (!row.implicit && settings_.time.step / choice_.substeps > limit) {
    char text[160];
    std::snprintf(text, sizeof text,
                  "the step is above the stable one: set time.step to at most %.3g s, or more "
                  "time.substeps, or time.integrator to backward_euler",
                  limit * choice_.substeps);
    failure_->suggestion = text;
  } else {
    failure_->suggestion = "lower time.step or the stiffness, raise the damping, or reset";
  }
  state_.positions = before_.positions;
  state_.velocities = before_.velocities;
  statistics_ = {};
  statistics_.converged = false;
  integrator_->invalidate();
}

}  // namespace flexcast
