// The command line of flexcast-ctl.
#pragma once

#include <cstdint>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "clients/client/connection.h"

namespace flexcast::ctl {

enum class Verb {
  list,
  describe,
  get,
  set,
  reset,
  pause,
  resume,
  step,
  run_until,
  save,
  restore,
  load,
  grab,
  release,
  status,
  doctor
};

struct Options {
  client::ConnectOptions connect;
  bool json = false;
  Verb verb = Verb::list;
  std::vector<std::string> words;  // names of get, assignments of set, the name of load, save and restore
  bool keep_parameters = false;
  std::uint64_t count = 1;
  double time = 0;
  std::uint32_t particle = 0;  // grab, release
  client::Vector target{};     // grab
  double stiffness = 0;        // grab
  bool watch = false;
  std::optional<std::uint64_t> if_revision;  // set: refuse unless this parameter revision is in force
};

// What to do, or the exit code when help, the version or an explanation of bad usage (code 2) has been printed.
struct Parsed {
  std::optional<Options> options;
  int exit_code = 0;
};

Parsed parse(int argc, const char* const* argv, std::ostream& out, std::ostream& err);

}  // namespace flexcast::ctl
