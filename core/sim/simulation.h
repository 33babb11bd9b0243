// Simulation: a scene that can be stepped, asked, changed and reset. Deterministic: the same model, settings and calls
// give the same bits. It knows no clock, no network, no files.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/forces/model.h"
#include "core/sim/checkpoint.h"
#include "core/sim/energy_books.h"
#include "core/sim/parameters.h"
#include "core/sim/report.h"
#include "core/sim/settings.h"
#include "core/sim/time_choice.h"
#include "core/sim/tolerance_control.h"
#include "core/sim/velocity_track.h"
#include "core/state/state.h"

namespace flexcast {

class System;
class Integrator;

class Simulation {
 public:
  // `initial` has the starting positions and velocities; fixed degrees of freedom stay at their starting positions.
  // The model's masses are computed here. Sizes must agree and values be finite: the scene reader sees to it.
  Simulation(Model model, Settings settings, State initial, std::vector<Probe> probes);
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  // Takes one step. False: the step would not have been finite; the state is the one before it, failure() says why, and
  // further calls do nothing until a parameter is set, or reset() is called.
  bool step();

  // Back to the initial state at step 0; parameters return to the scene's values unless kept.
  void reset(bool keep_parameters = false);

  const Model& model() const { return *model_; }
  const Settings& settings() const { return settings_; }
  const State& state() const { return state_; }
  const std::vector<Probe>& probes() const { return probes_; }
  const std::optional<Failure>& failure() const { return failure_; }
  const StepStatistics& statistics() const { return statistics_; }  // of the last step

  // How steps are taken: as the settings say, or as a contract chose for the last step (time.tolerance) or the next one
  // (time.budget).
  const TimeChoice& choice() const { return choice_; }
  bool has_contract() const;
  // What a budget chose from measured times (BudgetControl), for the steps to come. Ignored without that contract.
  void choose(const TimeChoice& choice);

  // Energies, momenta and element health of the present state: a pass over everything, so only on demand.
  StepReport calc_report() const;
  std::vector<BodyReport> calc_body_reports() const;
  std::vector<HandleReport> calc_handle_reports() const;
  // XXH3 (64 bit) over step (int64), positions, velocities (doubles, little endian).
  std::uint64_t calc_state_hash() const;
  // The longest step an explicit scheme may take, s, never above the true limit of the linearised scene; infinite for
  // schemes without one. margin = limit / (step / substeps).
  double calc_stable_step() const;
  // Sentences about the present settings that a user should know: a margin below one, elements that lock.
  std::vector<std::string> calc_warnings() const;

  const std::vector<ParameterDescriptor>& parameters() const { return parameters_; }
  const ParameterDescriptor* find_parameter(std::string_view name) const;
  ParameterValue parameter(const ParameterDescriptor& descriptor) const;
  // All or nothing. Errors name the parameter, the value and what is allowed. On success the revision grows by one.
  Result<void> set_parameters(std::span<const ParameterAssignment> assignments);
  std::uint64_t parameter_revision() const { return parameter_revision_; }  // from 1; never falls, not even at reset

  // Pulls a particle of the world towards a target until it is released; a second grab of a particle moves its target.
  // stiffness in N/m, 0: chosen so that the body follows and explicit schemes lose at most a tenth of their step.
  // Errors: no such particle, a held one, numbers out of range.
  Result<void> grab(std::int64_t particle, const Vec3& target, double stiffness = 0.0);
  Result<void> release(std::int64_t particle);  // an error when it is not grabbed
  const std::vector<Grab>& grabs() const { return model_->grabs; }

  // Everything the next steps depend on. A simulation of the same scene that restores it goes on to the last bit as the
  // one that saved it; the parameter revision grows. Errors: a checkpoint of another scene, a value that is not
  // allowed.
  Checkpoint save() const;
  Result<void> restore(const Checkpoint& checkpoint);

  // Number of the step that ends nearest to `time`: round(time / step) counted from now on.
  std::int64_t step_at(double time) const;

 private:
  void assign(std::span<const ParameterAssignment> assignments);
  std::vector<ParameterAssignment> values_of(std::span<const ParameterAssignment> assignments) const;
  Result<void> check_assigned(std::span<const ParameterAssignment> assignments) const;
  Result<std::vector<ParameterAssignment>> convert_values(std::span<const ParameterAssignment> assignments) const;
  bool is_restorable(const Checkpoint& checkpoint) const;
  void follow_model();
  void refresh(const VecX& history);
  void jump();
  bool has_tolerance() const;
  bool take_substeps();
  bool take_tolerated_step();
  JudgedStep make_judged_step() const;
  bool is_doubling() const;
  void start_twin(int substep);
  void compare_twin();
  void restart_contract();
  void follow_contract(const TimeSettings& old);
  VecX save_contract() const;
  bool restore_contract(const VecX& saved);
  std::unique_ptr<Integrator> make_integrator() const;
  std::optional<double> calc_error_estimate() const;
  double find_stable_step(const VecX& positions) const;
  void note_failure();
  void book_start();
  double choose_grab_stiffness(std::int32_t particle) const;
  double time_at(std::int64_t step) const;

  // Runs `change` and books what it does to the energies.
  template <class Change>
  void book_jump(Change change);

  std::unique_ptr<Model> model_;  // has a stable address: the forces refer to it
  Settings settings_;
  State initial_, state_, before_;
  std::vector<Probe> probes_;
  std::unique_ptr<System> system_;
  std::unique_ptr<Integrator> integrator_;
  std::vector<ParameterDescriptor> parameters_;
  std::uint64_t parameter_revision_ = 1;
  StepStatistics statistics_;
  TimeChoice choice_;
  ToleranceControl tolerance_;
  VelocityTrack track_;
  bool tracks_ = false;
  double contract_time_ = 0.0;  // s, where the contract began,
  VecX contract_velocities_;    // and the velocities there; empty without time.tolerance
  // The error of an integrator step by half steps, and what takes these.
  struct StepError {
    double position = 0.0, velocity = 0.0;  // RMS over the particles, m and m/s
  };
  std::optional<StepError> measured_;
  State twin_;
  std::unique_ptr<Integrator> twin_integrator_;
  std::optional<Failure> failure_;
  // Time is base_time_ + (step - base_step_) * dt, so that no error adds up; a changed dt moves the base.
  std::int64_t base_step_ = 0;
  double base_time_ = 0.0;
  EnergyBooks books_;
  std::uint64_t fingerprint_ = 0;
  // The stable step, by the modes of the state where it was last asked for after a change or many steps.
  mutable std::optional<double> stable_step_;
  mutable std::int64_t stable_step_from_ = 0;
};

}  // namespace flexcast
