// TetGen `.node` and `.ele` files.
#pragma once

#include "core/base/result.h"
#include "core/mesh/file_cursor.h"
#include "core/mesh/mesh_checks.h"

namespace flexcast {

// Numbers start at 0 or 1, as those of the nodes do. Attributes, boundary markers and comments are ignored.
// Source: TetGen manual, "File formats".
Result<NumberedMesh> parse_tetgen(const FileContent& node_file, const FileContent& ele_file);

}  // namespace flexcast
