#include "clients/ctl/checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

namespace flexcast::ctl {
namespace {

constexpr std::size_t most_participants = 51;  // of one host on a domain in the loopback profile

template <class Range, class Text>
std::string join_texts(const Range& range, Text text) {
  std::string all;
  for (const auto& one : range) all += (all.empty() ? "" : ", ") + text(one);
  return all;
}

bool contains(const std::vector<wire::Guid>& guids, const wire::Guid& guid) {
  return std::find(guids.begin(), guids.end(), guid) != guids.end();
}

// ---------------------------------------------------------------- this machine

Diagnosis examine_environment(const Findings& f) {
  if (!f.environment) return {Level::ok, "CYCLONEDDS_URI is not set", ""};
  if (f.profile_given) return {Level::ok, "CYCLONEDDS_URI is set, and --profile overrides it", ""};
  return {Level::warn, "CYCLONEDDS_URI is set and takes the place of the profile loopback: " + *f.environment,
          "unset CYCLONEDDS_URI or give --profile, the same for all programs"};
}

Diagnosis examine_join(const Findings& f) {
  if (!f.join_error) return {Level::ok, fmt::format("domain {} joined with profile {}", f.domain, f.profile), ""};
  return {Level::fail, *f.join_error,
          "another process may hold its ports, or the interface is missing: try another --domain or --profile"};
}

Diagnosis examine_interfaces(const Findings& f) {
  const auto describe = [](const wire::NetworkInterface& one) { return one.name + " " + one.address; };
  if (f.profile != "lan") return {Level::ok, "profile " + f.profile + " needs no multicast", ""};
  std::vector<wire::NetworkInterface> usable;
  std::copy_if(f.interfaces.begin(), f.interfaces.end(), std::back_inserter(usable),
               [](const auto& one) { return one.multicast && !one.loopback; });
  if (usable.empty()) {
    return {Level::fail, "no interface that is up carries multicast, which profile lan needs to find others",
            "connect the network (ip link set dev NAME up multicast on), or use --profile loopback on one machine"};
  }
  if (usable.size() == 1) return {Level::ok, "multicast over " + describe(usable[0]), ""};
  return {Level::warn, "several interfaces carry multicast, and one of them is taken: " + join_texts(usable, describe),
          "name the right one in a configuration of your own (NetworkInterface name=...) and use --profile PATH.xml"};
}

Diagnosis examine_buffer(const Findings& f) {
  const std::string granted = fmt::format("sockets get {} KiB of receive buffer of {} KiB asked for",
                                          f.granted_buffer / 1024, f.wanted_buffer / 1024);
  if (f.granted_buffer >= f.wanted_buffer) return {Level::ok, granted, ""};
  return {Level::warn, granted + ": large frames arrive more slowly",
          fmt::format("sudo sysctl -w net.core.rmem_max={}", f.wanted_buffer)};
}

// ---------------------------------------------------------------- the domain

Diagnosis examine_participants(const Findings& f) {
  const std::string count = fmt::format("participants on the domain beside this one: {}", f.participants.size());
  if (f.profile != "loopback" || f.participants.size() + 5 < most_participants) return {Level::ok, count, ""};
  return {Level::warn, fmt::format("{}, of {} that one machine takes", count, most_participants - 1),
          "end programs that are not needed, or use another --domain"};
}

// Statuses that this program cannot read, and participants that say nothing of ours.
Diagnosis examine_types(const Findings& f) {
  std::set<wire::Guid> strangers, ours;
  std::string type;
  for (const wire::RemoteWriter& writer : f.writers) {
    if (writer.topic.starts_with("flexcast/")) ours.insert(writer.participant);
    if (writer.topic != "flexcast/status" || contains(f.readable, writer.participant)) continue;
    strangers.insert(writer.participant);
    type = writer.type;
  }
  if (!strangers.empty()) {
    return {Level::fail,
            fmt::format("{} of the participants write flexcast/status as {} in a form that does not match ours",
                        strangers.size(), type),
            "they speak another version of the contract: build all programs from the same source"};
  }
  if (f.servers.empty() && !f.participants.empty() && ours.empty()) {
    return {Level::warn,
            fmt::format("{} participants are there and none writes a topic of flexcast", f.participants.size()),
            "the domain may belong to others: use the --domain of your server"};
  }
  return {Level::ok, "every topic of flexcast matches ours", ""};
}

Diagnosis examine_servers(const Findings& f) {
  const auto name = [](const FoundServer& server) { return server.world; };
  const bool found = std::any_of(f.servers.begin(), f.servers.end(),
                                 [&](const FoundServer& s) { return f.world.empty() || s.world == f.world; });
  if (found) {
    return {Level::ok,
            fmt::format("{} on domain {}: {}", f.servers.size() == 1 ? "one world" : "worlds", f.domain,
                        join_texts(f.servers, name)),
            ""};
  }
  const std::string wanted = f.world.empty() ? "no server" : "no server of world '" + f.world + "'";
  std::string finding =
      fmt::format("{} on domain {} with profile {} within {:.1f} s", wanted, f.domain, f.profile, f.waited);
  if (!f.elsewhere.empty()) {
    return {Level::fail,
            finding + ", but under profile " + f.elsewhere_profile + ": " +
                join_texts(f.elsewhere, [](const std::string& world) { return world; }),
            "use --profile " + f.elsewhere_profile};
  }
  if (!f.servers.empty()) {
    return {Level::fail, finding + "; there: " + join_texts(f.servers, name), "use one of these with --world"};
  }
  return {
      Level::fail, finding,
      fmt::format("start one (flexcast-server SCENE.toml --domain {}), or use its --domain and --profile", f.domain)};
}

Diagnosis examine_names(const Findings& f) {
  std::map<std::string, std::set<std::uint64_t>> servers;
  for (const FoundServer& server : f.servers) servers[server.world].insert(server.server_id);
  std::string doubled;
  for (const auto& [world, ids] : servers) {
    if (ids.size() > 1)
      doubled += fmt::format("{}{} servers call themselves '{}'", doubled.empty() ? "" : "; ", ids.size(), world);
  }
  if (doubled.empty()) return {Level::ok, "no name is used twice", ""};
  return {Level::fail, doubled, "end one of them, or start it with another --world"};
}

Diagnosis examine_versions(const Findings& f) {
  std::vector<FoundServer> others;
  std::copy_if(f.servers.begin(), f.servers.end(), std::back_inserter(others),
               [](const FoundServer& server) { return server.version != FLEXCAST_VERSION; });
  if (others.empty()) return {Level::ok, "all are of version " FLEXCAST_VERSION, ""};
  return {Level::warn,
          "this is version " FLEXCAST_VERSION ", and " +
              join_texts(others, [](const auto& s) { return "the server of '" + s.world + "' is " + s.version; }),
          "use programs of one version: others may have other parameters, and compute other bits"};
}

Diagnosis examine_pulse(const Findings& f) {
  std::vector<FoundServer> ill;
  std::copy_if(f.servers.begin(), f.servers.end(), std::back_inserter(ill), [](const FoundServer& server) {
    return server.health == Health::hung || server.health == Health::gone;
  });
  if (ill.empty()) return {Level::ok, f.servers.empty() ? "no server to ask" : "every step loop goes round", ""};
  const auto describe = [](const FoundServer& server) {
    return server.health == Health::gone
               ? fmt::format("'{}' went silent", server.world)
               : fmt::format("the step loop of '{}' stands still for {:.1f} s", server.world, server.still);
  };
  return {Level::fail, join_texts(ill, describe),
          "look at the server's log; a step that takes so long needs a coarser scene or a larger time.step"};
}

constexpr std::array table{
    Check{"environment", examine_environment},   Check{"domain", examine_join},
    Check{"interface", examine_interfaces},      Check{"receive buffer", examine_buffer},
    Check{"participants", examine_participants}, Check{"types", examine_types},
    Check{"servers", examine_servers},           Check{"names", examine_names},
    Check{"versions", examine_versions},         Check{"step loops", examine_pulse},
};

}  // namespace

std::string_view name_of(Level level) {
  return level == Level::ok ? "ok" : level == Level::warn ? "warn" : "fail";
}

std::span<const Check> check_table() {
  return table;
}

}  // namespace flexcast::ctl
