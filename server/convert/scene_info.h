// Scene and topology for the network.
#pragma once

#include <string_view>

#include "idl/wire/owned.h"
#include "server/convert/notice_types.h"

namespace flexcast::server {

// The run must have its scene.
wire::Owned<flexcast_SceneInfo> make_scene_info(const RunStarted& run, std::string_view world);

// How many samples a body's topology takes.
std::uint32_t count_topology_chunks(const Body& body);
// Shows the model's own arrays: valid as long as they are.
wire::Owned<flexcast_Topology> make_topology(const RunStarted& run, std::string_view world, std::size_t body,
                                             std::uint32_t chunk);

}  // namespace flexcast::server
