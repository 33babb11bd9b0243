// Random scenes and random batches of parameters, commands and checkpoints. Whatever comes in: nothing that is not
// finite comes out, nothing hangs, a refusal names its cause and changes nothing, a failure names its cause and rolls
// back. FLEXCAST_FUZZ_SCENES in the environment: how many scenes each case tries (default 12500, eight cases).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "core/scene/scene.h"
#include "tests/fuzz/random_scene.h"

namespace flexcast::test {
namespace {

int count_scenes() {
  const char* wanted = std::getenv("FLEXCAST_FUZZ_SCENES");
  return wanted ? std::atoi(wanted) : 12500;
}

bool is_finite(const State& state) {
  const auto good = [](double value) { return std::abs(value) <= 1e38; };
  return std::all_of(state.positions.begin(), state.positions.end(), good) &&
         std::all_of(state.velocities.begin(), state.velocities.end(), good) && std::isfinite(state.time);
}

// Powers of what is far from anything overflow before positions do.
bool is_moderate(const State& state) {
  return state.positions.cwiseAbs().maxCoeff() < 1e20 && state.velocities.cwiseAbs().maxCoeff() < 1e20;
}

// Every number of a report, or the first that is not finite by name.
std::string find_bad_number(const StepReport& r) {
  const std::pair<const char*, double> numbers[] = {{"kinetic", r.kinetic},
                                                    {"elastic", r.elastic},
                                                    {"gravity", r.gravity},
                                                    {"contact", r.contact},
                                                    {"work", r.work},
                                                    {"dissipated", r.dissipated},
                                                    {"numerical", r.numerical},
                                                    {"px", r.momentum.x()},
                                                    {"py", r.momentum.y()},
                                                    {"pz", r.momentum.z()},
                                                    {"Lx", r.angular_momentum.x()},
                                                    {"residual", r.statistics.residual},
                                                    {"min_j", r.min_j.value_or(0.0)},
                                                    {"margin", r.stability_margin.value_or(0.0)}};
  for (const auto& [name, value] : numbers) {
    if (!std::isfinite(value)) return name;
  }
  return "";
}

struct Tally {
  int loaded = 0, refused = 0, failed = 0, batches = 0, refused_batches = 0, restored = 0;
};

// One batch of one to three parameters; a refused one names a parameter and changes nothing.
void try_batch(RandomScene& random, Simulation& simulation, Tally& tally) {
  std::vector<ParameterAssignment> batch;
  const auto& parameters = simulation.parameters();
  for (int i = 0; i <= random.pick(3); ++i) {
    const auto& descriptor = parameters[static_cast<std::size_t>(random.pick(static_cast<int>(parameters.size())))];
    if (descriptor.name == "time.substeps") continue;  // a million substeps are allowed, and take their time
    const bool fits = random.chance(0.8);
    auto value = parse_parameter_value(fits ? random.value_like(descriptor) : random.any_value());
    if (!value) continue;
    // So do thousands of them for a small error.
    if (descriptor.name == "time.tolerance" && std::get_if<double>(&value.value())) {
      double& tolerance = std::get<double>(value.value());
      if (tolerance > 0.0 && tolerance < 0.05) tolerance = 0.05;
    }
    batch.push_back({random.chance(0.02) ? "no.such" : descriptor.name, std::move(value).value()});
  }
  if (batch.empty()) return;
  ++tally.batches;
  const std::uint64_t hash = simulation.calc_state_hash(), revision = simulation.parameter_revision();
  const auto set = simulation.set_parameters(batch);
  if (set) return;
  ++tally.refused_batches;
  const bool named = std::any_of(batch.begin(), batch.end(), [&](const ParameterAssignment& assignment) {
    return set.error().message.find(assignment.name) != std::string::npos;
  });
  EXPECT_TRUE(named) << set.error().message;
  EXPECT_EQ(simulation.calc_state_hash(), hash);
  EXPECT_EQ(simulation.parameter_revision(), revision);
}

void disturb(RandomScene& random, Simulation& simulation, Tally& tally) {
  switch (random.pick(5)) {
    case 0:
    case 1:
      return try_batch(random, simulation, tally);
    case 2: {
      const Vec3 target(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2));
      const auto grabbed = simulation.grab(random.pick(8), target, random.chance(0.5) ? 0.0 : random.uniform(0, 1e3));
      EXPECT_TRUE(grabbed.ok() || !grabbed.error().message.empty());
      return;
    }
    case 3: {
      const auto decoded = decode_checkpoint(encode_checkpoint(simulation.save()));
      ASSERT_TRUE(decoded.ok());
      const std::uint64_t hash = simulation.calc_state_hash();
      ASSERT_TRUE(simulation.restore(decoded.value()).ok());
      EXPECT_EQ(simulation.calc_state_hash(), hash);
      ++tally.restored;
      return;
    }
    default:
      if (random.chance(0.2)) simulation.reset(random.chance(0.5));
  }
}

void try_scene(std::uint64_t seed, Tally& tally) {
  RandomScene random(seed);
  const std::string text = random.make();
  auto scene = load_scene_text(text);
  if (!scene) {
    ++tally.refused;
    // file, and where or what
    EXPECT_TRUE(scene.error().message.starts_with("scene")) << scene.error().message;
    EXPECT_GT(scene.error().message.size(), 20u) << scene.error().message;
    return;
  }
  ++tally.loaded;
  Simulation& simulation = *scene.value().simulation;
  for (int i = 0; i < 3; ++i) {
    const std::uint64_t before = simulation.calc_state_hash();
    const bool moved = simulation.step();
    ASSERT_TRUE(is_finite(simulation.state())) << text;
    if (!moved) {
      ++tally.failed;
      ASSERT_TRUE(simulation.failure().has_value());
      EXPECT_FALSE(simulation.failure()->cause.empty());
      EXPECT_FALSE(simulation.failure()->suggestion.empty());
      EXPECT_EQ(simulation.calc_state_hash(), before) << text;
    }
    if (is_moderate(simulation.state())) {
      ASSERT_EQ(find_bad_number(simulation.calc_report()), "") << text;
    }
    if (!moved && random.chance(0.5)) return;
    disturb(random, simulation, tally);
    ASSERT_TRUE(is_finite(simulation.state())) << text;
  }
}

class Fuzz : public testing::TestWithParam<int> {};

TEST_P(Fuzz, NothingNonFiniteNothingHangsEveryRefusalNamesItsCause) {
  Tally tally;
  const int count = count_scenes();
  for (int i = 0; i < count && !HasFatalFailure() && !HasNonfatalFailure(); ++i) {
    const std::uint64_t seed = 1000003ULL * static_cast<std::uint64_t>(GetParam()) + static_cast<std::uint64_t>(i);
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    try_scene(seed, tally);
  }
  std::printf("%d scenes: %d loaded, %d refused, %d steps failed; %d batches, %d refused; %d restored\n", count,
              tally.loaded, tally.refused, tally.failed, tally.batches, tally.refused_batches, tally.restored);
  // The generator has not become tame or mad.
  EXPECT_GT(tally.loaded, count / 3);
  EXPECT_GT(tally.refused, count / 20);
  EXPECT_GT(tally.failed, 0);
  EXPECT_GT(tally.refused_batches, tally.batches / 20);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Fuzz, testing::Range(0, 8));

}  // namespace
}  // namespace flexcast::test
