// A description becomes what a simulation is made of.
#pragma once

#include "core/forces/model.h"
#include "core/scene/description.h"
#include "core/scene/file_places.h"
#include "core/scene/scene.h"
#include "core/state/state.h"

namespace flexcast {

struct BuiltScene {
  Model model;
  State state;
  std::vector<Probe> probes;
  std::vector<SceneAttachment> files;
  std::vector<std::string> notes;
};

// Makes the meshes, places and joins them, and applies masses, pins and starting values. Everything in the result is
// finite, masses are positive, no spring has the rest length 0 and no tetrahedron is flat. Throws SceneError.
BuiltScene build_scene(const SceneDescription& description, const FilePlaces& files);

}  // namespace flexcast
