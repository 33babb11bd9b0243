// VTK's XML files: one unstructured grid a frame (.vtu, raw appended data), and the list of them with their times
// (.pvd).
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "clients/client/frame.h"
#include "clients/export/geometry.h"

namespace flexcast::exporting {

struct PointFields {
  bool velocities = false;
  bool stretch = false;
  bool stress = false;
  bool doubles = false;  // positions and velocities as Float64, else as Float32
};

// The whole content of a .vtu file. The frame must have a position for every point of the geometry; fields that it does
// not have are left out. Arrays: points; velocity, stretch, stress of points; body of cells; TimeValue.
std::string make_vtu(const client::Frame& frame, const Geometry& geometry, const PointFields& fields);

// The whole content of a .pvd file: times in s, and files relative to it.
std::string make_pvd(const std::vector<std::pair<double, std::string>>& files);

}  // namespace flexcast::exporting
