// handle: particles of a body that move as prescribed.
#include "tests/core/scene/scene_text.h"

namespace flexcast::test {
namespace {

constexpr std::int32_t first_of_cloth = 12;  // the first particle of the cloth: 3 x 3 nodes, 0.5 m apart

std::string with_handles(const std::string& entries, const std::string& more = "") {
  return with_spring_lines("handle = [ " + entries + " ]\n" + more);
}

std::vector<Handle> handles(const std::string& entries, const std::string& more = "") {
  return loaded(with_handles(entries, more)).simulation->model().handles;
}

// The message behind file, line and body.
std::string handle_refusal(const std::string& entries, const std::string& more = "") {
  const std::string message = refusal(with_handles(entries, more));
  const std::string start = "test.toml:16: [[body]] \"cloth\": ";
  return message.starts_with(start) ? message.substr(start.size()) : message;
}

TEST(Handle, CarriesWhatItsEntrySays) {
  const auto all = handles(
      "{ name = \"grip\", select = { nodes = [2, 5] }, translate = [0, 0, 1], rotate = [3, 0, 0], about = [1, 2, 3], "
      "start = 0.5, duration = 2.0 }");
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].name, "grip");
  EXPECT_EQ(all[0].body, 1);
  EXPECT_EQ(all[0].particles, (std::vector<std::int32_t>{first_of_cloth + 2, first_of_cloth + 5}));
  EXPECT_EQ(all[0].translate, Vec3(0, 0, 1));
  EXPECT_EQ(all[0].rotate, Vec3(3, 0, 0));
  EXPECT_EQ(all[0].about, Vec3(1, 2, 3));
  EXPECT_EQ(all[0].start, 0.5);
  EXPECT_EQ(all[0].duration, 2.0);
}

TEST(Handle, HoldsItsParticlesUnlessToldToMove) {
  const auto all = handles("{ name = \"grip\", select = { nodes = [2] } }");
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].translate, Vec3(0, 0, 0));
  EXPECT_EQ(all[0].rotate, Vec3(0, 0, 0));
  EXPECT_EQ(all[0].start, 0.0);
  EXPECT_EQ(all[0].duration, 0.0);
}

TEST(Handle, StartsAtRestPlusDisplacementAndTurnsAboutTheRestCentroid) {
  const auto all =
      handles("{ name = \"grip\", select = { nodes = [0, 1, 3, 4] } }",
              "displacement = [ { select = { nodes = [0] }, value = [0.0, 0.0, 7.0] } ]\norigin = [1.0, 0.0, 0.0]\n");
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].about, Vec3(1.25, 0.25, 0));
  EXPECT_EQ(all[0].base, (std::vector<Vec3>{{1, 0, 7}, {1.5, 0, 0}, {1, 0.5, 0}, {1.5, 0.5, 0}}));
}

TEST(Handle, PrescribesTheVelocityOfItsParticles) {
  const Scene scene = loaded(with_handles("{ name = \"grip\", select = { nodes = [2] } }",
                                          "velocity = [ { select = { all = true }, value = [1.0, 2.0, 3.0] } ]\n"));
  EXPECT_EQ(Vec3(block3(scene.simulation->state().velocities, first_of_cloth + 2)), Vec3(0, 0, 0));
  EXPECT_EQ(Vec3(block3(scene.simulation->state().velocities, first_of_cloth + 3)), Vec3(1, 2, 3));
}

TEST(Handle, ParticleMayHaveOnlyOne) {
  EXPECT_EQ(handle_refusal("{ name = \"a\", select = { nodes = [2, 3] } }, { name = \"b\", select = { nodes = [3] } }"),
            "handle[1].select selects particle 3, which handle \"a\" moves; a particle has at most one handle");
}

TEST(Handle, ParticleMayNotBePinnedAlongAnyAxis) {
  for (const std::string axis : {"x", "y", "z", "xyz"}) {
    EXPECT_EQ(handle_refusal("{ name = \"a\", select = { nodes = [2, 3] } }",
                             "pin = [ { select = { nodes = [3] }, axes = \"" + axis + "\" } ]\n"),
              "handle[0].select selects particle 3, which is pinned; a particle has pins or a handle, not both");
  }
}

TEST(Handle, NamesDifferInTheWholeScene) {
  const std::string twice = "{ name = \"a\", select = { nodes = [2] } }, { name = \"a\", select = { nodes = [3] } }";
  EXPECT_EQ(handle_refusal(twice), "handle[1].name = \"a\" is there twice; the handles of a scene must differ in name");
  const std::string entry = "handle = [ { name = \"a\", select = { nodes = [2] } } ]\n";
  EXPECT_EQ(
      refusal(changed("model = \"fem\"\n", "model = \"fem\"\n" + entry, with_spring_lines(entry))),
      "test.toml:17: [[body]] \"cloth\": handle[0].name = \"a\" is there twice; the handles of a scene must differ "
      "in name");
}

TEST(Handle, RefusesWhatItsKeysDoNotAllow) {
  const auto with = [](const std::string& key) {
    return handle_refusal("{ name = \"a\", select = { nodes = [2] }, " + key + " }");
  };
  EXPECT_EQ(with("start = -1.0"), "handle[0].start = -1.0 is out of range (allowed: >= 0, s)");
  EXPECT_EQ(with("duration = -1.0"), "handle[0].duration = -1.0 is out of range (allowed: >= 0, s)");
  EXPECT_EQ(with("duration = inf"), "handle[0].duration = inf is out of range (allowed: >= 0, s)");
  EXPECT_EQ(with("translate = 1.0"),
            "handle[0].translate = 1.0 is a number with decimals; expected an array of 3 numbers (any finite number, "
            "m)");
  EXPECT_EQ(with("rotate = [0, nan, 0]"),
            "handle[0].rotate[1] = nan is out of range (allowed: any finite number, rad)");
  EXPECT_EQ(with("about = [0, 0]"),
            "handle[0].about = [0, 0] has 2 elements; expected an array of 3 numbers (any finite number, m)");
  EXPECT_EQ(with("rotation = [0, 0, 1]"),
            "unknown key handle[0].rotation = [0, 0, 1] (allowed: name, select, translate, rotate, about, start, "
            "duration)");
  EXPECT_EQ(handle_refusal("{ select = { nodes = [2] } }"),
            "missing key handle[0].name; expected a name (1 to 64 of A-Z, a-z, 0-9, _ and -)");
  EXPECT_EQ(handle_refusal("{ name = \"a.b\", select = { nodes = [2] } }"),
            "handle[0].name = \"a.b\" is not a name (allowed: 1 to 64 of A-Z, a-z, 0-9, _ and -)");
  EXPECT_EQ(handle_refusal("{ name = \"a\" }"), "missing key handle[0].select; expected a table");
  EXPECT_EQ(handle_refusal("{ name = \"a\", select = { sphere = [9, 9, 9, 0] } }"),
            "handle[0].select selects no particle of the body");
}

TEST(Handle, WithoutAFiniteCentroidNeedsAPoint) {
  const std::string far = "origin = [1.7e308, 0.0, 0.0]\n";
  const std::string mesh = "size = [1e300, 1e300]";
  const std::string text = with_handles("{ name = \"a\", select = { all = true } }", far);
  EXPECT_EQ(refusal(changed("size = [1.0, 1.0]", mesh, text)),
            "test.toml:16: [[body]] \"cloth\": handle[0].select selects particles whose centroid is not finite; give "
            "about");
}

}  // namespace
}  // namespace flexcast::test
