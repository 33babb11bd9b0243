// One [[body]] of a scene.
#pragma once

#include "core/scene/description.h"
#include "core/scene/table_reader.h"

namespace flexcast {

// `number` counts from 1 and names the body in errors as long as its name is not known. Throws SceneError.
BodyDescription read_body(const TableEntry& entry, std::size_t number);

// `"beam"` for a table with that name, else its number: for errors.
std::string owner_name(const TableEntry& entry, std::size_t number);

// More particles than this are refused: scene files can write numbers that no memory holds.
inline constexpr double most_particles = 50e6;

}  // namespace flexcast
