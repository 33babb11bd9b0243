// The contract time.tolerance: chooses the substeps of a step so that the RMS error of the positions grows by at most
// `tolerance` times the scene's size a second. It knows no clock: the same run makes the same choices.
//
// Two things make the error of a scheme of order p with the leading error (x, v). What adds up, with the rate
//   c h^p sqrt( |d^p v|^2 + |d^(p-1) v| |d^(p+1) v| ),  c = |x + v| / 2,
// norms over the particles of time derivatives of the velocities: for an oscillation this is constant, since the second
// term is what the error of the velocities makes of itself in the positions (|d^(p-1) v| / |d^(p+1) v| is one over the
// square of the frequency), so that the choice does not swing with the motion. And what comes and goes with the motion,
//   |x - v| / 2 h^p |d^(p-1) (v - v0)|,
// which is held below what is allowed so far. Symplectic Euler has nothing else to first order: it is the leapfrog,
// begun with velocities that are h / 2 a0 too fast. From rest that is what the formula says; of bodies that start by
// spinning it says too much. Its phase is the leapfrog's, with p = 2 and c = 1 / 24. Source of the rates: E. Hairer, C.
// Lubich, G. Wanner, Geometric Numerical Integration, Springer 2006, chapters IX, X.
//
// A little less than the contract allows is aimed at: errors of nonlinear motion grow by themselves.
#pragma once

#include <optional>

#include "core/integrators/integrator.h"
#include "core/sim/velocity_track.h"

namespace flexcast {

// What the control must know of the step that was taken.
struct JudgedStep {
  const IntegratorRow& row;
  double length = 0.0;              // s, of the whole step
  double elapsed = 0.0;             // s, since the contract began
  double speed = 0.0;               // m/s, RMS of what the velocities changed since then
  double allowed = 0.0;             // m/s: tolerance times size
  VelocityDerivatives derivatives;  // at its end
  std::optional<double> measured;   // m/s: the rate by half steps, for schemes whose leading error is not known
};

class ToleranceControl {
 public:
  // The contract begins, or the world changed. `stable_step` in s, possibly infinite.
  void begin(double length, double stable_step);
  int substeps() const { return substeps_; }
  int least() const { return least_; }  // of them, to be stable
  // False: the step was too coarse and is to be taken again with the substeps that there are now.
  bool accept(const JudgedStep& step);
  // The step could not be taken at all. False: more substeps will not help.
  bool retry();
  // The stable step was looked up again.
  void follow(double length, double stable_step);

  // So many at most; a contract that wants more is not kept.
  static constexpr int most_substeps = 10'000;
  static constexpr Eigen::Index saved_size = 4;
  VecX save() const;
  bool restore(const VecX& saved);

 private:
  double calc_need(const JudgedStep& step);

  int substeps_ = 1, least_ = 1;
  int retries_ = 0;
  double wanted_ = 0.0;    // substeps, by the last judgement of this step
  double envelope_ = 0.0;  // substeps: the largest need lately, forgotten by a fifth a step
  double speed_ = 0.0;     // m/s^p, the largest |d^(p-1) (v - v0)| so far
};

}  // namespace flexcast
