#include "core/mesh/vtk_legacy_reader.h"

#include <algorithm>
#include <cctype>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>

#include "core/mesh/vtk_cells.h"
#include "core/mesh/vtk_numbers.h"

namespace flexcast {
namespace {

std::string to_lower(std::string_view word) {
  std::string lower(word);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
  return lower;
}

// Keywords may be written in small letters.
class VtkLegacyReader {
 public:
  explicit VtkLegacyReader(const FileContent& file) : cursor_(file) {}

  Result<NumberedMesh> read() {
    read_head();
    while (!cursor_.failed() && !at_data_) {
      cursor_.skip_white_space();
      if (cursor_.at_end()) break;
      read_section(to_lower(cursor_.word("a section")));
    }
    if (cursor_.failed()) return cursor_.error();
    for (const auto& [found, section] :
         {std::pair(has_points_, "POINTS"), std::pair(has_cells_, "CELLS"), std::pair(has_types_, "CELL_TYPES")}) {
      if (!found) return Error{cursor_.name() + ": has no " + section + " section"};
    }
    mesh_.node_file = mesh_.element_file = cursor_.name();
    if (const auto wrong = append_tetrahedra(cells_, 0, 0, mesh_)) return Error{cursor_.name() + ": " + *wrong};
    return std::move(mesh_);
  }

 private:
  void read_head() {
    constexpr std::string_view start = "# vtk datafile version ";
    const std::string line = to_lower(cursor_.line());
    if (!line.starts_with(start)) {
      return fail_at(line, "'# vtk DataFile Version' of a VTK file is");
    }
    const std::string version = line.substr(start.size(), line.find_last_not_of(" \t") + 1 - start.size());
    const auto number = parse_number(version);
    if (!number || !(*number >= 1.0 && *number <= 5.1)) {
      return cursor_.fail("VTK format version " + quoted(std::string_view(version)) +
                          " is not supported; 1.0 to 5.1 are");
    }
    has_offsets_ = *number >= 5.0;
    cursor_.line();  // a title
    const std::string format = to_lower(cursor_.word("ASCII or BINARY"));
    if (cursor_.failed()) return;
    if (format != "ascii" && format != "binary") {
      return fail_at(format, "ASCII or BINARY is");
    }
    binary_ = format == "binary";
    if (binary_) cursor_.count_bytes();
    const std::string dataset = to_lower(cursor_.word("DATASET"));
    if (!cursor_.failed() && dataset != "dataset") {
      return fail_at(dataset, "DATASET is");
    }
    const std::string type = to_lower(cursor_.word("the type of the dataset"));
    if (!cursor_.failed() && type != "unstructured_grid") {
      cursor_.fail("a dataset of type " + quoted(std::string_view(type)) + " is not supported; UNSTRUCTURED_GRID is");
    }
  }

  void fail_at(std::string_view found, const std::string& expected) {
    cursor_.fail("found " + quoted(found) + " where " + expected + " expected");
  }

  void read_section(const std::string& section) {
    if (section == "points") return read_points();
    if (section == "cells") return read_cells();
    if (section == "cell_types") return read_cell_types();
    if (section == "field") return skip_field();
    if (section == "metadata") return skip_metadata();
    at_data_ = section == "cell_data" || section == "point_data";
    if (!at_data_) fail_at(section, "a section of an unstructured grid is");
  }

  void read_points() {
    if (!begin_section(has_points_, "POINTS")) return;
    const std::int64_t count = cursor_.integer("the number of points");
    const VtkNumberType* type = read_type();
    const std::vector<double> values = read_values(count, 3, *type, "points", &VtkLegacyReader::reals);
    if (cursor_.failed()) return;
    mesh_.nodes.reserve(values.size() / 3);
    for (std::size_t i = 0; i + 2 < values.size(); i += 3) {
      mesh_.nodes.emplace_back(values[i], values[i + 1], values[i + 2]);
    }
    mesh_.node_numbers.resize(mesh_.nodes.size());
    std::iota(mesh_.node_numbers.begin(), mesh_.node_numbers.end(), std::int64_t{0});
  }

  void read_cells() {
    if (!begin_section(has_cells_, "CELLS")) return;
    const std::int64_t first = cursor_.integer("a number of cells");
    const std::int64_t second = cursor_.integer("the size of the cells");
    if (has_offsets_) {
      cells_.offsets = read_part("offsets", first);
      cells_.connectivity = read_part("connectivity", second);
    } else {
      cursor_.line();
      read_lists(first, read_values(second, 1, *find_legacy_type("int"), "numbers", &VtkLegacyReader::integers));
    }
  }

  // Since 5.0: OFFSETS TYPE, or CONNECTIVITY TYPE, then the numbers.
  std::vector<std::int64_t> read_part(const std::string& name, std::int64_t count) {
    const std::string found = to_lower(cursor_.word(name.c_str()));
    if (!cursor_.failed() && found != name) fail_at(found, name + " are");
    const VtkNumberType* type = read_type();
    if (!cursor_.failed() && type->kind == NumberKind::real) {
      cursor_.fail("the type " + std::string(type->name) + " is not one of whole numbers");
    }
    return read_values(count, 1, *type, name.c_str(), &VtkLegacyReader::integers);
  }

  // Before: of each cell how many points it has, and these.
  void read_lists(std::int64_t count, const std::vector<std::int64_t>& numbers) {
    cells_.offsets.assign(1, 0);
    std::size_t at = 0;
    for (std::int64_t cell = 0; cell < count && !cursor_.failed(); ++cell) {
      const std::int64_t points = at < numbers.size() ? numbers[at++] : -1;
      if (points < 0 || static_cast<std::uint64_t>(points) > numbers.size() - at) {
        return cursor_.fail("the " + std::to_string(numbers.size()) + " numbers of the cells end within cell " +
                            std::to_string(cell) + " of " + std::to_string(count));
      }
      const auto first = numbers.begin() + static_cast<std::ptrdiff_t>(at);
      cells_.connectivity.insert(cells_.connectivity.end(), first, first + points);
      cells_.offsets.push_back(static_cast<std::int64_t>(cells_.connectivity.size()));
      at += static_cast<std::size_t>(points);
    }
    if (!cursor_.failed() && at != numbers.size()) {
      cursor_.fail("there are " + std::to_string(numbers.size() - at) + " numbers more than the cells need");
    }
  }

  void read_cell_types() {
    if (!begin_section(has_types_, "CELL_TYPES")) return;
    const std::int64_t count = cursor_.integer("the number of cells");
    cursor_.line();
    cells_.types = read_values(count, 1, *find_legacy_type("int"), "cell types", &VtkLegacyReader::integers);
  }

  bool begin_section(bool& seen, const char* name) {
    if (std::exchange(seen, true)) cursor_.fail(std::string("there is a second ") + name + " section");
    return !cursor_.failed();
  }

  // The rest of the line, too. Some type after a failure.
  const VtkNumberType* read_type() {
    const std::string_view name = cursor_.word("a number type");
    const VtkNumberType* type = find_legacy_type(name);
    if (!cursor_.failed() && type == nullptr) cursor_.fail("the type " + quoted(name) + " is not supported");
    cursor_.line();
    return type != nullptr ? type : find_legacy_type("int");
  }

  template <class T>
  std::vector<T> read_values(std::int64_t count, std::int64_t each, const VtkNumberType& type, const char* what,
                             std::vector<T> (VtkLegacyReader::*convert)(std::uint64_t, const VtkNumberType&)) {
    cursor_.check_count(count, static_cast<std::uint64_t>(each) * (binary_ ? type.bytes : 1), what);
    if (cursor_.failed()) return {};
    return (this->*convert)(static_cast<std::uint64_t>(count * each), type);
  }

  std::vector<double> reals(std::uint64_t count, const VtkNumberType& type) {
    if (binary_) return read_reals(cursor_.bytes(count * type.bytes, "coordinates"), type, ByteOrder::big);
    std::vector<double> values;
    values.reserve(count);
    while (values.size() < count && !cursor_.failed()) values.push_back(cursor_.number("a coordinate"));
    return values;
  }

  std::vector<std::int64_t> integers(std::uint64_t count, const VtkNumberType& type) {
    if (binary_) {
      auto values = read_integers(cursor_.bytes(count * type.bytes, "whole numbers"), type, ByteOrder::big);
      if (!values) cursor_.fail("a number is larger than 2^63 - 1");
      return std::move(values).value_or(std::vector<std::int64_t>());
    }
    std::vector<std::int64_t> values;
    values.reserve(count);
    while (values.size() < count && !cursor_.failed()) values.push_back(cursor_.integer("a number of the cells"));
    return values;
  }

  // FIELD NAME ARRAYS, of each array NAME COMPONENTS TUPLES TYPE and the values.
  void skip_field() {
    cursor_.word("the name of a field");
    const std::int64_t arrays = cursor_.integer("the number of arrays");
    for (std::int64_t array = 0; array < arrays && !cursor_.failed(); ++array) {
      cursor_.word("the name of an array");
      const std::int64_t components = cursor_.integer("a number of components");
      const std::int64_t tuples = cursor_.integer("a number of tuples");
      const VtkNumberType* type = read_type();
      cursor_.check_count(components, 1, "components");
      if (!cursor_.failed()) skip_values(components, tuples, *type);
      skip_following_metadata();
    }
  }

  void skip_values(std::int64_t components, std::int64_t tuples, const VtkNumberType& type) {
    const std::uint64_t bytes_each = static_cast<std::uint64_t>(components) * (binary_ ? type.bytes : 1);
    if (bytes_each == 0) return;
    cursor_.check_count(tuples, bytes_each, "values of a field");
    if (cursor_.failed()) return;
    const std::uint64_t count = static_cast<std::uint64_t>(components * tuples);
    if (binary_) cursor_.bytes(count * type.bytes, "values of a field");
    for (std::uint64_t i = 0; !binary_ && i < count && !cursor_.failed(); ++i) cursor_.number("a value of a field");
  }

  void skip_following_metadata() {
    cursor_.skip_white_space();
    if (cursor_.failed() || !to_lower(cursor_.peek(8)).starts_with("metadata")) return;
    cursor_.word("METADATA");
    skip_metadata();
  }

  // Lines up to an empty one.
  void skip_metadata() {
    cursor_.line();
    while (!cursor_.failed() && !cursor_.at_end() && !cursor_.line().empty()) {
    }
  }

  FileCursor cursor_;
  bool binary_ = false;
  bool has_offsets_ = false;
  bool has_points_ = false, has_cells_ = false, has_types_ = false;
  bool at_data_ = false;  // what follows does not concern the mesh
  VtkCells cells_;
  NumberedMesh mesh_;
};

}  // namespace

Result<NumberedMesh> parse_vtk_legacy(const FileContent& file) {
  return VtkLegacyReader(file).read();
}

}  // namespace flexcast
