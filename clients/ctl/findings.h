// What the doctor has found out, before anything is judged. Tests make their own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "clients/ctl/health.h"
#include "idl/wire/domain_census.h"
#include "idl/wire/host_network.h"

namespace flexcast::ctl {

// One server, by its statuses.
struct FoundServer {
  std::string world;
  std::uint64_t server_id = 0;
  std::string version;
  wire::Guid participant{};
  Health health = Health::ok;
  double still = 0.0;  // s, for which its heartbeat stood still
};

struct Findings {
  // What was asked for.
  std::string world;  // "": any
  int domain = 0;
  std::string profile;  // in force: loopback, lan, environment, PATH.xml
  bool profile_given = false;
  double waited = 0.0;  // s

  // The machine.
  std::optional<std::string> environment;  // CYCLONEDDS_URI
  std::vector<wire::NetworkInterface> interfaces;
  std::size_t wanted_buffer = 0;   // bytes
  std::size_t granted_buffer = 0;  // bytes

  // The domain.
  std::optional<std::string> join_error;
  std::vector<FoundServer> servers;
  std::vector<wire::Guid> participants;     // others than this program
  std::vector<wire::RemoteWriter> writers;  // of any topic
  std::vector<wire::Guid> readable;         // participants whose statuses this program can read
  std::vector<std::string> elsewhere;       // worlds on this domain under the other built-in profile, and its name
  std::string elsewhere_profile;
};

}  // namespace flexcast::ctl
