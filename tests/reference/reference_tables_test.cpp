#include "tests/reference/tables.h"

#include <gtest/gtest.h>

namespace flexcast::test {
namespace {

TEST(Reference, TheTablesCoverTheLawsAndSchemesTheEngineIsBuiltOn) {
  for (const char* law : {"linear", "corotational"}) EXPECT_NE(find_law(law), nullptr) << law;
  for (const char* scheme : {"forward_euler", "symplectic_euler", "velocity_verlet", "rk4", "backward_euler"}) {
    EXPECT_TRUE(engine_has_integrator(scheme)) << scheme;
  }
}

TEST(Reference, EveryLawOfTheEngineHasReferenceValues) {
  EXPECT_EQ(reference_laws().size(), laws().size());
}

}  // namespace
}  // namespace flexcast::test
