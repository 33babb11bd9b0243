// Small mesh files for the readers' tests: written in the test, or shipped in the data folder.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <initializer_list>
#include <string>

#include "core/mesh/file_cursor.h"
#include "core/mesh/gmsh_reader.h"
#include "core/mesh/mesh_checks.h"
#include "core/mesh/obj_reader.h"
#include "core/mesh/tetgen_reader.h"
#include "core/mesh/vtk_legacy_reader.h"
#include "core/mesh/vtu_reader.h"

namespace flexcast::mesh_texts {

inline std::filesystem::path data_path(const std::string& name) {
  return std::filesystem::path(FLEXCAST_SOURCE_DIR) / "tests/core/mesh/data" / name;
}

inline FileContent data_file(const std::string& name) {
  auto file = read_whole_file(data_path(name));
  EXPECT_TRUE(file.ok()) << name;
  return file ? FileContent{name, file.value().bytes} : FileContent{name, ""};
}

inline const std::string corner_nodes_22 = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n";
inline const std::string corner_elements_22 = "$Elements\n1\n1 4 2 0 1 1 2 3 4\n$EndElements\n";
inline const std::string format_22 = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
inline const std::string format_41 = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";

// One tetrahedron at the origin.
inline const std::string corner_22 = format_22 + corner_nodes_22 + corner_elements_22;
inline const std::string corner_41 = format_41 +
                                     "$Nodes\n1 4 1 4\n3 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n$EndNodes\n"
                                     "$Elements\n1 1 1 1\n3 1 4 1\n1 1 2 3 4\n$EndElements\n";
inline const std::string corner_node = "4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n# the end of the nodes\n";
inline const std::string corner_ele = "1 4 0\n1 1 2 3 4\n";

// The text with one part, which must be there, replaced.
inline std::string with(std::string text, const std::string& part, const std::string& replacement) {
  const std::size_t found = text.find(part);
  EXPECT_NE(found, std::string::npos) << part;
  return found == std::string::npos ? text : text.replace(found, part.size(), replacement);
}

inline Result<MeshFile> read_gmsh_file(const FileContent& file) {
  const auto numbered = parse_gmsh(file);
  return numbered ? check_mesh(numbered.value()) : numbered.error();
}

inline Result<MeshFile> read_gmsh_text(const std::string& text) {
  return read_gmsh_file({"a.msh", text});
}

inline Result<MeshFile> read_tetgen_text(const std::string& node, const std::string& ele) {
  const auto numbered = parse_tetgen({"a.node", node}, {"a.ele", ele});
  return numbered ? check_mesh(numbered.value()) : numbered.error();
}

inline Result<MeshFile> read_obj_text(const std::string& text) {
  const auto surface = parse_obj({"a.obj", text});
  return surface ? make_cloth(surface.value()) : surface.error();
}

inline Result<MeshFile> read_vtu_file(const FileContent& file) {
  const auto numbered = parse_vtu(file);
  return numbered ? check_mesh(numbered.value()) : numbered.error();
}

inline Result<MeshFile> read_vtu_text(const std::string& text) {
  return read_vtu_file({"a.vtu", text});
}

// Either, by its suffix.
inline Result<MeshFile> read_vtk_file(const FileContent& file) {
  if (file.name.ends_with(".vtu")) return read_vtu_file(file);
  const auto numbered = parse_vtk_legacy(file);
  return numbered ? check_mesh(numbered.value()) : numbered.error();
}

inline Result<MeshFile> read_vtk_text(const std::string& text) {
  return read_vtk_file({"a.vtk", text});
}

// Refused with one sentence that has all these parts.
inline void expect_refused(const Result<MeshFile>& result, std::initializer_list<const char*> parts) {
  ASSERT_FALSE(result.ok());
  const std::string& message = result.error().message;
  for (const char* part : parts) EXPECT_NE(message.find(part), std::string::npos) << message << "\nlacks " << part;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

}  // namespace flexcast::mesh_texts
