// Gmsh `.msh` files, versions 2.2 and 4.1, ASCII and binary.
#pragma once

#include "core/base/result.h"
#include "core/mesh/file_cursor.h"
#include "core/mesh/mesh_checks.h"

namespace flexcast {

// Tetrahedra become elements; points, lines and surfaces are ignored, other volume elements refused.
// Source: Gmsh reference manual, "MSH file format" and "MSH file format version 2 (legacy)".
Result<NumberedMesh> parse_gmsh(const FileContent& file);

}  // namespace flexcast
