#include "clients/ctl/examination.h"

#include <algorithm>
#include <cstdlib>

#include "clients/ctl/status.h"
#include "idl/wire/profile.h"
#include "idl/wire/world_watch.h"

namespace flexcast::ctl {
namespace {

using namespace std::chrono_literals;
using Clock = HealthJudge::Clock;

// Servers by their process, so that two of one name are two.
using Judges = std::map<wire::Guid, HealthJudge>;

void listen(wire::StatusWatch& watch, Judges& judges, std::chrono::nanoseconds wait) {
  const auto end = Clock::now() + wait;
  for (auto now = Clock::now(); now < end; now = Clock::now()) {
    (void)watch.wait(std::min<std::chrono::nanoseconds>(100ms, end - now));
    for (const wire::StatusNews& news : watch.take()) {
      if (news.kind == wire::StatusNews::Kind::status) judges[news.participant].see(news);
      if (news.kind != wire::StatusNews::Kind::goodbye) continue;
      std::erase_if(judges, [&](const auto& one) { return news.world == one.second.status()->world; });
    }
  }
}

std::vector<FoundServer> find_servers(const Judges& judges) {
  std::vector<FoundServer> servers;
  const auto now = Clock::now();
  for (const auto& [participant, judge] : judges) {
    const flexcast_Status& status = *judge.status();
    servers.push_back({status.world, status.server_id, status.version, participant, judge.judge(now), judge.still()});
  }
  std::sort(servers.begin(), servers.end(), [](const auto& a, const auto& b) { return a.world < b.world; });
  return servers;
}

void visit_domain(const Options& options, Findings& findings) {
  const auto participant = join(options);
  if (!participant) {
    findings.join_error = participant.error().message;
    return;
  }
  findings.profile = participant.value().profile();
  auto watch = wire::StatusWatch::create(participant.value());
  const auto census = wire::DomainCensus::create(participant.value());
  if (!watch || !census) {
    findings.join_error = watch ? census.error().message : watch.error().message;
    return;
  }
  Judges judges;
  listen(watch.value(), judges, options.connect.wait);
  findings.servers = find_servers(judges);
  findings.participants = census.value().participants();
  findings.writers = census.value().writers();
  findings.readable = watch.value().servers();
}

// One process has one profile a domain at a time, so this comes after the visit.
void look_elsewhere(const Options& options, Findings& findings) {
  const std::string other = findings.profile == "loopback" ? "lan" : "loopback";
  const auto participant = wire::Participant::create({options.connect.domain, other, options.connect.security});
  if (!participant) return;
  auto watch = wire::WorldWatch::create(participant.value());
  if (!watch) return;
  watch.value().discover(std::min<std::chrono::nanoseconds>(options.connect.wait, 1500ms));
  findings.elsewhere_profile = other;
  for (const wire::World* world : watch.value().worlds()) findings.elsewhere.emplace_back(wire::world_name(*world));
}

}  // namespace

Findings examine(const Options& options) {
  Findings findings;
  findings.world = options.connect.world;
  findings.domain = options.connect.domain;
  findings.profile_given = !options.connect.profile.empty();
  findings.profile = findings.profile_given ? options.connect.profile : "loopback";
  findings.waited = std::chrono::duration<double>(options.connect.wait).count();
  if (const char* uri = std::getenv("CYCLONEDDS_URI"); uri != nullptr && *uri != '\0') findings.environment = uri;
  findings.interfaces = wire::find_interfaces();
  findings.wanted_buffer = wire::wanted_receive_buffer;
  findings.granted_buffer = wire::grant_receive_buffer(findings.wanted_buffer);
  visit_domain(options, findings);
  if (findings.servers.empty() && !findings.join_error) look_elsewhere(options, findings);
  return findings;
}

}  // namespace flexcast::ctl
