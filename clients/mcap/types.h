// The words every file of this folder uses.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>

namespace flexcast::mcap {

using Bytes = std::span<const std::byte>;

// Nanoseconds since the Unix epoch.
using Time = std::uint64_t;

// 1 and up; a channel with schema 0 has no schema.
using SchemaId = std::uint16_t;
using ChannelId = std::uint16_t;

// Metadata as the writer takes it; sorted, so that the same input gives the same file.
using TextPairs = std::map<std::string, std::string>;

}  // namespace flexcast::mcap
