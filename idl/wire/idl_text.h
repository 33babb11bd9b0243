// The text of flexcast.idl, as built into this program: the schema of recordings.
#pragma once

#include <string_view>

namespace flexcast::wire {

std::string_view idl_text();

}  // namespace flexcast::wire
