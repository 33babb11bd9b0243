// A simulation that was saved goes on as if nothing had happened, to the last
// bit, wherever it is restored; what is not a whole checkpoint of the same
// scene is refused and changes nothing.
#include "core/sim/checkpoint.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/integrators/integrator.h"
#include "tests/support/everything.h"

namespace flexcast::test {
namespace {

using Assignments = std::vector<ParameterAssignment>;

constexpr std::int32_t grabbed = 7;  // of the beam

// At step 12, with a particle grabbed at step 6: the grip moves, the jump has
// yet to come.
std::unique_ptr<Simulation> make_running(std::string_view integrator) {
  auto simulation = make(everything_text(integrator));
  run(*simulation, 6);
  if (!simulation->grab(grabbed, Vec3(0.5, 0.1, 0.6))) throw std::runtime_error("no grab");
  run(*simulation, 6);
  return simulation;
}

// All but what the last step cost, which is unknown right after restoring, and
// the margin, which is looked up now and then.
void expect_same_report(const StepReport& a, const StepReport& b) {
  EXPECT_EQ(a.step, b.step);
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(a.kinetic, b.kinetic);
  EXPECT_EQ(a.elastic, b.elastic);
  EXPECT_EQ(a.gravity, b.gravity);
  EXPECT_EQ(a.contact, b.contact);
  EXPECT_EQ(a.work, b.work);
  EXPECT_EQ(a.dissipated, b.dissipated);
  EXPECT_EQ(a.numerical, b.numerical);
  EXPECT_EQ(a.momentum, b.momentum);
  EXPECT_EQ(a.angular_momentum, b.angular_momentum);
  EXPECT_EQ(a.inverted, b.inverted);
  EXPECT_EQ(a.min_j, b.min_j);
}

void expect_same_steps(Simulation& a, Simulation& b, int steps) {
  expect_same_report(a.calc_report(), b.calc_report());
  for (int i = 0; i < steps; ++i) {
    run(a, 1);
    run(b, 1);
    ASSERT_EQ(a.calc_state_hash(), b.calc_state_hash()) << "step " << a.state().step;
    const StepReport ra = a.calc_report(), rb = b.calc_report();
    expect_same_report(ra, rb);
    EXPECT_EQ(ra.statistics.residual, rb.statistics.residual);
    EXPECT_EQ(ra.statistics.iterations, rb.statistics.iterations);
    EXPECT_EQ(ra.statistics.converged, rb.statistics.converged);
  }
}

class CheckpointOf : public testing::TestWithParam<IntegratorRow> {
 protected:
  const std::string scheme_{GetParam().name};
};

TEST_P(CheckpointOf, GoesOnToTheSameBitsHereAndInAnotherSimulation) {
  const auto simulation = make_running(scheme_), untouched = make_running(scheme_);
  const std::uint64_t revision = simulation->parameter_revision();
  const Checkpoint checkpoint = simulation->save();
  run(*simulation, 15);
  ASSERT_TRUE(simulation->restore(checkpoint).ok());
  EXPECT_GT(simulation->parameter_revision(), revision);
  expect_same_steps(*simulation, *untouched, 12);

  const auto other = make(everything_text(scheme_)), again = make_running(scheme_);
  ASSERT_TRUE(other->restore(checkpoint).ok());
  EXPECT_EQ(other->grabs().size(), 1u);
  expect_same_steps(*other, *again, 12);
}

TEST_P(CheckpointOf, SurvivesEncodingAndAFile) {
  const auto simulation = make_running(scheme_);
  const auto path = std::filesystem::path(testing::TempDir()) / ("flexcast_checkpoint_" + scheme_ + ".flexckpt");
  ASSERT_TRUE(write_checkpoint(path, simulation->save()).ok());
  const auto read = read_checkpoint(path);
  std::filesystem::remove(path);
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_TRUE(encode_checkpoint(read.value()) == encode_checkpoint(simulation->save()));
  const auto other = make(everything_text(scheme_));
  ASSERT_TRUE(other->restore(read.value()).ok());
  expect_same_steps(*other, *simulation, 10);
}

// Whatever was changed before it was saved.
TEST_P(CheckpointOf, CarriesLiveValuesStepAndTime) {
  const auto simulation = make_running(scheme_);
  ASSERT_TRUE(simulation
                  ->set_parameters(Assignments{{"time.step", 3e-4},
                                               {"time.substeps", std::int64_t{2}},
                                               {"rope.stiffness", 40.0},
                                               {"handle.grip.translate", Vec3(0.1, 0, 0)},
                                               {"contact.ground.friction", 0.9}})
                  .ok());
  run(*simulation, 7);
  const auto other = make(everything_text("rk4"));
  ASSERT_TRUE(other->restore(simulation->save()).ok());
  EXPECT_EQ(other->settings().time.integrator, scheme_);
  expect_same_steps(*other, *simulation, 10);
}

// A value that is allowed and not the present one.
ParameterValue make_changed(const ParameterDescriptor& descriptor, const ParameterValue& value) {
  const std::vector<std::string>& choices = descriptor.row->choices;
  if (const auto* name = std::get_if<std::string>(&value)) {
    const auto at = std::find(choices.begin(), choices.end(), *name);
    return at + 1 == choices.end() ? choices.front() : *(at + 1);
  }
  if (const auto* number = std::get_if<double>(&value)) return *number == 0.0 ? 1e-3 : 0.9 * *number;
  if (const auto* count = std::get_if<std::int64_t>(&value)) return *count + 1;
  return ParameterValue(Vec3(1.05 * std::get<Vec3>(value) + Vec3(0.01, 0.02, 0.01)));
}

TEST_P(CheckpointOf, WithAChangedValueIsTheSameAsTheChangeOnTheWay) {
  const auto simulation = make_running(scheme_), other = make(everything_text(scheme_));
  const Checkpoint checkpoint = simulation->save();
  for (const ParameterDescriptor& descriptor : simulation->parameters()) {
    if (!descriptor.row->live) continue;
    ASSERT_TRUE(simulation->restore(checkpoint).ok());
    const Assignments change = {{descriptor.name, make_changed(descriptor, simulation->parameter(descriptor))}};
    SCOPED_TRACE(descriptor.name + " = " + to_text(change[0].value));
    const auto live = make_running(scheme_);
    ASSERT_TRUE(live->set_parameters(change).ok());
    ASSERT_TRUE(other->restore(checkpoint).ok());
    ASSERT_TRUE(other->set_parameters(change).ok());
    EXPECT_EQ(other->calc_state_hash(), live->calc_state_hash());
    run(*live, 3);
    run(*other, 3);
    EXPECT_EQ(other->calc_state_hash(), live->calc_state_hash());
    expect_same_report(other->calc_report(), live->calc_report());
  }
}

INSTANTIATE_TEST_SUITE_P(EveryScheme, CheckpointOf, testing::ValuesIn(integrators().begin(), integrators().end()),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(Checkpoint, OfTheStartIsAReset) {
  const auto simulation = make(everything_text("bdf2"));
  const Checkpoint start = simulation->save();
  run(*simulation, 10);
  const std::uint64_t hash = simulation->calc_state_hash();
  ASSERT_TRUE(simulation->restore(start).ok());
  run(*simulation, 10);
  EXPECT_EQ(simulation->calc_state_hash(), hash);
}

std::string replaced(std::string text, std::string_view part, std::string_view by) {
  text.replace(text.find(part), part.size(), by);
  return text;
}

TEST(Checkpoint, OfAnotherSceneIsRefusedAndChangesNothing) {
  const std::string text = everything_text("symplectic_euler");
  const auto simulation = make_running("symplectic_euler");
  const std::string before = encode_checkpoint(simulation->save());
  const std::uint64_t revision = simulation->parameter_revision();
  const std::pair<const char*, const char*> changes[] = {
      {"cells = [5], size = [1.0]", "cells = [4], size = [1.0]"},
      {"size = [0.9, 0.3, 0.3]", "size = [0.9, 0.3, 0.31]"},
      {"origin = [0.1, 0.9, 0.25]", "origin = [0.1, 0.9, 0.26]"},
      {"axes = \"y\"", "axes = \"z\""},
      {"value = 3.0", "value = 4.0"},
      {"value = [0, 2.0, 0]", "value = [0, 2.5, 0]"},
      {"spin = [0, 1, 2]", "spin = [0, 1, 3]"},
      {"element = \"tet10\"", "element = \"tet4\""},
      {"name = \"crate\"", "name = \"chest\""},
      {"name = \"grip\", select = { nodes = [0, 1] }", "name = \"grip\", select = { nodes = [0, 2] }"}};
  for (const auto& [part, by] : changes) {
    SCOPED_TRACE(by);
    const auto other = make(replaced(text, part, by));
    const auto result = simulation->restore(other->save());
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().message,
              "the checkpoint belongs to another scene, or to this one before "
              "it was changed");
    EXPECT_TRUE(encode_checkpoint(simulation->save()) == before);
  }
  EXPECT_EQ(simulation->parameter_revision(), revision);
  // What can be set while it runs is no other scene.
  EXPECT_TRUE(simulation->restore(make(replaced(text, "young = 2e4", "young = 9e4"))->save()).ok());
  EXPECT_EQ(simulation->model().bodies[0].young, 9e4);
}

TEST(Checkpoint, WithContentsThatAreNotAllowedIsRefusedAndChangesNothing) {
  const auto simulation = make_running("bdf2");
  const Checkpoint good = simulation->save();
  const std::string before = encode_checkpoint(good);
  const auto refuse = [&](const char* what, auto change) {
    Checkpoint bad = good;
    change(bad);
    EXPECT_FALSE(simulation->restore(bad).ok()) << what;
    EXPECT_TRUE(encode_checkpoint(simulation->save()) == before) << what;
  };
  refuse("unknown parameter", [](Checkpoint& c) { c.values.push_back({"beam.colour", 1.0}); });
  refuse("out of range", [](Checkpoint& c) { c.values.push_back({"beam.young", -1.0}); });
  refuse("wrong kind", [](Checkpoint& c) { c.values.push_back({"beam.young", std::string("stiff")}); });
  refuse("plane without normal", [](Checkpoint& c) { c.values.push_back({"contact.ground.normal", Vec3(0, 0, 0)}); });
  refuse("positions", [](Checkpoint& c) { c.state.positions.conservativeResize(3); });
  refuse("velocities", [](Checkpoint& c) { c.state.velocities.resize(0); });
  refuse("positions that are no numbers", [](Checkpoint& c) { c.state.positions[3] = NAN; });
  refuse("time that is no number", [](Checkpoint& c) { c.state.time = NAN; });
  refuse("history cut short", [](Checkpoint& c) { c.history.conservativeResize(4); });
  refuse("grab of no particle", [](Checkpoint& c) { c.grabs[0].particle = 1 << 30; });
  refuse("grab of a particle before the first", [](Checkpoint& c) { c.grabs[0].particle = -1; });
  refuse("grab of a pinned particle", [](Checkpoint& c) { c.grabs[0].particle = 4; });
  refuse("grab without stiffness", [](Checkpoint& c) { c.grabs[0].stiffness = -1.0; });
  refuse("two grabs of a particle", [](Checkpoint& c) { c.grabs.push_back(c.grabs[0]); });
}

std::string message_of(std::string_view bytes) {
  const auto result = decode_checkpoint(bytes);
  return result ? "" : result.error().message;
}

TEST(Checkpoint, CutShortAtAnyLengthIsRefused) {
  const std::string bytes = encode_checkpoint(make_running("bdf2")->save());
  EXPECT_EQ(message_of(bytes), "");
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    const std::string message = message_of(std::string_view(bytes).substr(0, length));
    ASSERT_EQ(message, length < 20 ? "this is not a checkpoint"
                                   : "the checkpoint is damaged or cut short: "
                                     "its checksum does not fit");
  }
  EXPECT_NE(message_of(bytes + "x"), "");
}

TEST(Checkpoint, WithAnyByteFlippedIsRefused) {
  const std::string bytes = encode_checkpoint(make_running("bdf2")->save());
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string bad = bytes;
    bad[i] = static_cast<char>(bad[i] ^ (1 << (i % 8)));
    ASSERT_NE(message_of(bad), "") << i;
  }
}

TEST(Checkpoint, OfAnotherVersionIsNamed) {
  std::string bytes = encode_checkpoint(make_running("rk4")->save());
  bytes[8] = 7;
  EXPECT_EQ(message_of(bytes), "the checkpoint has version 7; this program reads version 2");
}

TEST(Checkpoint, FilesThatAreNoneAreNamed) {
  const std::filesystem::path folder = testing::TempDir();
  const auto missing = read_checkpoint(folder / "flexcast_no_such.flexckpt");
  ASSERT_FALSE(missing.ok());
  EXPECT_EQ(missing.error().message,
            (folder / "flexcast_no_such.flexckpt").string() + ": cannot be read: No such file or directory");
  const auto text = folder / "flexcast_text.flexckpt";
  for (const char* content : {"", "a line of text that is long enough"}) {
    std::ofstream(text) << content;
    const auto read = read_checkpoint(text);
    ASSERT_FALSE(read.ok());
    EXPECT_EQ(read.error().message, text.string() + ": this is not a checkpoint");
  }
  std::filesystem::remove(text);
  EXPECT_FALSE(read_checkpoint(folder).ok());
  const auto unwritable = write_checkpoint(folder / "no" / "such" / "folder", make_running("rk4")->save());
  ASSERT_FALSE(unwritable.ok());
  EXPECT_NE(unwritable.error().message.find("cannot be written: No such file or directory"), std::string::npos);
}

}  // namespace
}  // namespace flexcast::test
