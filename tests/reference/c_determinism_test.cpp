// C16: the same input gives the same bytes, and what does not matter physically hardly matters at all.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/integrators/integrator.h"
#include "core/sim/checkpoint.h"
#include "tests/reference/statics.h"
#include "tests/reference/tables.h"
#include "tests/support/random.h"
#include "tests/support/reference.h"

namespace flexcast::test {
namespace {

// Everything at once: tetrahedra of both kinds, springs, a handle, contact with friction, damping.
std::string busy_scene(std::string_view integrator) {
  return concat("name = \"busy\"\ngravity = [0, 0, -9.81]\n[time]\nstep = 1e-3\nintegrator = \"", integrator, "\"\n",
                "[[body]]\nname = \"block\"\nmodel = \"fem\"\nelement = \"tet10\"\n"
                "mesh = { shape = \"beam\", cells = [2, 1, 1], size = [0.4, 0.2, 0.2] }\n"
                "material = { law = \"neo_hookean\", young = 2e4, poisson = 0.4, density = 1000 }\n"
                "damping = { mass = 0.1, stiffness = 1e-4 }\norigin = [0, 0, 0.001]\n"
                "velocity = [ { select = { all = true }, value = [1, 0.5, 0], spin = [0, 0, 3] } ]\n"
                "[[body]]\nname = \"beam\"\nmodel = \"fem\"\n"
                "mesh = { shape = \"beam\", cells = [4, 1, 1], size = [1, 0.25, 0.25] }\n"
                "material = { law = \"corotational\", young = 5e4, poisson = 0.3, density = 1000 }\n"
                "origin = [0, 1, 1]\npin = [ { select = { box = [[0, 1, 1], [0, 2, 2]] } } ]\n"
                "handle = [ { name = \"grip\", select = { box = [[0.99, 1, 1], [2, 2, 2]] }, translate = [0, 0, 0.1], "
                "rotate = [0.5, 0, 0], duration = 0.05 } ]\n"
                "[[body]]\nname = \"net\"\nmodel = \"mass_spring\"\n"
                "mesh = { shape = \"lattice\", cells = [2, 1, 1], size = [0.4, 0.2, 0.2] }\n"
                "springs = { stiffness = 30, damping = 0.1 }\nmass = 0.05\norigin = [2, 0, 0.01]\n"
                "[[contact]]\nname = \"ground\"\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n"
                "friction = 0.3\n");
}

TEST(Reference, C16_TheSameInputTwiceGivesTheSameBytes) {
  for (const IntegratorRow& row : integrators()) {
    SCOPED_TRACE(row.name);
    const auto one = make(busy_scene(row.name)), two = make(busy_scene(row.name));
    for (int i = 0; i < 5; ++i) {
      for (Simulation* simulation : {one.get(), two.get()}) {
        for (int k = 0; k < 10; ++k) simulation->step();
      }
      ASSERT_EQ(encode_checkpoint(one->save()), encode_checkpoint(two->save())) << i;
    }
    EXPECT_EQ(one->calc_state_hash(), two->calc_state_hash());
    EXPECT_EQ(one->calc_report().numerical, two->calc_report().numerical);
    EXPECT_GT(one->state().step, 0);
  }
}

TEST(Reference, C16_ASavedAndRestoredRunGoesOnToTheSameBytes) {
  for (const IntegratorRow& row : integrators()) {
    SCOPED_TRACE(row.name);
    const auto one = make(busy_scene(row.name)), two = make(busy_scene(row.name));
    for (int i = 0; i < 20; ++i) one->step();
    const auto decoded = decode_checkpoint(encode_checkpoint(one->save()));
    ASSERT_TRUE(decoded.ok());
    ASSERT_TRUE(two->restore(decoded.value()).ok());
    for (int i = 0; i < 20; ++i) {
      one->step();
      two->step();
    }
    EXPECT_EQ(encode_checkpoint(one->save()), encode_checkpoint(two->save()));
  }
}

// A bent beam in free flight. Element numbers are those of `order`.
Model make_flying_beam(std::string_view law, bool quadratic) {
  return make_solid_model(make_beam({3, 1, 1}, {1.0, 0.4, 0.4}), {.law = law, .young = 5e4}, quadratic);
}

State make_flight(const Model& model, std::uint64_t seed) {
  SplitMix64 random(seed);
  VecX x = model.rest_positions + make_random_vector(random, model.rest_positions.size(), 0.01);
  return make_state(x, make_random_vector(random, model.rest_positions.size(), 0.5));
}

void shuffle_elements(Model& model, std::uint64_t seed) {
  SplitMix64 random(seed);
  for (std::size_t i = model.tetrahedra.size() - 1; i > 0; --i) {
    const std::size_t j = random.next() % (i + 1);
    std::swap(model.tetrahedra[i], model.tetrahedra[j]);
    if (!model.midsides.empty()) std::swap(model.midsides[i], model.midsides[j]);
  }
}

// What iterates a fixed number of times over constraints in their order is not converged; the others are.
bool is_converged(const IntegratorRow& row) {
  return row.order > 0;
}

TEST(Reference, C16_OrderOfTheTetrahedraDoesNotMatter) {
  for (const bool quadratic : {false, true}) {
    for (const IntegratorRow& row : integrators()) {
      if (!is_converged(row)) continue;
      for (const char* law : {"corotational", "neo_hookean"}) {
        SCOPED_TRACE(concat(row.name, " ", law, quadratic ? " tet10" : " tet4"));
        const Model model = make_flying_beam(law, quadratic);
        Model shuffled = model;
        shuffle_elements(shuffled, 16);
        ASSERT_NE(shuffled.tetrahedra, model.tetrahedra);
        const Settings settings = make_settings(std::string(row.name), 2e-4);
        const State start = make_flight(model, 17);
        const auto one = make_simulation(model, settings, start), two = make_simulation(shuffled, settings, start);
        run(*one, 20);
        run(*two, 20);
        EXPECT_LE(calc_max_error(one->state().positions, two->state().positions), 1e-12);
      }
    }
  }
}

// Moved and turned scenes move and turn alike. The linear law knows its axes and only moves.
TEST(Reference, C16_MovedAndTurnedScenesBehaveAlike) {
  SplitMix64 random(160);
  for (const IntegratorRow& row : integrators()) {
    for (const ReferenceLaw& law : reference_laws()) {
      SCOPED_TRACE(concat(row.name, " ", law.law));
      Model model = make_flying_beam(law.law, random.next() % 2 == 0);
      hold(model, [](const Vec3& X) { return X.x() == 0.0; });
      model.gravity = make_random_vector(random, 10.0);
      const State start = make_flight(model, random.next());
      const Mat3 R = law.law == "linear" ? Mat3(Mat3::Identity()) : make_random_rotation(random);
      const Vec3 shift = make_random_vector(random, 2.0);
      Model moved = model;
      State moved_start = start;
      moved.gravity = R * model.gravity;
      for (std::int64_t i = 0; i < model.particle_count(); ++i) {
        block3(moved.rest_positions, i) = R * block3(model.rest_positions, i) + shift;
        block3(moved_start.positions, i) = R * block3(start.positions, i) + shift;
        block3(moved_start.velocities, i) = R * block3(start.velocities, i);
      }
      Settings settings = make_settings(std::string(row.name), 2e-4);
      settings.solver.newton_tolerance = 1e-13;
      const auto one = make_simulation(model, settings, start), two = make_simulation(moved, settings, moved_start);
      run(*one, 20);
      run(*two, 20);
      for (std::int64_t i = 0; i < model.particle_count(); ++i) {
        const Vec3 expected = R * position(*one, i) + shift;
        ASSERT_LE((position(*two, i) - expected).norm(), 1e-11) << "particle " << i;
      }
    }
  }
}

}  // namespace
}  // namespace flexcast::test
