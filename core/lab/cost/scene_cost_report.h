// What a scene's features cost, for people and for programs.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "core/lab/cost/scene_cost.h"

namespace flexcast {

std::string make_scene_cost_text(const SceneCost& cost);

// The object that `flexcast-lab scene-cost --json` prints. Times in microseconds; null: the scene failed without it.
nlohmann::ordered_json make_scene_cost_json(const SceneCost& cost);

}  // namespace flexcast
