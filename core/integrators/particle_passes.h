// The passes over the particles that schemes consist of beside their forces, in parallel. Each reads and writes a
// number once and keeps the books on the way: what the impulse h F of the forces adds to the kinetic energy, h F . (v0
// + v1)/2. The books of a state with a number above largest_magnitude, or with one that is not finite, are not a
// number. What is written may be what is read.
#pragma once

#include <vector>

#include "core/forces/system.h"
#include "core/state/state.h"

namespace flexcast {

// s: how long forces act on the velocities, and how long the positions then move.
struct KickAndDrift {
  double kick = 0.0, drift = 0.0;
};

// What an implicit scheme makes of the displacement u that it found: positions base + reach u, velocities
// u / time - past v0. Divided: a product with the rounded inverse would be off to the same side at every step.
struct DisplacementRule {
  double reach = 1.0;
  double time = 1.0;  // s
  double past = 0.0;
};

class ParticlePasses {
 public:
  // v1 = v0 + h F / m, then friction of what touches at x; velocities of what is held stay.
  void kick(const System& system, double h, const VecX& F, const VecX& x, const VecX& v0, VecX& v1,
            StepStatistics& statistics);
  // x1 = x0 + h v.
  void drift(double h, const VecX& v, const VecX& x0, VecX& x1, StepStatistics& statistics);
  // A kick by F, taken at from.positions, and a drift with the velocities after it.
  void kick_and_drift(const System& system, KickAndDrift h, const VecX& F, const State& from, State& to,
                      StepStatistics& statistics);
  // The same with the velocities before it.
  void drift_and_kick(const System& system, double h, const VecX& F, const State& from, State& to,
                      StepStatistics& statistics);
  // The end of an implicit step of h seconds from state.velocities, handles included. Where free, the forces are what
  // changed the velocities, h F = m (v1 - v0); F: where held.
  void follow(const System& system, double h, const DisplacementRule& rule, const VecX& base, const VecX& u,
              const VecX& F, State& state, StepStatistics& statistics);

 private:
  void find_friction(const System& system, const VecX& x);

  std::vector<double> partial_;        // J, of blocks
  std::vector<FrictionPoint> points_;  // where friction acts in the present kick
};

}  // namespace flexcast
