// The scene of a recorded run, loaded again from what the recording carries.
#pragma once

#include "core/scene/scene.h"
#include "idl/wire/types.h"

namespace flexcast::verify {

// Loads text, overrides and files. While it does, these lie in a temporary folder, and no other is read or written:
// whatever the scene calls them (absolute names, too), they are looked for there. Errors say what does not fit.
Result<Scene> load_recorded_scene(const flexcast_SceneInfo& info);

}  // namespace flexcast::verify
