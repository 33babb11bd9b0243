// What a scene may not say, and the exact sentences that say so.
#include "tests/core/scene/scene_text.h"

namespace flexcast::test {
namespace {

struct Refusal {
  const char* claim;
  const char* from;
  const char* to;
  const char* message;
};

void PrintTo(const Refusal& refusal, std::ostream* out) {
  *out << refusal.claim;
}

class SceneRefuses : public testing::TestWithParam<Refusal> {};

TEST_P(SceneRefuses, NamingFileLineKeyValueAndWhatIsAllowed) {
  EXPECT_EQ(refusal(changed(GetParam().from, GetParam().to)), GetParam().message);
}

std::string claim(const testing::TestParamInfo<Refusal>& info) {
  return info.param.claim;
}

INSTANTIATE_TEST_SUITE_P(
    Values, SceneRefuses,
    testing::Values(
        Refusal{"NegativeYoung", "young = 1e6", "young = -5.0",
                "test.toml:9: [[body]] \"beam\": material.young = -5.0 is out of range (allowed: > 0, Pa)"},
        Refusal{"ZeroYoung", "young = 1e6", "young = 0",
                "test.toml:9: [[body]] \"beam\": material.young = 0 is out of range (allowed: > 0, Pa)"},
        Refusal{"PoissonOfOneHalf", "poisson = 0.4", "poisson = 0.5",
                "test.toml:9: [[body]] \"beam\": material.poisson = 0.5 is out of range (allowed: > -1 and < 0.5)"},
        Refusal{"PoissonOfMinusOne", "poisson = 0.4", "poisson = -1.0",
                "test.toml:9: [[body]] \"beam\": material.poisson = -1.0 is out of range (allowed: > -1 and < 0.5)"},
        Refusal{"NanDensity", "density = 1000.0", "density = nan",
                "test.toml:9: [[body]] \"beam\": material.density = nan is out of range (allowed: > 0, kg/m^3)"},
        Refusal{"InfiniteYoung", "young = 1e6", "young = inf",
                "test.toml:9: [[body]] \"beam\": material.young = inf is out of range (allowed: > 0, Pa)"},
        Refusal{"ZeroStep", "step = 0.001", "step = 0.0",
                "test.toml:4: time.step = 0.0 is out of range (allowed: > 0, s)"},
        Refusal{"InfiniteStep", "step = 0.001", "step = inf",
                "test.toml:4: time.step = inf is out of range (allowed: > 0, s)"},
        Refusal{"ZeroSubsteps", "step = 0.001", "substeps = 0",
                "test.toml:4: time.substeps = 0 is out of range (allowed: >= 1 and <= 1000000)"},
        Refusal{"EndlessDuration", "step = 0.001", "duration = 1e300",
                "test.toml:4: time.duration = 1e+300 is more than 1e+15 steps of time.step = 0.001"},
        Refusal{"NanGravity", "-9.81]", "nan]",
                "test.toml:2: gravity[2] = nan is out of range (allowed: any finite number, m/s^2)"},
        Refusal{"NegativeStiffness", "stiffness = 100.0", "stiffness = -1",
                "test.toml:14: [[body]] \"cloth\": springs.stiffness = -1 is out of range (allowed: >= 0, N)"},
        Refusal{"NegativeSpringDamping", "stiffness = 100.0", "stiffness = 1, damping = -0.5",
                "test.toml:14: [[body]] \"cloth\": springs.damping = -0.5 is out of range (allowed: >= 0, N.s)"},
        Refusal{"ZeroMass", "mass = 0.1", "mass = 0",
                "test.toml:15: [[body]] \"cloth\": mass = 0 is out of range (allowed: > 0, kg)"},
        Refusal{"NegativeTotalMass", "mass = 0.1", "total_mass = -1.0",
                "test.toml:15: [[body]] \"cloth\": total_mass = -1.0 is out of range (allowed: > 0, kg)"},
        Refusal{"NegativeDrag", "mass = 0.1", "mass = 0.1\ndrag = -1.0",
                "test.toml:16: [[body]] \"cloth\": drag = -1.0 is out of range (allowed: >= 0, N.s/m)"},
        Refusal{"ZeroCells", "cells = [2, 2]", "cells = [2, 0]",
                "test.toml:13: [[body]] \"cloth\": mesh.cells[1] = 0 is out of range (allowed: >= 1 and <= 50000000)"},
        Refusal{"MoreParticlesThanMemoryHolds", "cells = [2, 1, 1]", "cells = [100000, 100000, 100000]",
                "test.toml:8: [[body]] \"beam\": mesh.cells = [100000, 100000, 100000] makes 1000030000300001 "
                "particles (allowed: at most 50000000)"},
        Refusal{"ZeroSize", "size = [1.0, 1.0]", "size = [1.0, 0.0]",
                "test.toml:13: [[body]] \"cloth\": mesh.size[1] = 0.0 is out of range (allowed: > 0, m)"},
        Refusal{"NameWithSpaces", "name = \"beam\"", "name = \"my beam\"",
                "test.toml:6: [[body]] number 1: name = \"my beam\" is not a name (allowed: 1 to 64 of A-Z, a-z, 0-9, "
                "_ and -)"},
        Refusal{"ReservedName", "name = \"beam\"", "name = \"time\"",
                "test.toml:6: [[body]] \"time\": name = \"time\" is a reserved word (not allowed: time, solver, "
                "stream, gravity, contact, handle, server, probe, body)"},
        Refusal{"NameOfTwoBodies", "name = \"cloth\"", "name = \"beam\"",
                "test.toml:10: [[body]] \"beam\": name = \"beam\" is there twice; names must differ"},
        Refusal{"UnknownModel", "model = \"fem\"", "model = \"fen\"",
                "test.toml:7: [[body]] \"beam\": model = \"fen\" is not known (allowed: \"fem\", \"mass_spring\"); did "
                "you mean \"fem\"?"},
        Refusal{"UnknownElement", "model = \"fem\"", "model = \"fem\"\nelement = \"hex8\"",
                "test.toml:8: [[body]] \"beam\": element = \"hex8\" is not known (allowed: \"tet4\", \"tet10\")"},
        Refusal{"ElementOfSprings", "mass = 0.1", "mass = 0.1\nelement = \"tet10\"",
                "test.toml:16: [[body]] \"cloth\": element = \"tet10\" belongs to model = \"fem\", not to this "
                "body's"},
        Refusal{"ZeroSweeps", "[time]", "[solver]\niterations = 0\n[time]",
                "test.toml:4: solver.iterations = 0 is out of range (allowed: >= 1 and <= 1000000)"},
        Refusal{"ShapeWithoutTetrahedra", "shape = \"beam\", cells = [2, 1, 1]", "shape = \"lattice\", cells = [1]",
                "test.toml:8: [[body]] \"beam\": mesh.shape = \"lattice\" has no tetrahedra, which model = \"fem\" "
                "needs (allowed: \"beam\", or a file)"},
        Refusal{"ProbeOfNoBody", "body = \"beam\"", "body = \"baem\"",
                "test.toml:18: [[probe]] \"tip\": body = \"baem\" is not known (allowed: \"beam\", \"cloth\"); did you "
                "mean \"beam\"?"},
        Refusal{"ProbeNodeBeyondTheBody", "at = [2.0, 0.0, 0.0]", "node = 12",
                "test.toml:16: [[probe]] \"tip\": node = 12 is out of range (allowed: 0 to 11)"},
        Refusal{"UnknownStreamField", "step = 0.001\n",
                "step = 0.001\n[stream]\nfields = [\"positions\", \"stretsh\"]\n",
                "test.toml:6: stream.fields[1] = \"stretsh\" is not known (allowed: \"positions\", \"velocities\", "
                "\"stretch\", \"stress\"); did you mean \"stretch\"?"},
        Refusal{"StreamFieldTwice", "step = 0.001\n",
                "step = 0.001\n[stream]\nfields = [\"positions\", \"positions\"]\n",
                "test.toml:6: stream.fields[1] = \"positions\" is there twice"},
        Refusal{"UnknownPrecision", "step = 0.001\n", "step = 0.001\n[stream]\nprecision = \"quantised16\"\n",
                "test.toml:6: stream.precision = \"quantised16\" is not known (allowed: \"float32\", \"float64\", "
                "\"quantized16\"); did you mean \"quantized16\"?"},
        Refusal{"MissingMeshFile", "{ shape = \"grid\", cells = [2, 2], size = [1.0, 1.0] }", "{ file = \"\" }",
                "test.toml:13: [[body]] \"cloth\": mesh.file = \"\" is empty; expected the name of a file"}),
    claim);

INSTANTIATE_TEST_SUITE_P(
    Keys, SceneRefuses,
    testing::Values(
        Refusal{"UnknownTopKey", "gravity =", "gravty =",
                "test.toml:2: unknown key gravty = [0.0, 0.0, -9.81] (allowed: name, description, gravity, time, "
                "solver, body, contact, probe, stream, exact); did you mean \"gravity\"?"},
        Refusal{"UnknownTimeKey", "step = 0.001", "dt = 0.001",
                "test.toml:4: unknown key time.dt = 0.001 (allowed: step, integrator, substeps, tolerance, budget, "
                "error_estimate, duration)"},
        Refusal{"ToleranceOfOne", "step = 0.001", "tolerance = 1.0",
                "test.toml:4: time.tolerance = 1.0 is out of range (allowed: >= 0 and < 1, 1/s)"},
        Refusal{"TwoContracts", "step = 0.001", "tolerance = 1e-3\nbudget = 0.5",
                "test.toml:5: time.budget = 0.5 excludes time.tolerance = 0.001; one of them must be 0"},
        Refusal{"UnknownTable", "[time]", "[[contacts]]\nname = \"ground\"\n[time]",
                "test.toml:3: unknown key contacts (allowed: name, description, gravity, time, solver, body, contact, "
                "probe, stream, exact); did you mean \"contact\"?"},
        Refusal{"UnknownMaterialKey", "young = 1e6", "yuong = 1e6",
                "test.toml:9: [[body]] \"beam\": unknown key material.yuong = 1e+06 (allowed: law, young, poisson, "
                "density); did you mean \"young\"?"},
        Refusal{"MissingYoung", "young = 1e6, ", "",
                "test.toml:9: [[body]] \"beam\": missing key material.young; expected a number (> 0, Pa)"},
        Refusal{"MissingSceneName", "name = \"test\"\n", "\n",
                "test.toml:1: missing key name; expected a name (1 to 64 of A-Z, a-z, 0-9, _ and -)"},
        Refusal{"MissingBodyName", "name = \"beam\"\n", "\n",
                "test.toml:5: [[body]] number 1: missing key name; expected a name (1 to 64 of A-Z, a-z, 0-9, _ and "
                "-)"},
        Refusal{"MissingModel", "model = \"fem\"\n", "\n",
                "test.toml:5: [[body]] \"beam\": missing key model; expected one of \"fem\", \"mass_spring\""},
        Refusal{"MissingMesh", "mesh = { shape = \"grid\", cells = [2, 2], size = [1.0, 1.0] }\n", "\n",
                "test.toml:10: [[body]] \"cloth\": missing key mesh; expected { shape, cells, size } or { file }"},
        Refusal{"MissingCells", "cells = [2, 2], ", "",
                "test.toml:13: [[body]] \"cloth\": missing key mesh.cells; expected an array of 2 integers (>= 1 and "
                "<= 50000000)"},
        Refusal{"MissingShape", "shape = \"beam\", ", "",
                "test.toml:8: [[body]] \"beam\": missing key mesh.shape; expected one of \"beam\", or a file"},
        Refusal{"MissingMaterial", "material = { law = \"linear\", young = 1e6, poisson = 0.4, density = 1000.0 }", "",
                "test.toml:5: [[body]] \"beam\": missing key material; expected { law, young, poisson, density }"},
        Refusal{"MissingSprings", "springs = { stiffness = 100.0 }", "",
                "test.toml:10: [[body]] \"cloth\": missing key springs; expected { stiffness, damping }"},
        Refusal{"MissingMass", "mass = 0.1", "",
                "test.toml:10: [[body]] \"cloth\": missing key mass (kg per particle) or total_mass (kg); expected one "
                "of them"},
        Refusal{"MassAndTotalMass", "mass = 0.1", "mass = 0.1\ntotal_mass = 1.0",
                "test.toml:10: [[body]] \"cloth\": has both mass and total_mass; expected one of them"},
        Refusal{"ProbeWithoutPlace", "at = [2.0, 0.0, 0.0]", "",
                "test.toml:16: [[probe]] \"tip\": missing key at or node; expected one of them"},
        Refusal{"ProbeWithTwoPlaces", "at = [2.0, 0.0, 0.0]", "at = [2.0, 0.0, 0.0]\nnode = 1",
                "test.toml:16: [[probe]] \"tip\": has both at and node; expected one of them"},
        Refusal{"SpringsOfFem", "model = \"fem\"\n", "model = \"fem\"\nsprings = { stiffness = 1.0 }\n",
                "test.toml:8: [[body]] \"beam\": springs = {...} belongs to model = \"mass_spring\", not to this "
                "body's"},
        Refusal{"MassOfFem", "model = \"fem\"\n", "model = \"fem\"\nmass = 1.0\n",
                "test.toml:8: [[body]] \"beam\": mass = 1.0 belongs to model = \"mass_spring\", not to this body's"},
        Refusal{"MaterialOfSprings", "mass = 0.1\n", "mass = 0.1\nmaterial = { young = 1.0 }\n",
                "test.toml:16: [[body]] \"cloth\": material = {...} belongs to model = \"fem\", not to this body's"},
        Refusal{"KelvinVoigtDampingOfSprings", "mass = 0.1\n", "mass = 0.1\ndamping = { stiffness = 0.1 }\n",
                "test.toml:16: [[body]] \"cloth\": damping.stiffness = 0.1 belongs to model = \"fem\"; springs are "
                "damped by springs.damping (N.s)"},
        Refusal{"FileAndShape", "shape = \"grid\"", "file = \"a.node\", shape = \"grid\"",
                "test.toml:13: [[body]] \"cloth\": unknown key mesh.cells = [2, 2] (allowed: file, scale)"}),
    claim);

INSTANTIATE_TEST_SUITE_P(
    Types, SceneRefuses,
    testing::Values(
        Refusal{"TextAsNumber", "young = 1e6", "young = \"soft\"",
                "test.toml:9: [[body]] \"beam\": material.young = \"soft\" is a string; expected a number (> 0, Pa)"},
        Refusal{"DecimalsAsInteger", "step = 0.001", "substeps = 2.5",
                "test.toml:4: time.substeps = 2.5 is a number with decimals; expected an integer (>= 1 and <= "
                "1000000)"},
        Refusal{"NumberAsVector", "gravity = [0.0, 0.0, -9.81]", "gravity = -9.81",
                "test.toml:2: gravity = -9.81 is a number with decimals; expected an array of 3 numbers (any finite "
                "number, m/s^2)"},
        Refusal{"VectorOfTwo", "gravity = [0.0, 0.0, -9.81]", "gravity = [0, -9.81]",
                "test.toml:2: gravity = [0, -9.81] has 2 elements; expected an array of 3 numbers (any finite number, "
                "m/s^2)"},
        Refusal{"TextInVector", "gravity = [0.0, 0.0, -9.81]", "gravity = [0, 0, \"down\"]",
                "test.toml:2: gravity[2] = \"down\" is a string; expected a number (any finite number, m/s^2)"},
        Refusal{"CellsOfAnotherDimension", "cells = [2, 2]", "cells = [2]",
                "test.toml:13: [[body]] \"cloth\": mesh.cells = [2] has 1 elements; expected an array of 2 integers "
                "(>= 1 and <= 50000000)"},
        Refusal{"NumberAsTable", "material = { law = \"linear\", young = 1e6, poisson = 0.4, density = 1000.0 }",
                "material = 3", "test.toml:9: [[body]] \"beam\": material = 3 is an integer; expected a table"},
        Refusal{"NumberAsName", "name = \"beam\"", "name = 7",
                "test.toml:6: [[body]] number 1: name = 7 is an integer; expected a string"},
        Refusal{"DateAsNumber", "step = 0.001", "step = 1979-05-27",
                "test.toml:4: time.step = 1979-05-27 is a date or time; expected a number (> 0, s)"},
        Refusal{"SingleProbeTable", "[[probe]]", "[probe]",
                "test.toml:16: probe = {...} is a table; expected an array of tables"},
        Refusal{"BrokenToml", "young = 1e6",
                "young = ", "test.toml:9: not valid TOML: Error while parsing key-value pair: expected value, saw ','"},
        Refusal{"KeyTwice", "step = 0.001", "step = 0.001\nstep = 0.002",
                "test.toml:5: not valid TOML: Error while parsing key-value pair: cannot redefine existing "
                "floating-point 'step'"}),
    claim);

// Lines of a [[contact]] between bodies and probes: the table is line 16, its name 17.
struct ContactRefusal {
  const char* claim;
  const char* lines;
  const char* message;  // behind the file
};

void PrintTo(const ContactRefusal& refusal, std::ostream* out) {
  *out << refusal.claim;
}

class ContactRefuses : public testing::TestWithParam<ContactRefusal> {};

TEST_P(ContactRefuses, NamingFileLineKeyValueAndWhatIsAllowed) {
  const std::string lines = "[[contact]]\nname = \"ground\"\n" + std::string(GetParam().lines);
  EXPECT_EQ(refusal(with_spring_lines(lines)), "test.toml:" + std::string(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    Contacts, ContactRefuses,
    testing::Values(
        ContactRefusal{"MissingShape", "",
                       "16: [[contact]] \"ground\": missing key shape; expected one of \"plane\", \"sphere\", "
                       "\"box\""},
        ContactRefusal{"UnknownShape", "shape = \"plan\"",
                       "18: [[contact]] \"ground\": shape = \"plan\" is not known (allowed: \"plane\", \"sphere\", "
                       "\"box\"); did you mean \"plane\"?"},
        ContactRefusal{"UnknownKey", "shape = \"plane\"\npoint = [0, 0, 0]\nnormals = [0, 0, 1]",
                       "20: [[contact]] \"ground\": unknown key normals = [0, 0, 1] (allowed: name, shape, friction, "
                       "stiffness, point, normal, center, radius, lo, hi); did you mean \"normal\"?"},
        ContactRefusal{"KeyOfAnotherShape", "shape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\nradius = 1.0",
                       "21: [[contact]] \"ground\": radius = 1.0 belongs to shape = \"sphere\", not to this "
                       "contact's"},
        ContactRefusal{"PlaneWithoutPoint", "shape = \"plane\"\nnormal = [0, 0, 1]",
                       "16: [[contact]] \"ground\": missing key point; expected an array of 3 numbers (any finite "
                       "number, m)"},
        ContactRefusal{"PlaneWithoutNormal", "shape = \"plane\"\npoint = [0, 0, 0]",
                       "16: [[contact]] \"ground\": missing key normal; expected an array of 3 numbers (any finite "
                       "number)"},
        ContactRefusal{"ZeroNormal", "shape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, -0.0]",
                       "20: [[contact]] \"ground\": normal = [0, 0, -0.0] is zero; expected a vector that is not"},
        ContactRefusal{"NanPoint", "shape = \"plane\"\npoint = [0, nan, 0]\nnormal = [0, 0, 1]",
                       "19: [[contact]] \"ground\": point[1] = nan is out of range (allowed: any finite number, m)"},
        ContactRefusal{"SphereWithoutCenter", "shape = \"sphere\"\nradius = 1.0",
                       "16: [[contact]] \"ground\": missing key center; expected an array of 3 numbers (any finite "
                       "number, m)"},
        ContactRefusal{"SphereWithoutRadius", "shape = \"sphere\"\ncenter = [0, 0, 0]",
                       "16: [[contact]] \"ground\": missing key radius; expected a number (> 0, m)"},
        ContactRefusal{"ZeroRadius", "shape = \"sphere\"\ncenter = [0, 0, 0]\nradius = 0",
                       "20: [[contact]] \"ground\": radius = 0 is out of range (allowed: > 0, m)"},
        ContactRefusal{"BoxWithoutCorner", "shape = \"box\"\nlo = [0, 0, 0]",
                       "16: [[contact]] \"ground\": missing key hi; expected an array of 3 numbers (any finite number, "
                       "m)"},
        ContactRefusal{"FlatBox", "shape = \"box\"\nlo = [0, 1, 0]\nhi = [1, 1, 1]",
                       "19: [[contact]] \"ground\": lo = [0, 1, 0] is not below hi along y; expected lo < hi"},
        ContactRefusal{"NegativeFriction", "shape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\nfriction = -0.1",
                       "21: [[contact]] \"ground\": friction = -0.1 is out of range (allowed: >= 0)"},
        ContactRefusal{"NegativeStiffness",
                       "shape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\nstiffness = -1.0",
                       "21: [[contact]] \"ground\": stiffness = -1.0 is out of range (allowed: >= 0, N/m)"},
        ContactRefusal{"FrictionAsText",
                       "shape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\nfriction = \"rough\"",
                       "21: [[contact]] \"ground\": friction = \"rough\" is a string; expected a number (>= 0)"},
        ContactRefusal{"NameTwice",
                       "shape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n[[contact]]\nname = \"ground\"\n"
                       "shape = \"sphere\"\ncenter = [0, 0, 0]\nradius = 1.0",
                       "21: [[contact]] \"ground\": name = \"ground\" is there twice; names must differ"}),
    [](const auto& test) { return test.param.claim; });

TEST(SceneRefusal, OfAContactWithoutNameNumbersIt) {
  EXPECT_EQ(refusal(with_spring_lines("[[contact]]\nshape = \"plane\"")),
            "test.toml:16: [[contact]] number 1: missing key name; expected a name (1 to 64 of A-Z, a-z, 0-9, _ and "
            "-)");
  EXPECT_EQ(refusal(changed("[time]", "[contact]\nname = \"ground\"\n[time]")),
            "test.toml:3: contact = {...} is a table; expected an array of tables");
}

TEST(SceneRefusal, ListsTheIntegratorsOfTheirTable) {
  const std::string message = refusal(changed("step = 0.001", "integrator = \"rk5\""));
  EXPECT_TRUE(message.starts_with("test.toml:4: time.integrator = \"rk5\" is not known (allowed: \"forward_euler\", "))
      << message;
  EXPECT_TRUE(message.ends_with("; did you mean \"rk4\"?")) << message;
}

TEST(SceneRefusal, ListsTheLawsOfTheirTable) {
  const std::string message = refusal(changed("\"linear\"", "\"hooke\""));
  EXPECT_TRUE(message.starts_with("test.toml:9: [[body]] \"beam\": material.law = \"hooke\" is not known (allowed: "))
      << message;
  for (const Law& law : laws()) EXPECT_NE(message.find("\"" + std::string(law.name) + "\""), std::string::npos);
}

TEST(SceneRefusal, NamesAMeshFileThatIsNotThere) {
  const std::string message =
      refusal(changed("{ shape = \"grid\", cells = [2, 2], size = [1.0, 1.0] }", "{ file = \"nowhere.msh\" }"));
  EXPECT_TRUE(message.starts_with("test.toml:13: [[body]] \"cloth\": mesh.file = \"nowhere.msh\" cannot be used: "))
      << message;
}

TEST(SceneRefusal, NamesTheSpringWhoseNodesCoincide) {
  EXPECT_EQ(refusal(changed("mass = 0.1", "mass = 0.1\norigin = [1e20, 0.0, 0.0]")),
            "test.toml:10: [[body]] \"cloth\": spring 0 (nodes 0 and 1) has the rest length 0.0; its law divides by "
            "it");
}

TEST(SceneRefusal, NamesTheTetrahedronThatVanishesFarFromTheOrigin) {
  const std::string message = refusal(changed("model = \"fem\"", "model = \"fem\"\norigin = [1e20, 0.0, 0.0]"));
  EXPECT_TRUE(message.starts_with("test.toml:5: [[body]] \"beam\": tetrahedron 0 has the volume ")) << message;
}

TEST(SceneRefusal, NamesTheBodyWhosePlaceIsNotFinite) {
  EXPECT_EQ(refusal(changed("size = [1.0, 1.0] }", "size = [1.0, 1e308] }\norigin = [0.0, 1.7e308, 0.0]")),
            "test.toml:10: [[body]] \"cloth\": mesh, rotation and origin give rest positions that are not finite");
}

TEST(SceneRefusal, NamesTheFileThatCannotBeRead) {
  const auto scene = load_scene("no/such/scene.toml");
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.error().message, "no/such/scene.toml: cannot be read: No such file or directory");
  EXPECT_FALSE(load_scene("/"));
}

TEST(SceneRefusal, OfTheEmptySceneNamesWhatIsMissing) {
  EXPECT_TRUE(refusal("").starts_with("test.toml:1: missing key name; expected a name")) << refusal("");
  EXPECT_EQ(refusal("name = \"a\"\n"), "test.toml:1: a scene needs a [[body]]; there is none");
}

TEST(SceneRefusal, OfStressNamesTheKeyWhereNothingHasTetrahedra) {
  const std::string rope =
      "name = \"rope\"\n[stream]\nfields = [\"positions\", \"stress\"]\n[[body]]\nname = \"rope\"\nmodel = "
      "\"mass_spring\"\nmesh = { shape = \"rope\", cells = [2], size = [1.0] }\nsprings = { stiffness = 1.0 }\nmass "
      "= 1.0\n";
  EXPECT_EQ(refusal(rope),
            "test.toml:3: stream.fields = [\"positions\", \"stress\"] has \"stress\", which only tetrahedra have; "
            "expected a [[body]] of model \"fem\"");
}

}  // namespace
}  // namespace flexcast::test
