// Frames of a recording, whole and in double precision.
#pragma once

#include <optional>

#include "clients/client/frame.h"
#include "clients/recording/index.h"
#include "idl/wire/owned.h"

namespace flexcast::exporting {

// None if the frame cannot be put together: a chunk of it is missing or cannot be read, or it claims to be larger than
// the recording's frames are.
std::optional<client::Frame> read_frame(recording::Recording& recording, const recording::Index& index,
                                        const recording::FrameEntry& entry);

// The recorded head of the frame; an error if it cannot be read.
wire::Result<wire::FrameHead> read_head(recording::Recording& recording, const recording::FrameEntry& entry);

// The scene in force at a frame; an error if none was recorded.
wire::Result<wire::Owned<flexcast_SceneInfo>> read_scene(recording::Recording& recording, const recording::Index& index,
                                                         const recording::FrameEntry& entry);

}  // namespace flexcast::exporting
