// C12 and the input side of C02: what cannot be simulated is refused with a reason, and the next scene is served.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/support/scene.h"

namespace flexcast::test {
namespace {

// A good scene whose parts can be exchanged one by one.
struct BeamScene {
  std::string step = "1e-3";
  std::string mesh = "{ shape = \"beam\", cells = [2, 1, 1], size = [1, 0.5, 0.5] }";
  std::string law = "\"corotational\"", young = "1e4", poisson = "0.3", density = "1000.0";
  std::string more{};  // of the body
  std::string time{};  // more of [time]
  std::string top{};   // more at the top

  std::string text() const {
    return "name = \"beam\"\n" + top + "[time]\nstep = " + step + "\n" + time +
           "[[body]]\nname = \"beam\"\nmodel = \"fem\"\nmesh = " + mesh + "\nmaterial = { law = " + law +
           ", young = " + young + ", poisson = " + poisson + ", density = " + density + " }\n" + more;
  }
};

struct SpringScene {
  std::string stiffness = "100", damping = "0.1", mass = "0.1", more{};

  std::string text() const {
    return "name = \"rope\"\n[[body]]\nname = \"rope\"\nmodel = \"mass_spring\"\n"
           "mesh = { shape = \"rope\", cells = [3], size = [1] }\nsprings = { stiffness = " +
           stiffness + ", damping = " + damping + " }\nmass = " + mass + "\n" + more;
  }
};

void expect_served() {
  const auto simulation =
      make(BeamScene{.more = "velocity = [ { select = { all = true }, value = [1, 0, 0] } ]\n"}.text());
  run(*simulation, 10);
  EXPECT_NEAR(position(*simulation, 0).x(), 0.01, 1e-12);
}

// The message must name the key.
void expect_refused(const std::string& scene, const std::string& key) {
  const Result<Scene> result = load_scene_text(scene);
  ASSERT_FALSE(result.ok()) << scene;
  EXPECT_NE(result.error().message.find(key), std::string::npos) << "key " << key << ": " << result.error().message;
}

TEST(Reference, C12_GoodScenesOfThisPageLoad) {
  expect_served();
  run(*make(SpringScene{}.text()), 10);
}

TEST(Reference, C12_MaterialsOutOfRangeAreRefusedByName) {
  for (const char* bad : {"0", "-1e4", "nan", "inf", "-inf"}) {
    expect_refused(BeamScene{.young = bad}.text(), "young");
    expect_refused(BeamScene{.density = bad}.text(), "density");
  }
  for (const char* bad : {"0.5", "0.7", "-1", "-1.0", "-3", "nan", "inf"}) {
    expect_refused(BeamScene{.poisson = bad}.text(), "poisson");
  }
  expect_refused(BeamScene{.law = "\"jelly\""}.text(), "law");
  expect_refused(BeamScene{.young = "\"stiff\""}.text(), "young");
  expect_served();
}

TEST(Reference, C12_SpringsAndMassesOutOfRangeAreRefusedByName) {
  for (const char* bad : {"-1", "nan", "inf"}) {
    expect_refused(SpringScene{.stiffness = bad}.text(), "stiffness");
    expect_refused(SpringScene{.damping = bad}.text(), "damping");
  }
  for (const char* bad : {"0", "0.0", "-0.1", "nan", "inf"}) {
    expect_refused(SpringScene{.mass = bad}.text(), "mass");
    const std::string one = std::string("particle_mass = [ { select = { nodes = [1] }, value = ") + bad + " } ]\n";
    expect_refused(SpringScene{.more = one}.text(), "particle_mass");
  }
  expect_served();
}

TEST(Reference, C12_StepsOutOfRangeAreRefusedByName) {
  for (const char* bad : {"0", "0.0", "-1e-3", "inf", "nan"}) expect_refused(BeamScene{.step = bad}.text(), "step");
  for (const char* bad : {"0", "-1", "1.5", "nan"}) {
    expect_refused(BeamScene{.time = std::string("substeps = ") + bad + "\n"}.text(), "substeps");
  }
  expect_refused(BeamScene{.time = "integrator = \"leapfrog\"\n"}.text(), "integrator");
  expect_served();
}

TEST(Reference, C12_NonFiniteStatesAndLoadsAreRefusedByName) {
  for (const char* bad : {"nan", "inf", "-inf"}) {
    const std::string vector = std::string("[0, ") + bad + ", 0]";
    for (const char* key : {"displacement", "velocity", "force", "surface_force"}) {
      expect_refused(
          BeamScene{.more = std::string(key) + " = [ { select = { all = true }, value = " + vector + " } ]\n"}.text(),
          key);
    }
    expect_refused(BeamScene{.more = "origin = " + vector + "\n"}.text(), "origin");
    expect_refused(BeamScene{.more = "rotation = " + vector + "\n"}.text(), "rotation");
    expect_refused(BeamScene{.more = std::string("drag = ") + bad + "\n"}.text(), "drag");
    expect_refused(BeamScene{.more = std::string("damping = { mass = ") + bad + " }\n"}.text(), "mass");
    expect_refused(BeamScene{.top = "gravity = " + vector + "\n"}.text(), "gravity");
  }
  expect_served();
}

TEST(Reference, C12_NodesOutOfRangeAndEmptySelectionsAreRefused) {
  for (const char* nodes : {"[12]", "[-1]", "[0, 99999999999]", "[]"}) {
    expect_refused(BeamScene{.more = std::string("pin = [ { select = { nodes = ") + nodes + " } } ]\n"}.text(), "pin");
  }
  expect_refused(BeamScene{.more = "pin = [ { select = { sphere = [9, 9, 9, 0.1] } } ]\n"}.text(), "pin");
  expect_served();
}

TEST(Reference, C12_MeshesWithoutElementsOrSizeAreRefused) {
  for (const char* cells : {"[0, 1, 1]", "[2, -1, 1]", "[2, 1]", "[]", "[1.5, 1, 1]"}) {
    expect_refused(
        BeamScene{.mesh = std::string("{ shape = \"beam\", cells = ") + cells + ", size = [1, 1, 1] }"}.text(),
        "cells");
  }
  for (const char* size : {"[0, 1, 1]", "[1, -1, 1]", "[1, nan, 1]", "[1, 1, inf]", "[1, 1]"}) {
    expect_refused(
        BeamScene{.mesh = std::string("{ shape = \"beam\", cells = [2, 1, 1], size = ") + size + " }"}.text(), "size");
  }
  expect_served();
}

TEST(Reference, C12_ScenesWithoutBodiesAreRefusedOrEmptyButNeverBreak) {
  for (const std::string& text : {std::string(), std::string("name = \"x\"\n"), std::string("= = ="),
                                  std::string("name = \"x\"\nbody = 3\n"), std::string("\0\xff\xfe", 3)}) {
    const Result<Scene> result = load_scene_text(text);
    if (result.ok()) {
      run(*result.value().simulation, 3);
    } else {
      EXPECT_FALSE(result.error().message.empty());
    }
  }
  expect_served();
}

TEST(Reference, C12_DenormalInputsAreRefusedOrStayFinite) {
  const std::string tiny = "5e-324";
  for (const std::string& text :
       {BeamScene{.density = tiny}.text(), BeamScene{.young = tiny}.text(), BeamScene{.step = tiny}.text(),
        SpringScene{.mass = tiny}.text(), SpringScene{.stiffness = tiny}.text(),
        BeamScene{.mesh = "{ shape = \"beam\", cells = [1, 1, 1], size = [5e-324, 5e-324, 5e-324] }"}.text(),
        BeamScene{.mesh = "{ shape = \"beam\", cells = [1, 1, 1], size = [1e-160, 1e-160, 1e-160] }"}.text(),
        SpringScene{.mass = "1e-310", .more = "displacement = [ { select = { nodes = [1] }, value = [0.1, 0, 0] } ]\n"}
            .text()}) {
    SCOPED_TRACE(text);
    const Result<Scene> result = load_scene_text(text);
    if (!result.ok()) continue;
    Simulation& simulation = *result.value().simulation;
    for (int i = 0; i < 5; ++i) {
      if (!simulation.step()) {
        EXPECT_FALSE(simulation.failure()->cause.empty());
      }
      EXPECT_TRUE(simulation.state().positions.allFinite());
      EXPECT_TRUE(simulation.state().velocities.allFinite());
      const StepReport report = simulation.calc_report();
      EXPECT_TRUE(std::isfinite(report.kinetic) && std::isfinite(report.elastic));
    }
    EXPECT_FALSE(std::isnan(simulation.calc_stable_step()));
  }
  expect_served();
}

TEST(Reference, C12_ParameterBatchesWithOneBadValueChangeNothing) {
  const auto simulation = make(BeamScene{}.text());
  run(*simulation, 5);
  const std::uint64_t hash = simulation->calc_state_hash();
  const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<ParameterAssignment> bad = {
      {"beam.young", nan},    {"beam.young", inf},          {"beam.young", -1.0},
      {"beam.young", 0.0},    {"beam.poisson", 0.5},        {"beam.poisson", nan},
      {"beam.density", 0.0},  {"time.step", 0.0},           {"time.step", nan},
      {"time.step", inf},     {"gravity", Vec3(0, nan, 0)}, {"gravity", Vec3(inf, 0, 0)},
      {"gravity", 1.0},       {"time.integrator", "bogus"}, {"time.substeps", std::int64_t{0}},
      {"no.such.thing", 1.0}, {"beam.young", "very"},       {"", 1.0}};
  for (const ParameterAssignment& assignment : bad) {
    SCOPED_TRACE(assignment.name + " = " + to_text(assignment.value));
    const std::vector<ParameterAssignment> batch = {{"gravity", Vec3(0, 0, -1)}, {"beam.young", 2e4}, assignment};
    const Result<void> result = simulation->set_parameters(batch);
    ASSERT_FALSE(result.ok());
    EXPECT_NE(result.error().message.find(assignment.name), std::string::npos) << result.error().message;
    EXPECT_EQ(simulation->model().gravity, Vec3::Zero());
    EXPECT_EQ(simulation->model().bodies[0].young, 1e4);
    EXPECT_EQ(simulation->settings().time.step, 1e-3);
    EXPECT_EQ(simulation->parameter_revision(), 1u);
    EXPECT_EQ(simulation->calc_state_hash(), hash);
  }
  run(*simulation, 5);
  expect_served();
}

// Mesh files, written where nothing else is.
class MeshFolder {
 public:
  MeshFolder() : path_(std::filesystem::path(testing::TempDir()) / concat("flexcast-reference-", getpid())) {
    std::filesystem::create_directories(path_);
  }
  ~MeshFolder() { std::filesystem::remove_all(path_); }

  // A TetGen pair "mesh", numbered from 0.
  Result<Scene> load(const std::vector<std::string>& nodes, const std::vector<std::string>& tetrahedra) const {
    std::ofstream node_file(path_ / "mesh.node"), element_file(path_ / "mesh.ele");
    node_file << nodes.size() << " 3 0 0\n";
    for (std::size_t i = 0; i < nodes.size(); ++i) node_file << i << " " << nodes[i] << "\n";
    element_file << tetrahedra.size() << " 4 0\n";
    for (std::size_t i = 0; i < tetrahedra.size(); ++i) element_file << i << " " << tetrahedra[i] << "\n";
    node_file.close();
    element_file.close();
    return load_scene_text(BeamScene{.mesh = "{ file = \"mesh.node\" }"}.text(), "scene", path_);
  }

 private:
  std::filesystem::path path_;
};

// Two tetrahedra on one triangle.
const std::vector<std::string> good_nodes = {"0 0 0", "1 0 0", "0 1 0", "0 0 1", "0 0 -1", "1 1 0"};
const std::vector<std::string> good_tetrahedra = {"0 1 2 3", "0 2 1 4", "1 5 2 3"};

void expect_mesh_refused(const Result<Scene>& result, const std::string& mention) {
  ASSERT_FALSE(result.ok()) << mention;
  EXPECT_NE(result.error().message.find(mention), std::string::npos) << result.error().message;
}

TEST(Reference, C12_MeshFilesWithBadElementsAreRefusedWithTheElement) {
  const MeshFolder folder;
  ASSERT_TRUE(folder.load(good_nodes, good_tetrahedra).ok());
  const auto with = [](std::string element) {
    std::vector<std::string> list = good_tetrahedra;
    list.push_back(std::move(element));
    return list;
  };
  expect_mesh_refused(folder.load(good_nodes, with("0 1 2 17")), "17");
  expect_mesh_refused(folder.load(good_nodes, with("0 1 2 -4")), "-4");
  expect_mesh_refused(folder.load(good_nodes, with("3 1 3 2")), "3");
  expect_mesh_refused(folder.load(good_nodes, {}), "mesh");
  expect_mesh_refused(folder.load({}, {}), "mesh");
  std::vector<std::string> broken = good_nodes;
  broken[2] = "0 nan 0";
  EXPECT_FALSE(folder.load(broken, good_tetrahedra).ok());
  broken[2] = "0 inf 0";
  EXPECT_FALSE(folder.load(broken, good_tetrahedra).ok());
  EXPECT_TRUE(folder.load(good_nodes, good_tetrahedra).ok());
}

TEST(Reference, C02_CoplanarRestTetrahedraAreRefusedWithTheElement) {
  const MeshFolder folder;
  std::vector<std::string> tetrahedra = good_tetrahedra;
  tetrahedra.push_back("0 1 5 2");  // all with z = 0
  const Result<Scene> result = folder.load(good_nodes, tetrahedra);
  ASSERT_FALSE(result.ok());
  EXPECT_NE(result.error().message.find("3"), std::string::npos) << result.error().message;
}

}  // namespace
}  // namespace flexcast::test
