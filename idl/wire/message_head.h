// Where serialised samples carry the name of their world: found in place, without decoding the sample.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "idl/wire/topics.h"

namespace flexcast::wire {

// The world a sample belongs to, as a view into `bytes` (CDR with its 4-byte header). None if the bytes end too early
// or are not XCDR1.
std::optional<std::string_view> peek_world(TopicId topic, std::span<const std::byte> bytes);

}  // namespace flexcast::wire
