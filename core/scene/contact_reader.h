// One [[contact]] of a scene: a solid obstacle.
#pragma once

#include "core/forces/model.h"
#include "core/scene/table_reader.h"

namespace flexcast {

// The place of the entry leads its errors. Throws SceneError.
Obstacle read_contact(const TableEntry& entry);

}  // namespace flexcast
