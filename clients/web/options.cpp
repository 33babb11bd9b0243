#include "clients/web/options.h"

#include <CLI/CLI.hpp>

#include "idl/wire/participant.h"

namespace flexcast::web {
namespace {

constexpr const char* footer = R"(
Example:
  flexcast-web --world cloth

serves the page at http://127.0.0.1:8080/. Foxglove connects to ws://localhost:8080 (connection "Foxglove WebSocket"):

  flexcast-web --allow-origin https://app.foxglove.dev

Whoever reaches the port can watch and, unless the identity may only watch, command. By default that is this machine.)";

}  // namespace

std::variant<Options, int> parse_options(int argc, const char* const* argv, std::ostream& out, std::ostream& err) {
  Options options;
  CLI::App app("Shows worlds in a browser, and to every client that speaks Foxglove's WebSocket protocol.",
               "flexcast-web");
  app.footer(footer);
  app.set_version_flag("--version", "flexcast-web " FLEXCAST_VERSION);
  app.add_option("--port", options.net.port, "TCP port; 0: a free one")->capture_default_str();
  app.add_option("--bind", options.net.bind, "Address to listen on, or a name for one")->capture_default_str();
  app.add_option("--allow-origin", options.origins, "Web pages that may connect, too: https://NAME; *: all; repeatable")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option("--world", options.world, "The world with the plain names (default: the first one that shows)");
  app.add_option("--domain", options.domain, "DDS domain")
      ->check(CLI::Range(0, wire::maximum_domain))
      ->capture_default_str();
  app.add_option("--profile", options.profile, "Network: loopback, lan or PATH.xml (default: loopback)");
  app.add_option("--security", options.security, "Folder with an identity (default: none, in the open)");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error, out, err) == 0 ? 0 : 2;
  }
  return options;
}

}  // namespace flexcast::web
