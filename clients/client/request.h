// One command to a world, before the connection gives it its addresses and number.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "clients/client/value.h"

namespace flexcast::client {

// Only the fields that the kind names are looked at: see CommandKind in flexcast.idl.
struct Request {
  flexcast_CommandKind kind = flexcast_COMMAND_STATUS;
  std::vector<Parameter> values{};                   // set: all or nothing
  std::vector<std::string> names{};                  // get: empty means all
  std::optional<std::uint64_t> expected_revision{};  // refuse unless this parameter revision is in force
  bool keep_parameters = false;                      // reset
  std::uint64_t count = 1;                           // step
  double time = 0;                                   // run_until: s
  std::string name{};                                // load, save, restore
  std::uint32_t particle = 0;                        // grab, release
  std::array<double, 3> target{};                    // grab: m
  double stiffness = 0;                              // grab: N/m; 0: chosen by the server
};

// Fills a zeroed struct; world, client_id and request_id are the connection's.
void to_wire(flexcast_Command& command, const Request& request);

}  // namespace flexcast::client
