// What a scene names and could do without: each thing with the change to the scene that leaves it out.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/scene/description.h"

namespace flexcast {

struct SceneFeature {
  std::string name;  // "gravity", "contact ball", "friction of ball", "body cloth"
  std::function<void(SceneDescription&)> leave_out;
};

// Gravity, each kind of damping, drag, loads, each obstacle and its friction, each handle, and each body of several.
// What is named with no effect (a coefficient of zero) is not among them.
std::vector<SceneFeature> list_features(const SceneDescription& description);

}  // namespace flexcast
