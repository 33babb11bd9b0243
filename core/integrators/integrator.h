// Integrator: takes the state one step further. Each scheme is one pair of files and one row of the table.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "core/forces/system.h"
#include "core/solvers/settings.h"
#include "core/state/state.h"
#include "core/state/step_statistics.h"

namespace flexcast {

class LinearMotion;

class Integrator {
 public:
  virtual ~Integrator() = default;
  // Positions and velocities after h seconds from state.time; step and time are the caller's to advance. Held degrees
  // of freedom keep their positions, handles move as prescribed. The result depends on state, system and history only,
  // to the last bit.
  virtual void step(const System& system, double h, State& state, StepStatistics& statistics) = 0;
  // The same from one state to another, whose time and step are not touched.
  virtual void step_from(const System& system, double h, const State& from, State& to, StepStatistics& statistics) {
    to.positions = from.positions;
    to.velocities = from.velocities;
    step(system, h, to, statistics);
  }
  // Sweeps or Newton iterations a step at most, below those of the settings; 0: those.
  virtual void limit_iterations(int /*most*/) {}
  // The state or the system changed between two steps: what was kept from the last step is void.
  virtual void invalidate() {}
  // What a scheme of several steps knows of the past, for a scheme of the same name to go on from: a step and, of its
  // start, positions and velocities. Empty: nothing.
  virtual VecX history() const { return {}; }
  virtual void set_history(const VecX& /*history*/) {}
};

// What a step of h seconds does wrong, to leading order and for smooth motion: positions are off by
// position h^(p+1) d^p v / dt^p, velocities by velocity h^(p+1) d^(p+1) v / dt^(p+1), p the order. Both zero: not
// known.
struct LeadingError {
  double position = 0.0, velocity = 0.0;
  bool is_known() const { return position != 0.0; }
};

struct IntegratorRow {
  std::string_view name;  // as in scene files
  std::string_view summary;
  int order;      // of convergence in h; 0: the scheme has none (it iterates a fixed number of times, or knows no time)
  bool implicit;  // has solver settings; no stability limit
  // s: the largest stable h for a mode x'' = -omega^2 x - damping_rate x' (1/s; damping_rate = 2 zeta omega), possibly
  // infinite.
  double (*calc_stable_step)(double omega, double damping_rate);
  std::unique_ptr<Integrator> (*make)(const System& system, const SolverSettings& settings);
  LeadingError leading_error = {};
  // s: the same for a body whose damping couples its modes, knowing the smallest limit of pairs (omega, damping_rate)
  // that its modes can have. Null: that limit is the answer.
  double (*calc_coupled_stable_step)(LinearMotion& motion, double limit) = nullptr;
};

std::span<const IntegratorRow> integrators();
const IntegratorRow* find_integrator(std::string_view name);

}  // namespace flexcast
