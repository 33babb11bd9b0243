// What an exact solution does not know of: the sentence that says so.
#pragma once

#include <string>

#include "core/forces/model.h"

namespace flexcast {

// What damps anything in the scene, "" when nothing does: "body \"beam\" has drag".
std::string find_damping(const Model& model);

// Obstacles, handles or grabs: "the scene has the obstacle \"ground\""; "" when there is none.
std::string find_guidance(const Model& model);

}  // namespace flexcast
