// Which name of the reference data belongs to which row of the engine's tables. Rows the engine does not have yet are
// left out of every loop; reference_tables_test.cpp says which must be there.
#pragma once

#include <string_view>
#include <vector>

#include "core/materials/law.h"
#include "tests/support/scene.h"

namespace flexcast::test {

struct ReferenceLaw {
  std::string_view law;
  std::string_view key;
};

inline std::vector<ReferenceLaw> reference_laws() {
  std::vector<ReferenceLaw> known;
  for (const ReferenceLaw& row :
       {ReferenceLaw{"linear", "linear"}, ReferenceLaw{"corotational", "corot"},
        ReferenceLaw{"st_venant_kirchhoff", "stvk"}, ReferenceLaw{"neo_hookean", "snh_log"}}) {
    if (find_law(row.law) != nullptr) known.push_back(row);
  }
  return known;
}

struct ReferenceScheme {
  std::string_view integrator;
  std::string_view key;
  int order;
};

inline std::vector<ReferenceScheme> reference_schemes() {
  std::vector<ReferenceScheme> known;
  for (const ReferenceScheme& row :
       {ReferenceScheme{"forward_euler", "fe", 1}, ReferenceScheme{"symplectic_euler", "se", 1},
        ReferenceScheme{"velocity_verlet", "vv", 2}, ReferenceScheme{"rk4", "rk4", 4},
        ReferenceScheme{"backward_euler", "be", 1}, ReferenceScheme{"implicit_midpoint", "im", 2},
        ReferenceScheme{"bdf2", "bdf2", 2}}) {
    if (engine_has_integrator(row.integrator)) known.push_back(row);
  }
  return known;
}

}  // namespace flexcast::test
