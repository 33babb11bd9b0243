// What a world's scene tells the network once a run: fixed when the server starts.
#pragma once

#include <string>
#include <vector>

#include "core/forces/model.h"
#include "core/scene/scene.h"
#include "core/sim/settings.h"

namespace flexcast::server {

struct SceneFacts {
  std::string world;
  std::string name;
  std::string description;
  std::string text;  // the scene file
  std::vector<std::string> overrides;
  std::vector<SceneAttachment> files;
  std::vector<Probe> probes;
  // Read while the world runs: only names, ranges, rest positions and connections, which no parameter changes.
  const Model* model = nullptr;
};

}  // namespace flexcast::server
