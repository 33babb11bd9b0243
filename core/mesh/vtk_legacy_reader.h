// VTK's legacy files (`.vtk`), ASCII and binary, versions 1.0 to 5.1.
#pragma once

#include "core/base/result.h"
#include "core/mesh/file_cursor.h"
#include "core/mesh/mesh_checks.h"

namespace flexcast {

// The tetrahedra of an UNSTRUCTURED_GRID; other datasets and other volume cells are refused, points, lines and surfaces
// ignored, and so are the data of points and cells. Points and cells are numbered from 0.
// Source: The Visualization Toolkit User's Guide, "VTK File Formats", and the release notes of 5.1's OFFSETS.
Result<NumberedMesh> parse_vtk_legacy(const FileContent& file);

}  // namespace flexcast
