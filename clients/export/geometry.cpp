#include "clients/export/geometry.h"

#include <algorithm>
#include <map>
#include <string>

#include "idl/wire/decode.h"
#include "idl/wire/fill.h"

namespace flexcast::exporting {
namespace {

constexpr std::uint8_t vtk_line = 3;
constexpr std::uint8_t vtk_tetra = 10;

// `size` points a cell.
void add_cells(Geometry& geometry, std::span<const std::uint32_t> points, std::size_t size, std::uint8_t type,
               std::uint32_t body) {
  for (std::size_t i = 0; i + size <= points.size(); i += size) {
    geometry.connectivity.insert(geometry.connectivity.end(), points.begin() + static_cast<std::ptrdiff_t>(i),
                                 points.begin() + static_cast<std::ptrdiff_t>(i + size));
    geometry.offsets.push_back(static_cast<std::int64_t>(geometry.connectivity.size()));
    geometry.types.push_back(type);
    geometry.bodies.push_back(body);
  }
}

wire::Result<void> check(const std::string& path, const Geometry& geometry,
                         const std::map<std::uint32_t, std::uint32_t>& missing) {
  if (geometry.types.empty()) return wire::Error{path + ": the topology of these frames was not recorded"};
  for (const auto& [body, chunks] : missing) {
    if (chunks == 0) continue;
    return wire::Error{path + ": " + std::to_string(chunks) + " part(s) of the topology of body " +
                       std::to_string(body) + " were not recorded"};
  }
  const auto highest = *std::max_element(geometry.connectivity.begin(), geometry.connectivity.end());
  if (static_cast<std::size_t>(highest) < geometry.points) return {};
  return wire::Error{path + ": the topology names particle " + std::to_string(highest) + " of a world of " +
                     std::to_string(geometry.points)};
}

}  // namespace

wire::Result<Geometry> read_geometry(recording::Recording& recording, std::span<const std::uint64_t> ordinals,
                                     std::size_t points) {
  Geometry geometry;
  geometry.points = points;
  std::map<std::uint32_t, std::uint32_t> missing;  // chunks, by body
  for (const std::uint64_t ordinal : ordinals) {
    recording.seek(ordinal);
    const recording::RecordedMessage* message = recording.next();
    if (message == nullptr || message->topic != wire::TopicId::topology) continue;
    const auto decoded = wire::decode<flexcast_Topology>(message->bytes);
    if (!decoded) return wire::Error{recording.path() + ": a topology cannot be read: " + decoded.error().message};
    const flexcast_Topology& part = *decoded.value();
    --missing.try_emplace(part.body, part.chunks).first->second;
    add_cells(geometry, wire::elements(part.tetrahedra), 4, vtk_tetra, part.body);
    add_cells(geometry, wire::elements(part.springs), 2, vtk_line, part.body);
  }
  if (auto checked = check(recording.path(), geometry, missing); !checked) return checked.error();
  return geometry;
}

}  // namespace flexcast::exporting
