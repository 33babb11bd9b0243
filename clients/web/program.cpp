#include "clients/web/program.h"

#include <cstdio>

#include "clients/web/assets.h"
#include "clients/web/dds_commands.h"
#include "clients/web/feed.h"
#include "clients/web/hub.h"
#include "clients/web/site.h"

namespace flexcast::web {
namespace {

int fail(const std::string& error) {
  std::fprintf(stderr, "flexcast-web: %s\n", error.c_str());
  return 1;
}

// What a browser on this machine opens.
std::string address_of(const std::string& bind, std::uint16_t port) {
  const bool is_any = bind == "0.0.0.0" || bind == "::";
  const bool is_v6 = bind.find(':') != std::string::npos;
  const std::string host = is_any ? "127.0.0.1" : is_v6 ? "[" + bind + "]" : bind;
  return "http://" + host + ":" + std::to_string(port) + "/";
}

std::string describe(const wire::Participant& participant) {
  return "domain " + std::to_string(participant.domain()) + " (profile " + participant.profile() + ")";
}

}  // namespace

int run_program(const Options& options) {
  auto participant =
      wire::Participant::create({.domain = options.domain, .profile = options.profile, .security = options.security});
  if (!participant) return fail(participant.error().message);

  Net* net_to_wake = nullptr;  // set before the feed starts
  auto feed = Feed::create(participant.value(), make_client_id(), [&] { net_to_wake->wake(); });
  if (!feed) return fail(feed.error().message);
  DdsCommands commands(participant.value(), feed.value()->client_id(), feed.value()->replies());
  if (!commands.may_command() && options.security.empty()) return fail(commands.error());

  const std::string place = describe(participant.value());
  Hub hub({.world = options.world, .place = place, .session = commands.client_id()}, commands,
          [&](const Wanted& wanted) { feed.value()->want(wanted); });
  const Site site(Gate(options.net.bind, options.origins), assets(), [&] { return hub.is_full(); });
  auto net = Net::listen(options.net, {.respond = [&](const HttpRequest& request) { return site.answer(request); },
                                       .connect = [&](Line& line) { return hub.connect(line); },
                                       .woken = [&] { hub.take(feed.value()->take()); },
                                       .tick = [&] { hub.tick(); }});
  if (!net) return fail(net.error().message);
  net_to_wake = net.value().get();
  feed.value()->start();

  std::fprintf(stderr, "flexcast-web: looking for %s on %s\n",
               options.world.empty() ? "worlds" : ("world '" + options.world + "'").c_str(), place.c_str());
  if (!commands.may_command()) std::fprintf(stderr, "flexcast-web: this identity may only watch\n");
  std::printf("ready: %s\n", address_of(options.net.bind, net.value()->port()).c_str());
  std::fflush(stdout);
  net.value()->run();
  feed.value()->stop();  // before the network: it wakes it
  return 0;
}

}  // namespace flexcast::web
