// Forward (explicit) Euler: x += h v, v += h a(x, v), both from the old state. First order; unstable without damping.
#pragma once

#include "core/integrators/integrator.h"

namespace flexcast {
extern const IntegratorRow forward_euler_row;
}
