// What recorded events say, for those who execute them again.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "server/convert/notice_types.h"

namespace flexcast::verify {

// "event 12 (set gravity = [0, 0, -3])"
std::string describe(const server::Event& event);

// The integer of that name among the event's values.
std::optional<std::int64_t> find_integer(const server::Event& event, std::string_view name);

// A step could not be taken.
bool is_failure(const server::Event& event);

// The step that the world was at when it happened, and not the one that a restored checkpoint moved it to. None: the
// event does not say it.
std::optional<std::int64_t> find_place(const server::Event& event);

}  // namespace flexcast::verify
