// The command line of flexcast-export.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace flexcast::exporting {

struct Options {
  std::string file{};
  std::string vtk{};                 // folder; "": no VTK files
  std::string csv{};                 // file; "": no CSV. One of the two is given.
  std::optional<std::size_t> run{};  // 1, 2, ... in the order of the recording; none: the last
  std::optional<double> from{};      // s, simulated
  std::optional<double> to{};
  std::uint64_t every = 1;            // every n-th frame of those
  std::vector<std::string> fields{};  // beside the positions; empty: all that were streamed
  bool force = false;                 // replace files that exist
  bool json = false;
};

// The options, or the code to end with at once: 0 after --help and --version (printed on stdout), 2 on bad usage
// (explained on stderr).
std::variant<Options, int> parse_options(int argc, const char* const* argv);

}  // namespace flexcast::exporting
