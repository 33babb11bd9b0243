// The command line of flexcast-server.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace flexcast::server {

struct Options {
  std::string scene;  // path of the scene file
  std::string world;  // "": the scene's name
  int domain = 0;
  std::string profile;   // "": see idl/wire/profile.h
  std::string security;  // folder with an identity, "": none
  double rate = 1.0;     // simulated seconds per wall second; 0: as fast as possible
  bool paused = false;
  std::optional<double> until;              // s
  bool exit = false;                        // end when `until` is reached
  std::string checkpoints = "checkpoints";  // folder of all worlds' checkpoints
  std::optional<int> lockstep;              // wait for recorders; for so many of them before the first step
  int threads = 1;                          // of the engine; any number gives the same bits
  std::vector<std::string> overrides;
};

// The options, or the code to end with at once: 0 after --help and --version (printed on stdout), 2 on bad usage
// (explained on stderr).
std::variant<Options, int> parse_options(int argc, const char* const* argv);

}  // namespace flexcast::server
