// FilePlaces: where the files lie that a scene names, for scenes whose files do not lie where they say.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace flexcast {

struct Scene;

// Takes a name as the scene writes it, absolute ones too.
using FilePlaces = std::function<std::filesystem::path(const std::filesystem::path& name)>;

// As load_scene_text() of scene.h, with files where `files` says.
Result<Scene> load_scene_text(const std::string& text, const std::string& origin, const FilePlaces& files,
                              const std::vector<std::string>& overrides);

}  // namespace flexcast
