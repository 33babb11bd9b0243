// A body's mesh moves to its place in the world.
#pragma once

#include "core/mesh/mesh.h"
#include "core/scene/description.h"

namespace flexcast {

// Nodes become rest positions, R X + origin, for the already scaled mesh. Refuses what the engine could not compute
// with there: positions that are not finite, springs of rest length 0, tetrahedra without volume. Throws SceneError.
void place_mesh(const BodyDescription& body, Mesh& mesh);

}  // namespace flexcast
