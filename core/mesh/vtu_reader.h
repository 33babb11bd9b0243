// VTK's XML files of unstructured grids (`.vtu`): ascii, base64 inline, appended raw or base64, plain or compressed by
// zlib, either byte order.
#pragma once

#include "core/base/result.h"
#include "core/mesh/file_cursor.h"
#include "core/mesh/mesh_checks.h"

namespace flexcast {

// The tetrahedra of all pieces, points and cells numbered from 0 on through the pieces; points, lines and surfaces are
// ignored, other volume cells refused, and so are other compressors. Errors name the line of the array.
// Source: "VTK XML file formats".
Result<NumberedMesh> parse_vtu(const FileContent& file);

}  // namespace flexcast
