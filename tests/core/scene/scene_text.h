// A scene for tests, and changes to its text.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "core/scene/scene.h"

namespace flexcast::test {

// Tests name these lines by number.
inline const std::string valid_scene =                                                 // line
    "name = \"test\"\n"                                                                //  1
    "gravity = [0.0, 0.0, -9.81]\n"                                                    //  2
    "[time]\n"                                                                         //  3
    "step = 0.001\n"                                                                   //  4
    "[[body]]\n"                                                                       //  5
    "name = \"beam\"\n"                                                                //  6
    "model = \"fem\"\n"                                                                //  7
    "mesh = { shape = \"beam\", cells = [2, 1, 1], size = [2.0, 1.0, 1.0] }\n"         //  8
    "material = { law = \"linear\", young = 1e6, poisson = 0.4, density = 1000.0 }\n"  //  9
    "[[body]]\n"                                                                       // 10
    "name = \"cloth\"\n"                                                               // 11
    "model = \"mass_spring\"\n"                                                        // 12
    "mesh = { shape = \"grid\", cells = [2, 2], size = [1.0, 1.0] }\n"                 // 13
    "springs = { stiffness = 100.0 }\n"                                                // 14
    "mass = 0.1\n"                                                                     // 15
    "[[probe]]\n"                                                                      // 16
    "name = \"tip\"\n"                                                                 // 17
    "body = \"beam\"\n"                                                                // 18
    "at = [2.0, 0.0, 0.0]\n";                                                          // 19

// The scene with the first `from` replaced.
inline std::string changed(const std::string& from, const std::string& to, std::string text = valid_scene) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  if (at != std::string::npos) text.replace(at, from.size(), to);
  return text;
}

// The scene with lines behind the body of springs (from line 16 on).
inline std::string with_spring_lines(const std::string& lines) {
  return changed("[[probe]]\n", lines + "\n[[probe]]\n");
}

inline Result<Scene> load(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return load_scene_text(text, "test.toml", FLEXCAST_SOURCE_DIR "/server/scenes", overrides);
}

// The message of a scene that must be refused.
inline std::string refusal(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const auto scene = load(text, overrides);
  return scene ? "accepted" : scene.error().message;
}

// A scene that must be accepted.
inline Scene loaded(const std::string& text, const std::vector<std::string>& overrides = {}) {
  auto scene = load(text, overrides);
  if (!scene) ADD_FAILURE() << scene.error().message;
  return scene ? std::move(scene).value() : Scene{};
}

}  // namespace flexcast::test
