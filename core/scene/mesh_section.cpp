#include "core/scene/mesh_section.h"

#include "core/mesh/topology.h"
#include "core/scene/body_reader.h"
#include "core/scene/shapes.h"
#include "core/scene/suggestion.h"
#include "core/scene/value_text.h"

namespace flexcast {
namespace {

std::vector<std::string_view> shape_names(bool fem) {
  std::vector<std::string_view> names;
  for (const ShapeRow& row : shape_rows())
    if (row.fem || !fem) names.push_back(row.name);
  return names;
}

std::string read_shape(const TableReader& reader, bool fem) {
  const std::string allowed = join_quoted(shape_names(fem)) + ", or a file";
  if (!reader.has("shape")) reader.refuse_missing("shape", "one of " + allowed);
  const std::string shape = reader.require_choice("shape", shape_names(false));
  if (fem && !find_shape(shape)->fem)
    reader.refuse_value("shape", "has no tetrahedra, which model = \"fem\" needs (allowed: " + allowed + ")");
  return shape;
}

std::vector<std::int64_t> read_cells(const TableReader& reader, std::size_t dimensions) {
  const Quantity allowed{{1.0, most_particles, false, false}, ""};
  const std::string expected = "an array of " + std::to_string(dimensions) + " integers (" + allowed.text() + ")";
  if (!reader.has("cells")) reader.refuse_missing("cells", expected);
  const std::vector<std::int64_t> cells = *reader.integers("cells", allowed);
  if (cells.size() != dimensions)
    reader.refuse_value("cells", "has " + std::to_string(cells.size()) + " elements; expected " + expected);
  double particles = 1.0;
  for (std::int64_t count : cells) particles *= static_cast<double>(count) + 1.0;
  if (particles > most_particles)
    reader.refuse_value(
        "cells", "makes " + count_text(particles) + " particles (allowed: at most " + count_text(most_particles) + ")");
  return cells;
}

std::vector<double> read_size(const TableReader& reader, std::size_t dimensions) {
  const Quantity allowed{ranges::positive, "m"};
  if (!reader.has("size"))
    reader.refuse_missing("size", "an array of " + std::to_string(dimensions) + " numbers (" + allowed.text() + ")");
  return *reader.numbers("size", dimensions, allowed);
}

Mesh generate(const MeshDescription& description) {
  const std::vector<int> cells(description.cells.begin(), description.cells.end());
  return find_shape(description.shape)->make(cells, description.size);
}

// `mesh.file = "x.msh" cannot be used: REASON`
MeshFile read_file(const MeshDescription& description, bool fem, const FilePlaces& files) {
  Result<MeshFile> file = read_mesh_file(files(description.file));
  if (!file) refuse(description.place, "= \"" + description.file + "\" cannot be used: " + file.error().message);
  if (fem && file.value().mesh.tetrahedra.empty())
    refuse(description.place, "= \"" + description.file +
                                  "\" is a surface; model = \"fem\" needs tetrahedra (allowed: a file of these, or "
                                  "model = \"mass_spring\")");
  if (static_cast<double>(file.value().mesh.nodes.size()) > most_particles)
    refuse(description.place, "= \"" + description.file + "\" has more than " + count_text(most_particles) + " nodes");
  for (Vec3& node : file.value().mesh.nodes) node *= description.scale;
  return std::move(file).value();
}

}  // namespace

MeshDescription read_mesh_section(const TableEntry& entry, bool fem) {
  const TableReader reader(entry, entry.table->contains("file")
                                      ? std::vector<std::string_view>{"file", "scale"}
                                      : std::vector<std::string_view>{"shape", "cells", "size", "file"});
  MeshDescription mesh;
  if (reader.has("file")) {
    mesh.place = reader.place_of("file");
    mesh.file = *reader.text("file");
    mesh.scale = reader.number("scale", {ranges::positive, ""}).value_or(mesh.scale);
    if (mesh.file.empty()) reader.refuse_value("file", "is empty; expected the name of a file");
    return mesh;
  }
  mesh.place = entry.place;
  mesh.shape = read_shape(reader, fem);
  const std::size_t dimensions = find_shape(mesh.shape)->dimensions;
  mesh.cells = read_cells(reader, dimensions);
  mesh.size = read_size(reader, dimensions);
  return mesh;
}

MeshFile make_mesh(const MeshDescription& description, bool fem, const FilePlaces& files) {
  MeshFile made =
      description.file.empty() ? MeshFile{generate(description), {}, {}} : read_file(description, fem, files);
  if (!fem && made.mesh.springs.empty()) made.mesh.springs = make_edges(made.mesh.tetrahedra);
  if (fem) made.mesh.springs.clear();
  if (!fem) made.mesh.tetrahedra.clear();
  return made;
}

}  // namespace flexcast
