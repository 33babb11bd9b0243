// The command line of flexcast-replay.
#pragma once

#include <optional>
#include <string>
#include <variant>

namespace flexcast::replay {

struct Options {
  std::string file{};
  std::string world{};  // "": as recorded
  int domain = 0;
  std::string profile{};         // "": see idl/wire/profile.h
  std::string security{};        // folder with an identity; "": none
  double rate = 1.0;             // simulated seconds per wall second; 0: as fast as possible
  std::optional<double> from{};  // s, simulated, of each run
  std::optional<double> to{};
  bool loop = false;
  bool paused = false;
  bool exit = false;  // end when the recording does
};

// The options, or the code to end with at once: 0 after --help and --version (printed on stdout), 2 on bad usage
// (explained on stderr).
std::variant<Options, int> parse_options(int argc, const char* const* argv);

}  // namespace flexcast::replay
