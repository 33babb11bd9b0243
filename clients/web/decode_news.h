// The few samples whose content matters to the bridge itself, decoded.
#pragma once

#include <optional>

#include "clients/web/news.h"

namespace flexcast::web {

// Of a sample of scene, topology or parameters; none if it cannot be decoded.
std::optional<StateNews> decode_state(wire::TopicId topic, Sample sample);

// The frame as a point cloud; none if it cannot be decoded.
std::optional<Sample> make_points(const WholeFrame& frame);

}  // namespace flexcast::web
