// The command line of flexcast-web.
#pragma once

#include <ostream>
#include <string>
#include <variant>
#include <vector>

#include "clients/web/net.h"

namespace flexcast::web {

struct Options {
  NetOptions net{};
  std::vector<std::string> origins{};  // of pages that may connect, besides one's own
  std::string world{};                 // "": the first one that shows
  int domain = 0;
  std::string profile{};   // "": see idl/wire/profile.h
  std::string security{};  // folder with an identity; "": none
};

// The options, or the code to end with at once: 0 after --help and --version, 2 on bad usage.
std::variant<Options, int> parse_options(int argc, const char* const* argv, std::ostream& out, std::ostream& err);

}  // namespace flexcast::web
