// Selectors choose particles in rest coordinates, bounds included, and must choose some.
#include "tests/core/scene/scene_text.h"

namespace flexcast::test {
namespace {

// The particles of the cloth (2 x 2 cells of 0.5 m, nodes 0 to 8) that a selector pins.
std::vector<int> pinned(const std::string& selector, const std::string& more = "") {
  const Scene scene = loaded(with_spring_lines(more + "\npin = [ { select = " + selector + " } ]"));
  const Model& model = scene.simulation->model();
  const IndexRange cloth = find_body(model, "cloth")->particles;
  std::vector<int> found;
  for (std::int32_t i = cloth.first; i < cloth.end(); ++i)
    if (model.fixed[3 * static_cast<std::size_t>(i)]) found.push_back(i - cloth.first);
  return found;
}

std::string selector_refusal(const std::string& selector) {
  return refusal(with_spring_lines("pin = [\n{ select = " + selector + " } ]"));
}

using Nodes = std::vector<int>;

TEST(Selector, BoxIncludesItsBounds) {
  EXPECT_EQ(pinned("{ box = [[0.5, 0.0, 0.0], [1.0, 0.5, 0.0]] }"), (Nodes{1, 2, 4, 5}));
}

TEST(Selector, SphereIncludesItsBound) {
  EXPECT_EQ(pinned("{ sphere = [0.5, 0.5, 0.0, 0.5] }"), (Nodes{1, 3, 4, 5, 7}));
  EXPECT_EQ(pinned("{ sphere = [0.5, 0.5, 0.0, 0.0] }"), (Nodes{4}));
}

TEST(Selector, NodesAreNumbersWithinTheBody) {
  EXPECT_EQ(pinned("{ nodes = [8, 0, 8] }"), (Nodes{0, 8}));
}

TEST(Selector, AllIsTheWholeBodyAndNoOther) {
  EXPECT_EQ(pinned("{ all = true }").size(), 9u);
  const Scene scene = loaded(with_spring_lines("pin = [ { select = { all = true } } ]"));
  EXPECT_EQ(scene.simulation->model().fixed[0], 0);
}

TEST(Selector, LooksAtRestCoordinatesAfterRotationAndOrigin) {
  const std::string turned = "origin = [10.0, 0.0, 0.0]\nrotation = [0.0, 0.0, 1.5707963267948966]";
  EXPECT_EQ(pinned("{ box = [[9.9, -0.1, -0.1], [10.1, 0.1, 0.1]] }", turned), (Nodes{0}));
  EXPECT_EQ(pinned("{ box = [[9.9, 0.9, -0.1], [10.1, 1.1, 0.1]] }", turned), (Nodes{2}));
}

TEST(Selector, IgnoresTheDisplacement) {
  EXPECT_EQ(pinned("{ box = [[0.0, 0.0, 0.0], [0.0, 0.0, 0.0]] }",
                   "displacement = [ { select = { all = true }, value = [5.0, 0.0, 0.0] } ]"),
            (Nodes{0}));
}

TEST(Selector, KnowsNoAbsoluteLength) {
  for (const std::string length : {"1e-120", "1e37"}) {
    const std::string mesh = "{ shape = \"grid\", cells = [2, 2], size = [" + length + ", " + length + "] }";
    std::string text = changed("{ shape = \"grid\", cells = [2, 2], size = [1.0, 1.0] }", mesh);
    text = changed("[[probe]]\n", "pin = [ { select = { sphere = [0.0, 0.0, 0.0, " + length + "] } } ]\n[[probe]]\n",
                   text);
    const Scene scene = loaded(text);
    const auto& fixed = scene.simulation->model().fixed;
    EXPECT_EQ(std::count(fixed.begin(), fixed.end(), 1), 3 * 6) << length;
  }
}

TEST(Selector, ThatSelectsNothingIsRefusedWithItsLine) {
  EXPECT_EQ(selector_refusal("{ box = [[5, 5, 5], [6, 6, 6]] }"),
            "test.toml:17: [[body]] \"cloth\": pin[0].select selects no particle of the body");
  EXPECT_EQ(selector_refusal("{ nodes = [] }"),
            "test.toml:17: [[body]] \"cloth\": pin[0].select selects no particle of the body");
}

TEST(Selector, RefusesANodeTheBodyDoesNotHave) {
  EXPECT_EQ(selector_refusal("{ nodes = [0, 9] }"),
            "test.toml:17: [[body]] \"cloth\": pin[0].select names node 9, which the body does not have (allowed: 0 to "
            "8)");
  EXPECT_EQ(selector_refusal("{ nodes = [-1] }"),
            "test.toml:17: [[body]] \"cloth\": pin[0].select.nodes[0] = -1 is out of range (allowed: >= 0)");
}

TEST(Selector, HasExactlyOneKey) {
  EXPECT_EQ(selector_refusal("{}"),
            "test.toml:17: [[body]] \"cloth\": pin[0].select has 0 keys; expected exactly one of box, sphere, nodes, "
            "all");
  EXPECT_EQ(selector_refusal("{ all = true, nodes = [0] }"),
            "test.toml:17: [[body]] \"cloth\": pin[0].select has 2 keys; expected exactly one of box, sphere, nodes, "
            "all");
  EXPECT_EQ(selector_refusal("{ boxx = [0] }"),
            "test.toml:17: [[body]] \"cloth\": unknown key pin[0].select.boxx = [0] (allowed: box, sphere, nodes, "
            "all); did you mean \"box\"?");
}

TEST(Selector, RefusesShapesThatAreNone) {
  const std::string where = "test.toml:17: [[body]] \"cloth\": pin[0].select.";
  EXPECT_EQ(selector_refusal("{ all = false }"), where + "all = false is not right; expected true");
  EXPECT_EQ(selector_refusal("{ sphere = [0, 0, 0, -1] }"), where + "sphere = [0, 0, 0, -1] has a negative radius");
  EXPECT_EQ(selector_refusal("{ sphere = [0, 0, 0, inf] }"),
            where + "sphere[3] = inf is out of range (allowed: any finite number, m)");
  EXPECT_EQ(selector_refusal("{ box = [[0, 1, 0], [1, 0, 1]] }"),
            where + "box = [[0, 1, 0], [1, 0, 1]] has its first corner above its second along y");
  EXPECT_EQ(selector_refusal("{ box = [[0, 0, 0]] }"),
            where + "box = [[0, 0, 0]] is not right; expected 2 arrays of 3 numbers (any finite number, m)");
  EXPECT_EQ(selector_refusal("{ box = [[0, 0], [1, 1]] }"),
            where + "box[0] = [0, 0] has 2 elements; expected an array of 3 numbers (any finite number, m)");
}

}  // namespace
}  // namespace flexcast::test
