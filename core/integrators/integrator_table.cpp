#include <array>

#include "core/integrators/backward_euler.h"
#include "core/integrators/bdf2.h"
#include "core/integrators/forward_euler.h"
#include "core/integrators/implicit_midpoint.h"
#include "core/integrators/integrator.h"
#include "core/integrators/quasi_static.h"
#include "core/integrators/rk4.h"
#include "core/integrators/symplectic_euler.h"
#include "core/integrators/vbd.h"
#include "core/integrators/velocity_verlet.h"
#include "core/integrators/xpbd.h"

namespace flexcast {

std::span<const IntegratorRow> integrators() {
  static const std::array table{forward_euler_row,
                                symplectic_euler_row,
                                velocity_verlet_row,
                                rk4_row,
                                backward_euler_row,
                                implicit_midpoint_row,
                                bdf2_row,
                                xpbd_row,
                                vbd_row,
                                quasi_static_row};
  return table;
}

const IntegratorRow* find_integrator(std::string_view name) {
  for (const IntegratorRow& row : integrators()) {
    if (row.name == name) return &row;
  }
  return nullptr;
}

}  // namespace flexcast
