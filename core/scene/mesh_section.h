// The mesh of a body: what its table says, and the mesh made from it.
#pragma once

#include "core/mesh/mesh.h"
#include "core/mesh/mesh_file.h"
#include "core/scene/description.h"
#include "core/scene/file_places.h"
#include "core/scene/table_reader.h"

namespace flexcast {

// { shape, cells, size } | { file, scale }. `fem`: only what has tetrahedra.
MeshDescription read_mesh_section(const TableEntry& entry, bool fem);

// Generates or reads the mesh (its file where `files` says), coordinates scaled; without `fem` the edges of
// tetrahedra are its springs. `repairs` and `files` are those of the file. Throws SceneError.
MeshFile make_mesh(const MeshDescription& description, bool fem, const FilePlaces& files);

}  // namespace flexcast
