// Enumerators of the contract as people read them: "running", "applied", "run_until".
#pragma once

#include <string_view>

#include "idl/wire/types.h"

namespace flexcast::wire {

// An unknown number (of a newer program) gives "unknown".
std::string_view name_of(flexcast_ValueKind kind);
std::string_view name_of(flexcast_WorldState state);
std::string_view name_of(flexcast_CommandKind kind);
std::string_view name_of(flexcast_ReplyOutcome outcome);
std::string_view name_of(flexcast_EventKind kind);
std::string_view name_of(flexcast_RecorderState state);
std::string_view name_of(flexcast_RecorderCommandKind kind);

}  // namespace flexcast::wire
