// The TOML document of a scene becomes a description.
#pragma once

#include <toml++/toml.h>

#include "core/scene/description.h"

namespace flexcast {

// `document` was parsed with the name that errors shall show as its source path. Throws SceneError.
SceneDescription read_scene(const toml::table& document);

}  // namespace flexcast
