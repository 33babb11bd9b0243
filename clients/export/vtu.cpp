#include "clients/export/vtu.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <span>
#include <string_view>

namespace flexcast::exporting {
namespace {

static_assert(std::endian::native == std::endian::little, "the files say LittleEndian");

// Collects the arrays that follow the XML, each with its size before it.
class Appended {
 public:
  // The XML element of the array.
  template <class T>
  std::string add(const char* name, int components, std::span<const T> values) {
    const std::string element = fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n",
        type_name<T>(), name, components, bytes_.size());
    const std::uint64_t size = values.size_bytes();
    append(&size, sizeof size);
    append(values.data(), size);
    return element;
  }

  template <class T>
  std::string add_as(const char* name, int components, std::span<const double> values) {
    const std::vector<T> converted(values.begin(), values.end());
    return add(name, components, std::span<const T>(converted));
  }

  const std::string& bytes() const { return bytes_; }

 private:
  template <class T>
  static std::string_view type_name() {
    if constexpr (std::is_same_v<T, float>) return "Float32";
    if constexpr (std::is_same_v<T, double>) return "Float64";
    if constexpr (std::is_same_v<T, std::int64_t>) return "Int64";
    if constexpr (std::is_same_v<T, std::uint32_t>) return "UInt32";
    return "UInt8";
  }
  void append(const void* memory, std::size_t size) {
    if (size > 0) bytes_.append(static_cast<const char*>(memory), size);
  }

  std::string bytes_;
};

std::string add_vectors(Appended& appended, const char* name, std::span<const double> values, bool doubles) {
  return doubles ? appended.add_as<double>(name, 3, values) : appended.add_as<float>(name, 3, values);
}

std::string make_point_data(Appended& appended, const client::Frame& frame, const PointFields& fields) {
  std::string xml = "<PointData>\n";
  if (fields.velocities && !frame.velocities.empty()) {
    xml += add_vectors(appended, "velocity", frame.velocities, fields.doubles);
  }
  if (fields.stretch && !frame.stretch.empty()) xml += appended.add_as<float>("stretch", 1, frame.stretch);
  if (fields.stress && !frame.stress.empty()) xml += appended.add_as<float>("stress", 1, frame.stress);
  return xml + "</PointData>\n";
}

std::string make_cells(Appended& appended, const Geometry& geometry) {
  return "<CellData>\n" + appended.add("body", 1, std::span<const std::uint32_t>(geometry.bodies)) +
         "</CellData>\n<Cells>\n" +
         appended.add("connectivity", 1, std::span<const std::int64_t>(geometry.connectivity)) +
         appended.add("offsets", 1, std::span<const std::int64_t>(geometry.offsets)) +
         appended.add("types", 1, std::span<const std::uint8_t>(geometry.types)) + "</Cells>\n";
}

}  // namespace

std::string make_vtu(const client::Frame& frame, const Geometry& geometry, const PointFields& fields) {
  Appended appended;
  std::string xml =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
      "<UnstructuredGrid>\n<FieldData>\n";
  xml += fmt::format(
      "<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">{}</DataArray>\n",
      frame.time);
  xml += fmt::format("</FieldData>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", geometry.points,
                     geometry.types.size());
  xml += make_point_data(appended, frame, fields);
  xml += "<Points>\n" + add_vectors(appended, "positions", frame.positions, fields.doubles) + "</Points>\n";
  xml += make_cells(appended, geometry);
  xml += "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
  xml += appended.bytes();
  return xml + "\n</AppendedData>\n</VTKFile>\n";
}

std::string make_pvd(const std::vector<std::pair<double, std::string>>& files) {
  std::string xml =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
      "<Collection>\n";
  for (const auto& [time, file] : files) {
    xml += fmt::format("<DataSet timestep=\"{}\" group=\"\" part=\"0\" file=\"{}\"/>\n", time, file);
  }
  return xml + "</Collection>\n</VTKFile>\n";
}

}  // namespace flexcast::exporting
