#include "core/integrators/particle_passes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/parallel.h"
#include "tests/support/scene.h"

namespace flexcast::test {
namespace {

// 1,369 particles: more than a block, and no multiple of eight numbers. Two corners are held.
class ParticlePass : public testing::Test {
 protected:
  ParticlePass()
      : simulation_(make("name = \"net\"\n[time]\nstep = 1e-3\n[[body]]\nname = \"net\"\nmodel = \"mass_spring\"\n"
                         "mesh = { shape = \"grid\", cells = [36, 36], size = [1, 1] }\n"
                         "springs = { stiffness = 10, damping = 0 }\nmass = 0.05\n"
                         "pin = [ { select = { nodes = [0, 36] } } ]\n")),
        system_(simulation_->model()),
        start_(simulation_->state()) {
    F_ = VecX::LinSpaced(system_.dofs(), -1.0, 2.0);
    start_.velocities = VecX::LinSpaced(system_.dofs(), 3.0, -1.0).cwiseProduct(system_.free());
  }

  std::unique_ptr<Simulation> simulation_;
  System system_;
  State start_;
  VecX F_;
  ParticlePasses passes_;
  StepStatistics statistics_;
};

TEST_F(ParticlePass, KicksAndDriftsAsTheFormulaSays) {
  State end = start_;
  passes_.kick_and_drift(system_, {0.01, 0.02}, F_, start_, end, statistics_);
  const VecX v = start_.velocities + 0.01 * system_.inverse_masses().cwiseProduct(F_);
  const VecX x = start_.positions + 0.02 * v;
  EXPECT_EQ(end.velocities, v);
  EXPECT_EQ(end.positions, x);
  const double work = 0.5 * 0.01 * F_.dot(start_.velocities + v);
  EXPECT_NEAR(statistics_.force_work, work, 1e-13 * F_.norm() * v.norm());
}

TEST_F(ParticlePass, DriftsWithTheOldVelocitiesWhereAsked) {
  State end = start_;
  passes_.drift_and_kick(system_, 0.01, F_, start_, end, statistics_);
  EXPECT_EQ(end.positions, VecX(start_.positions + 0.01 * start_.velocities));
  EXPECT_EQ(end.velocities, VecX(start_.velocities + 0.01 * system_.inverse_masses().cwiseProduct(F_)));
}

TEST_F(ParticlePass, GivesTheSameBitsInPlace) {
  State end = start_, place = start_;
  StepStatistics of_place;
  passes_.kick_and_drift(system_, {0.01, 0.01}, F_, start_, end, statistics_);
  passes_.kick_and_drift(system_, {0.01, 0.01}, F_, place, place, of_place);
  EXPECT_EQ(place.positions, end.positions);
  EXPECT_EQ(place.velocities, end.velocities);
  EXPECT_EQ(of_place.force_work, statistics_.force_work);
}

TEST_F(ParticlePass, FollowsADisplacementAndBooksTheChangeOfKineticEnergy) {
  State end = start_;
  const VecX u = 1e-3 * F_.cwiseProduct(system_.free());
  const DisplacementRule rule{.reach = 2.0, .time = 1.0 / 400.0, .past = 1.0};
  passes_.follow(system_, 0.01, rule, start_.positions, u, F_, end, statistics_);
  EXPECT_EQ(end.positions, VecX(start_.positions + 2.0 * u));
  EXPECT_EQ(end.velocities, VecX(u / (1.0 / 400.0) - start_.velocities));
  const double change = system_.calc_kinetic(end.velocities) - system_.calc_kinetic(start_.velocities);
  EXPECT_NEAR(statistics_.force_work, change, 1e-12 * system_.calc_kinetic(end.velocities));
}

TEST_F(ParticlePass, TheBooksOfAStateThatMustNotBePublishedAreNoNumber) {
  for (const double bad : {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN(), 2e38}) {
    for (const std::int64_t at : {std::int64_t{200}, system_.dofs() - 7}) {
      State end = start_, from = start_;
      from.positions[at] = bad;
      statistics_ = {};
      passes_.kick_and_drift(system_, {0.01, 0.01}, F_, from, end, statistics_);
      EXPECT_TRUE(std::isnan(statistics_.force_work)) << bad;
      from = start_;
      from.velocities[at] = -bad;
      statistics_ = {};
      passes_.kick(system_, 0.01, F_, from.positions, from.velocities, end.velocities, statistics_);
      EXPECT_TRUE(std::isnan(statistics_.force_work)) << bad;
    }
  }
}

}  // namespace
}  // namespace flexcast::test
