// Geometry: the cells of a world, in VTK's terms: tetrahedra and springs.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "clients/recording/recording.h"

namespace flexcast::exporting {

struct Geometry {
  std::size_t points = 0;
  std::vector<std::int64_t> connectivity;  // points of one cell after the other
  std::vector<std::int64_t> offsets;       // of each cell: where its points end
  std::vector<std::uint8_t> types;         // VTK's: line 3, tetrahedron 10
  std::vector<std::uint32_t> bodies;       // of each cell: index in SceneInfo.bodies
};

// From the recorded parts of a topology, named by their ordinals; other messages among them are passed over. An error
// if a part is missing, or names a particle beyond `points`.
wire::Result<Geometry> read_geometry(recording::Recording& recording, std::span<const std::uint64_t> ordinals,
                                     std::size_t points);

}  // namespace flexcast::exporting
