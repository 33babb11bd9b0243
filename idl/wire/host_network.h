// What this machine's network gives to DDS: interfaces, and the buffers that sockets get.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "idl/wire/result.h"

namespace flexcast::wire {

struct NetworkInterface {
  std::string name;     // "eth0"
  std::string address;  // IPv4
  bool loopback = false;
  bool multicast = false;
};

// Those that are up and have an IPv4 address.
std::vector<NetworkInterface> find_interfaces();

// Bytes that a socket gets which asks for so many; 0: sockets cannot be made.
std::size_t grant_receive_buffer(std::size_t asked);

}  // namespace flexcast::wire
