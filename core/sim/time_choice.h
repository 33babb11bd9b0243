// How one step is taken: fixed by the settings, or chosen by a contract.
#pragma once

namespace flexcast {

struct TimeChoice {
  int substeps = 1;    // integrator steps
  int iterations = 0;  // sweeps or Newton iterations an integrator step at most; 0: the solver's own number
  bool operator==(const TimeChoice&) const = default;
};

}  // namespace flexcast
