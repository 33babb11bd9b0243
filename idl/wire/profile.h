// Domain profiles: how DDS uses the network, by name.
//
//   loopback   127.0.0.1 only, no multicast: programs on one machine (the default)
//   lan        the machine's default interface, discovery by multicast
//   PATH.xml   a Cyclone DDS configuration of one's own
//
// Both built-in profiles carry the fragment and buffer settings that large frames need; Cyclone's own default is up to
// eighty times slower on them. A CYCLONEDDS_URI in the environment replaces the default profile; a profile that was
// asked for replaces the environment.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "idl/wire/result.h"

namespace flexcast::wire {

struct Profile {
  std::string name;    // as asked for; "loopback" or "environment" when nothing was
  std::string config;  // XML for Cyclone (or what CYCLONEDDS_URI holds)
};

// Bytes of receive buffer that sockets of the built-in profiles ask for; the kernel may grant less.
inline constexpr std::size_t wanted_receive_buffer = std::size_t{4} << 20;

// "" asks for the default: the environment if CYCLONEDDS_URI is set, else loopback.
Result<Profile> resolve_profile(const std::string& asked_for);

// The names of the built-in profiles, for help texts.
std::vector<std::string_view> builtin_profiles();

}  // namespace flexcast::wire
