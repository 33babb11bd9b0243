// No text whatever makes the reader crash, and every refusal says something.
#include <random>

#include "tests/core/scene/scene_text.h"

namespace flexcast::test {
namespace {

// Uses most keys; meshes are tiny, so that a mutated count stays small.
const std::string every_kind_scene = R"(name = "rich"
description = "much"
gravity = [0, 0, -9.81]
[time]
step = 1e-3
integrator = "rk4"
substeps = 2
duration = 1.0
[solver]
linear = "pcg"
newton_iterations = 3
iterations = 4
[[body]]
name = "beam"
model = "fem"
mesh = { shape = "beam", cells = [1, 1, 1], size = [1, 1, 1] }
element = "tet4"
material = { law = "linear", young = 1e5, poisson = 0.3, density = 10.0 }
particle_mass = [ { select = { nodes = [1] }, value = 2.0 } ]
damping = { mass = 0.1, stiffness = 0.01 }
drag = 0.1
origin = [1, 2, 3]
rotation = [0.1, 0.2, 0.3]
pin = [ { select = { sphere = [1, 2, 3, 0.1] }, axes = "xz" } ]
displacement = [ { select = { nodes = [7] }, value = [0.1, 0, 0] } ]
velocity = [ { select = { all = true }, value = [1, 0, 0], spin = [0, 0, 1], about = [1, 1, 1] } ]
force = [ { select = { box = [[0, 0, 0], [9, 9, 9]] }, value = [0, 0, 1] } ]
surface_force = [ { select = { box = [[0, 0, 0], [9, 9, 9]] }, value = [0, 0, 1] } ]
[[body]]
name = "quadratic"
model = "fem"
mesh = { shape = "beam", cells = [1, 1, 1], size = [1, 1, 1] }
element = "tet10"
material = { law = "corotational", young = 1e5, poisson = 0.3, density = 10.0 }
handle = [ { name = "grip", select = { nodes = [0, 1] }, translate = [0, 0, 1], rotate = [1, 0, 0], about = [0, 1, 0], start = 0.5, duration = 2.0 } ]
[[body]]
name = "rope"
model = "mass_spring"
mesh = { shape = "rope", cells = [4], size = [1.0] }
springs = { stiffness = 10.0, damping = 0.1 }
total_mass = 1.0
[[contact]]
name = "ground"
shape = "plane"
point = [0, 0, -1]
normal = [0, 0, 1]
friction = 0.3
stiffness = 1e4
[[contact]]
name = "ball"
shape = "sphere"
center = [9, 0, 0]
radius = 1.0
[[contact]]
name = "crate"
shape = "box"
lo = [5, 0, 0]
hi = [6, 1, 1]
[[probe]]
name = "end"
body = "rope"
node = 4
[stream]
fields = ["positions"]
precision = "float64"
every = 2
)";

void expect_scene_or_sentence(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const auto scene = load(text, overrides);
  if (scene) return;
  const std::string& message = scene.error().message;
  const bool named = message.starts_with("test.toml") || message.starts_with("--set ");
  EXPECT_TRUE(named && message.size() > 15) << message << "\n" << text;
}

TEST(SceneReader, AcceptsTheSceneThatIsMutated) {
  loaded(every_kind_scene);
}

TEST(SceneReader, SurvivesMutatedBytes) {
  std::mt19937 random(20240601);
  const auto below = [&](std::size_t count) { return static_cast<std::size_t>(random() % count); };
  const std::string letters = "0-.e\"[]{}=,\n #_naif\\'\t\x01\xff\xc3";
  for (int round = 0; round < 4000; ++round) {
    std::string text = every_kind_scene;
    for (std::size_t change = 0, changes = 1 + below(3); change < changes; ++change) {
      const std::size_t at = below(text.size());
      switch (below(5)) {
        case 0:
          text[at] = letters[below(letters.size())];
          break;
        case 1:
          text.erase(at, 1 + below(4));
          break;
        case 2:
          text[at] = static_cast<char>(random());
          break;
        case 3:
          text.erase(at);
          break;
        default:
          std::swap(text[at], text[below(text.size())]);
          break;
      }
      if (text.empty()) text = "\n";
    }
    expect_scene_or_sentence(text);
  }
}

TEST(SceneReader, SurvivesEveryTokenReplacedByAnother) {
  const std::string tokens[] = {
      "nan",  "inf",  "-inf", "1e308", "-1e308", "1e-320",     "0",        "-1", "9223372036854775807",
      "\"\"", "true", "[]",   "{}",    "[[]]",   "1979-05-27", "[1, 2, 3]"};
  for (std::size_t equals = every_kind_scene.find("= "); equals != std::string::npos;
       equals = every_kind_scene.find("= ", equals + 1)) {
    const std::size_t end = every_kind_scene.find_first_of(",}]\n", equals);
    for (const std::string& token : tokens) {
      expect_scene_or_sentence(every_kind_scene.substr(0, equals + 2) + token + every_kind_scene.substr(end));
    }
  }
}

TEST(SceneReader, SurvivesDeepNesting) {
  const int deep = 20000;
  expect_scene_or_sentence("name = " + std::string(deep, '['));
  std::string tables = "name = ";
  for (int i = 0; i < deep; ++i) tables += "{a=";
  expect_scene_or_sentence(tables);
}

TEST(SceneReader, SurvivesAnyOverride) {
  std::mt19937 random(7);
  const std::string letters = "beam.young=time.step[]{}\"\n 0123456789-e#,=";
  for (int round = 0; round < 2000; ++round) {
    std::string assignment = round % 2 ? "beam.young=" : "";
    for (int i = 0; i < 12; ++i) assignment += letters[random() % letters.size()];
    expect_scene_or_sentence(every_kind_scene, {assignment});
  }
}

}  // namespace
}  // namespace flexcast::test
