// The command line of flexcast-record.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "clients/mcap/compression.h"

namespace flexcast::record {

struct Options {
  std::string file;
  std::string world;  // "": the only one on the domain
  int domain = 0;
  std::string profile;                  // "": see idl/wire/profile.h
  std::string security{};               // folder with an identity; "": none
  std::optional<std::uint64_t> frames;  // stop after so many
  std::optional<double> duration;       // s, by the clock on the wall, from the first frame
  mcap::Compression compression = mcap::Compression::kLz4;
  double wait = 10;    // s, for the server
  bool force = false;  // replace the file if it exists
  bool json = false;
  std::string id{};                           // recorder_id; "": one of its own
  bool paused = false;                        // until RECORDER_START comes
  std::optional<std::uint64_t> split_size{};  // bytes: several files of at most this size
  std::optional<double> keep_last{};          // s: only the newest frames and statuses
  bool recover = false;                       // complete `file`, record nothing
};

// The options, or the code to end with at once: 0 after --help and --version (printed on stdout), 2 on bad usage
// (explained on stderr).
std::variant<Options, int> parse_options(int argc, const char* const* argv);

}  // namespace flexcast::record
