#include "core/forces/force_table.h"

#include <array>

#include "core/forces/contact.h"
#include "core/forces/dead_load.h"
#include "core/forces/drag.h"
#include "core/forces/grabs.h"
#include "core/forces/gravity.h"
#include "core/forces/springs.h"
#include "core/forces/tetrahedra.h"

namespace flexcast {

std::span<const ForceRow> force_rows() {
  static constexpr std::array table{
      ForceRow{"gravity", "weight of every particle", make_gravity},
      ForceRow{"dead_load", "forces of fixed direction on single particles", make_dead_load},
      ForceRow{"springs", "damped springs relative to their rest length", make_springs},
      ForceRow{"tetrahedra", "tetrahedra of an elastic law, Kelvin-Voigt damping", make_tetrahedra},
      ForceRow{"contact", "solid planes, spheres and boxes, with friction", make_contact},
      ForceRow{"grabs", "particles pulled to a target", make_grabs},
      ForceRow{"drag", "damping against the resting world", make_drag},
  };
  return table;
}

}  // namespace flexcast
