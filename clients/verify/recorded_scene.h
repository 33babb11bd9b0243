// The scene of a recorded run, loaded again from what the recording carries.
#pragma once

#include "core/scene/scene.h"
#include "idl/wire/types.h"

namespace flexcast::verify {

// Loads text, overrides and files; these lie in a folder of their own while it does. Errors say what does not fit,
// among them names of files that would lie outside that folder.
Result<Scene> load_recorded_scene(const flexcast_SceneInfo& info);

}  // namespace flexcast::verify
