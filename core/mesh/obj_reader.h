// Wavefront `.obj` files.
#pragma once

#include "core/base/result.h"
#include "core/mesh/file_cursor.h"
#include "core/mesh/surface_checks.h"

namespace flexcast {

// Vertices (v) become nodes, faces (f) polygons: corners as V, V/VT, V//VN or V/VT/VN, negative numbers count back from
// the last vertex so far, forward references are allowed. Texture coordinates, normals, groups, materials and display
// settings are ignored, points and lines, too; free-form geometry is refused. Weights and colours of vertices are
// ignored. A line may go on after a backslash. Errors name the line.
// Source: "Object Files (.obj)", Advanced Visualizer manual, appendix B1.
Result<NumberedSurface> parse_obj(const FileContent& file);

}  // namespace flexcast
