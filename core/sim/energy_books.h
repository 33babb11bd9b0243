// The books of a run: sums over its steps of what moved energy, J. With K the kinetic and U the potential energy of
// every force (elastic, gravity, contact, and of outer forces: dead loads, grabs),
//   K - K0 = force work + handle work + jumps of K,
//   numerical = force work + (U - U0 - jumps of U) + dissipated:
// what the scheme gains (+) or loses (-): zero in exact integration, since forces then take from U what they add to K.
// It is made of the forces the scheme used, so that  K + elastic + gravity + contact - work + dissipated - numerical
// stays constant only if velocities followed the forces.
#pragma once

namespace flexcast {

struct EnergyBooks {
  double force_work = 0.0, handle_work = 0.0, dissipated = 0.0;  // StepStatistics, summed
  double start_potential = 0.0;                                  // U at the start
  double start_external = 0.0;                                   // the part of outer forces
  // What changes of parameters and jumps of handles did at once: to K and the reported parts of U; to all of U; to that
  // of outer forces.
  double jump = 0.0, potential_jump = 0.0, external_jump = 0.0;

  // Of outer forces, handles and jumps.
  double calc_work(double external) const { return handle_work - (external - start_external - external_jump) + jump; }
  double calc_numerical(double potential) const {
    return force_work + (potential - start_potential - potential_jump) + dissipated;
  }
};

}  // namespace flexcast
