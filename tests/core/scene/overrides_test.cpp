// --set PATH=VALUE: values over those of the file.
#include "tests/core/scene/scene_text.h"

namespace flexcast::test {
namespace {

using Overrides = std::vector<std::string>;

const Body& body(const Scene& scene, std::string_view name) {
  return *find_body(scene.simulation->model(), name);
}

TEST(Override, TakesPathsOfTheSceneFile) {
  const Scene scene = loaded(valid_scene, {"time.step=0.5", "gravity=[0, 0, -3]", "beam.material.young=2e5",
                                           "beam.mesh.cells=[3, 1, 1]", "name=other", "stream.every=4"});
  EXPECT_EQ(scene.name, "other");
  EXPECT_EQ(scene.simulation->settings().time.step, 0.5);
  EXPECT_EQ(scene.simulation->settings().stream.every, 4);
  EXPECT_EQ(scene.simulation->model().gravity, Vec3(0, 0, -3));
  EXPECT_EQ(body(scene, "beam").young, 2e5);
  EXPECT_EQ(body(scene, "beam").particles.count, 16);
}

TEST(Override, TakesNamesOfParameters) {
  const Scene scene = loaded(valid_scene, {"beam.young=3e5", "cloth.stiffness=7", "cloth.damping=0.5",
                                           "cloth.damping.mass=0.25", "beam.damping.stiffness=0.125"});
  EXPECT_EQ(body(scene, "beam").young, 3e5);
  EXPECT_EQ(body(scene, "cloth").stiffness, 7.0);
  EXPECT_EQ(body(scene, "cloth").damping, 0.5);
  EXPECT_EQ(body(scene, "cloth").mass_damping, 0.25);
  EXPECT_EQ(body(scene, "beam").stiffness_damping, 0.125);
}

TEST(Override, ReachesEveryParameterOfTheTable) {
  const Scene scene = loaded(valid_scene);
  for (const ParameterDescriptor& parameter : scene.simulation->parameters()) {
    const std::string assignment = parameter.name + "=" + to_text(scene.simulation->parameter(parameter));
    const auto again = load(valid_scene, {assignment});
    EXPECT_TRUE(again.ok()) << again.error().message;
  }
}

TEST(Override, TakesATableWhereTheFileHasOne) {
  EXPECT_EQ(body(loaded(valid_scene, {"cloth.damping={ mass = 0.75 }"}), "cloth").mass_damping, 0.75);
}

TEST(Override, TakesBareWordsAsText) {
  EXPECT_EQ(loaded(valid_scene, {"time.integrator=rk4"}).simulation->settings().time.integrator, "rk4");
  EXPECT_EQ(loaded(valid_scene, {"time.integrator=\"rk4\""}).simulation->settings().time.integrator, "rk4");
}

TEST(Override, ReplacesTheAlternativeKey) {
  const Scene scene = loaded(valid_scene, {"cloth.total_mass=9", "tip.node=5"});
  EXPECT_EQ(body(scene, "cloth").particle_mass, 1.0);
  EXPECT_EQ(scene.simulation->probes()[0].particle, 5);
}

TEST(Override, TheLastOneWins) {
  EXPECT_EQ(loaded(valid_scene, {"time.step=0.5", "time.step=0.25"}).simulation->settings().time.step, 0.25);
}

TEST(Override, IsNamedByTheErrorsItCauses) {
  EXPECT_EQ(refusal(valid_scene, {"beam.young=-5"}),
            "--set beam.young=-5: [[body]] \"beam\": material.young = -5 is out of range (allowed: > 0, Pa)");
  EXPECT_EQ(refusal(valid_scene, {"gravity=[0, 0, nan]"}),
            "--set gravity=[0, 0, nan]: gravity[2] = nan is out of range (allowed: any finite number, m/s^2)");
  EXPECT_EQ(refusal(valid_scene, {"time.step=fast"}),
            "--set time.step=fast: time.step = \"fast\" is a string; expected a number (> 0, s)");
  EXPECT_EQ(refusal(valid_scene, {"cloth.pin=[ { select = { nodes = [99] } } ]"}),
            "--set cloth.pin=[ { select = { nodes = [99] } } ]: [[body]] \"cloth\": pin[0].select names node 99, which "
            "the body does not have (allowed: 0 to 8)");
  EXPECT_EQ(refusal(valid_scene, {"beam.material.yung=1"}),
            "--set beam.material.yung=1: [[body]] \"beam\": unknown key material.yung = 1 (allowed: law, young, "
            "poisson, density); did you mean \"young\"?");
}

TEST(Override, OfNothingKnownSuggestsWhatThereIs) {
  EXPECT_EQ(refusal(valid_scene, {"baem.young=5"}),
            "--set baem.young=5: there is no baem (known: name, description, gravity, time, solver, stream, beam, "
            "cloth, tip); did you mean \"beam\"?");
}

TEST(Override, MustBePathAndValue) {
  EXPECT_EQ(refusal(valid_scene, {"time.step"}), "--set time.step: expected PATH=VALUE");
  EXPECT_EQ(refusal(valid_scene, {"=3"}), "--set =3: expected PATH=VALUE");
  EXPECT_EQ(refusal(valid_scene, {"time..step=3"}), "--set time..step=3: the path has an empty part");
  EXPECT_EQ(refusal(valid_scene, {"beam=3"}), "--set beam=3: expected a key below beam");
  EXPECT_EQ(refusal(valid_scene, {"gravity.z=3"}),
            "--set gravity.z=3: gravity is an array, which has no keys; set gravity as a whole");
}

TEST(Override, WithAValueThatIsNoneIsRefused) {
  for (const std::string value : {"", "[1, 2", "{", "1 2", "1\nx = 2", "\"open", "0x", "="}) {
    const std::string message = refusal(valid_scene, {"time.step=" + value});
    EXPECT_TRUE(message.starts_with("--set time.step=" + value + ": ")) << message;
  }
}

TEST(Override, LeavesTheSceneTextAsItWas) {
  EXPECT_EQ(loaded(valid_scene, {"time.step=1"}).text, valid_scene);
}

}  // namespace
}  // namespace flexcast::test
