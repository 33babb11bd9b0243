#include "core/mesh/vtu_reader.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

#include "core/mesh/vtk_cells.h"
#include "core/mesh/vtu_document.h"

namespace flexcast {
namespace {

class VtuReader {
 public:
  explicit VtuReader(const FileContent& file) : document_(file) { mesh_.node_file = mesh_.element_file = file.name; }

  Result<NumberedMesh> read() {
    if (auto parsed = document_.parse(); !parsed) return parsed.error();
    for (const pugi::xml_node piece : document_.grid().children("Piece")) {
      if (auto taken = read_piece(piece); !taken) return taken.error();
    }
    mesh_.node_numbers.resize(mesh_.nodes.size());
    std::iota(mesh_.node_numbers.begin(), mesh_.node_numbers.end(), std::int64_t{0});
    return std::move(mesh_);
  }

 private:
  Result<void> read_piece(pugi::xml_node piece) {
    const auto points = document_.count_of(piece, "NumberOfPoints");
    if (!points) return points.error();
    const auto cells = document_.count_of(piece, "NumberOfCells");
    if (!cells) return cells.error();
    const auto first_node = static_cast<std::int64_t>(mesh_.nodes.size());
    if (auto taken = read_points(piece, points.value()); !taken) return taken;
    return read_cells(piece, points.value(), cells.value(), first_node);
  }

  Result<void> read_points(pugi::xml_node piece, std::int64_t count) {
    const pugi::xml_node array = piece.child("Points").child("DataArray");
    if (!array) return document_.error_at(piece, "the piece has no array of points");
    if (array.attribute("NumberOfComponents").as_int() != 3) {
      return document_.error_at(array, "points have " +
                                           quoted(std::string_view(array.attribute("NumberOfComponents").value())) +
                                           " components; 3 are needed");
    }
    const auto values = document_.reals_of(array, 3 * count);
    if (!values) return values.error();
    for (std::size_t i = 0; i + 2 < values.value().size(); i += 3) {
      mesh_.nodes.emplace_back(values.value()[i], values.value()[i + 1], values.value()[i + 2]);
    }
    return {};
  }

  Result<void> read_cells(pugi::xml_node piece, std::int64_t points, std::int64_t count, std::int64_t first_node) {
    VtkCells cells;
    if (auto taken = read_array(piece, "types", count, cells.types); !taken) return taken;
    if (auto taken = read_array(piece, "offsets", count, cells.offsets); !taken) return taken;
    const std::int64_t named = cells.offsets.empty() ? 0 : cells.offsets.back();
    const pugi::xml_node node = piece.child("Cells");
    // Of 8 bytes each and more their size could still be counted.
    constexpr std::int64_t most = std::int64_t{1} << 40;
    if (named < 0 || named > most) {
      return document_.error_at(node, "the offsets end at " + std::to_string(named) + ", which is no size");
    }
    if (auto taken = read_array(piece, "connectivity", named, cells.connectivity); !taken) return taken;
    for (const std::int64_t point : cells.connectivity) {
      if (point >= 0 && point < points) continue;
      return document_.error_at(
          node, "the cells name point " + std::to_string(point) + "; the piece has " + std::to_string(points));
    }
    cells.offsets.insert(cells.offsets.begin(), 0);
    if (const auto wrong = append_tetrahedra(cells, first_node, cells_, mesh_)) return document_.error_at(node, *wrong);
    cells_ += count;
    return {};
  }

  Result<void> read_array(pugi::xml_node piece, const char* name, std::int64_t count,
                          std::vector<std::int64_t>& values) {
    const pugi::xml_node array = piece.child("Cells").find_child_by_attribute("DataArray", "Name", name);
    if (!array) return document_.error_at(piece, std::string("the piece has no array '") + name + "' of its cells");
    auto read = document_.integers_of(array, count);
    if (!read) return read.error();
    values = std::move(read).value();
    return {};
  }

  VtuDocument document_;
  NumberedMesh mesh_;
  std::int64_t cells_ = 0;  // of the pieces so far
};

}  // namespace

Result<NumberedMesh> parse_vtu(const FileContent& file) {
  return VtuReader(file).read();
}

}  // namespace flexcast
