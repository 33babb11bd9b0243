// Scene and topology for the network.
#pragma once

#include "idl/wire/owned.h"
#include "server/convert/notice_types.h"
#include "server/convert/scene_facts.h"

namespace flexcast::server {

wire::Owned<flexcast_SceneInfo> make_scene_info(const SceneFacts& facts, const RunStarted& run);

// How many samples a body's topology takes.
std::uint32_t count_topology_chunks(const SceneFacts& facts, std::size_t body);
// Shows the model's own arrays: valid as long as they are.
wire::Owned<flexcast_Topology> make_topology(const SceneFacts& facts, const RunStarted& run, std::size_t body,
                                             std::uint32_t chunk);

}  // namespace flexcast::server
