// From the bytes of a record to its fields.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "clients/mcap/records.h"

namespace flexcast::mcap {

// The record, with views of `body`; nothing if the body is too short for its fields or a list in it is malformed.
// Bytes after the last field are passed over, as the format wants it.
std::optional<Record> parse_record(std::uint8_t opcode, Bytes body);

// For messages: "Chunk record", "record of type 200".
std::string record_name(std::uint8_t opcode);

}  // namespace flexcast::mcap
