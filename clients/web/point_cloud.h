// A frame as a foxglove::PointCloud, which Foxglove's 3D panel shows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "clients/client/frame.h"

namespace flexcast::web {

inline constexpr std::string_view point_cloud_schema_name = "foxglove::PointCloud";
std::string_view point_cloud_idl();

// CDR with its 4-byte header: a point each particle with x, y, z in metres and, if the frame has them, speed, stretch
// and stress, all float32, in the coordinate frame "world". `time` in ns since 1970.
std::vector<std::byte> make_point_cloud(const client::Frame& frame, std::int64_t time);

}  // namespace flexcast::web
