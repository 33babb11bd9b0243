// The command line of flexcast-verify.
#pragma once

#include <cstdint>
#include <optional>
#include <ostream>
#include <string>
#include <variant>

namespace flexcast::verify {

struct Options {
  std::string file;
  int threads = 1;
  std::optional<std::uint64_t> run;  // its number from 1 on, or its run_id; none: all
  bool json = false;
};

// The options, or the exit code where there is nothing to do but to end.
std::variant<Options, int> parse_options(int argc, const char* const* argv, std::ostream& out, std::ostream& err);

}  // namespace flexcast::verify
