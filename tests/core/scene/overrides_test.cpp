// --set PATH=VALUE: values over those of the file.
#include <set>

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

// With an obstacle of each shape and a handle.
const std::string rich_scene = with_spring_lines(
    "handle = [ { name = \"grip\", select = { nodes = [0] } } ]\n"
    "[[contact]]\nname = \"ground\"\nshape = \"plane\"\npoint = [0, 0, -1]\nnormal = [0, 0, 1]\n"
    "[[contact]]\nname = \"ball\"\nshape = \"sphere\"\ncenter = [9, 0, 0]\nradius = 1.0\n"
    "[[contact]]\nname = \"crate\"\nshape = \"box\"\nlo = [5, 0, 0]\nhi = [6, 1, 1]\n");

TEST(Override, ReachesEveryParameterOfTheTable) {
  const Scene scene = loaded(rich_scene);
  std::set<const ParameterRow*> reached;
  for (const ParameterDescriptor& parameter : scene.simulation->parameters()) {
    const std::string assignment = parameter.name + "=" + to_text(scene.simulation->parameter(parameter));
    const auto again = load(rich_scene, {assignment});
    EXPECT_TRUE(again.ok()) << again.error().message;
    reached.insert(parameter.row);
  }
  EXPECT_EQ(reached.size(), parameter_rows().size());
}

TEST(Override, FindsContactsAndHandlesByTheirNames) {
  const Scene scene = loaded(rich_scene, {"contact.ground.friction=0.5", "contact.ball.radius=2",
                                          "contact.crate.hi=[7, 1, 1]", "handle.grip.translate=[0, 0, 1]",
                                          "handle.grip.duration=3", "handle.grip.select={ nodes = [1, 2] }"});
  const Model& model = scene.simulation->model();
  EXPECT_EQ(model.obstacles[0].friction, 0.5);
  EXPECT_EQ(model.obstacles[1].radius, 2.0);
  EXPECT_EQ(model.obstacles[2].hi, Vec3(7, 1, 1));
  EXPECT_EQ(model.handles[0].translate, Vec3(0, 0, 1));
  EXPECT_EQ(model.handles[0].duration, 3.0);
  EXPECT_EQ(model.handles[0].particles.size(), 2u);
}

TEST(Override, TakesElementAndLaw) {
  const Scene scene = loaded(valid_scene, {"beam.element=tet10", "beam.law=corotational"});
  EXPECT_TRUE(body(scene, "beam").is_quadratic());
  EXPECT_EQ(body(scene, "beam").law, find_law("corotational"));
}

TEST(Override, TakesAllContactsAsAWhole) {
  EXPECT_TRUE(loaded(rich_scene, {"contact=[]"}).simulation->model().obstacles.empty());
}

TEST(Override, OfAContactOrHandleThatIsNotThereSuggestsWhatThereIs) {
  EXPECT_EQ(refusal(rich_scene, {"contact.grund.friction=1"}),
            "--set contact.grund.friction=1: there is no contact grund (known: ground, ball, crate); did you mean "
            "\"ground\"?");
  EXPECT_EQ(refusal(rich_scene, {"handle.grap.start=1"}),
            "--set handle.grap.start=1: there is no handle grap (known: grip); did you mean \"grip\"?");
  EXPECT_EQ(refusal(valid_scene, {"contact.ground.friction=1"}),
            "--set contact.ground.friction=1: there is no contact ground");
  EXPECT_EQ(refusal(rich_scene, {"handle.grip=1"}), "--set handle.grip=1: expected handle.NAME.KEY=VALUE");
  EXPECT_EQ(refusal(rich_scene, {"handle=1"}), "--set handle=1: expected handle.NAME.KEY=VALUE");
  EXPECT_EQ(refusal(rich_scene, {"contact.ground.friction=-1"}),
            "--set contact.ground.friction=-1: [[contact]] \"ground\": friction = -1 is out of range (allowed: >= 0)");
  EXPECT_EQ(refusal(rich_scene, {"handle.grip.start=-1"}),
            "--set handle.grip.start=-1: [[body]] \"cloth\": handle[0].start = -1 is out of range (allowed: >= 0, s)");
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
            "--set baem.young=5: there is no baem (known: name, description, gravity, time, solver, contact, stream, exact, "
            "beam, cloth, tip); did you mean \"beam\"?");
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
