#include "server/options.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>

#include "idl/wire/participant.h"
#include "server/name.h"

namespace flexcast::server {
namespace {

constexpr const char* example = R"(
Example:
  flexcast-server server/scenes/rope.toml --rate realtime --until 10 --set rope.damping=0.2

runs the scene for ten simulated seconds, streams it as a world named after the scene on domain 0, and stays there,
finished, for commands (flexcast-ctl reset, flexcast-ctl status) until it is interrupted.)";

constexpr int most_recorders = 50;  // a domain has not many more processes

std::optional<double> parse_number(const std::string& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

double parse_rate(const std::string& text) {
  if (text == "realtime") return 1.0;
  if (text == "max") return 0.0;
  const auto rate = parse_number(text);
  if (!rate || *rate <= 0.0) {
    throw CLI::ValidationError("--rate", "'" + text + "' is not realtime, max or a number above 0");
  }
  return *rate;
}

double parse_until(const std::string& text) {
  const auto until = parse_number(text);
  if (!until || *until < 0.0)
    throw CLI::ValidationError("--until", "'" + text + "' is not a time in seconds from 0 on");
  return *until;
}

// The parser says "true" when there was no number.
int parse_lockstep(const std::string& text) {
  if (text == "true") return 0;
  const auto recorders = parse_number(text);
  if (!recorders || *recorders != std::floor(*recorders) || *recorders < 0.0 || *recorders > most_recorders) {
    throw CLI::ValidationError(
        "--lockstep", "'" + text + "' is not a number of recorders from 0 to " + std::to_string(most_recorders));
  }
  return static_cast<int>(*recorders);
}

std::string check_world(const std::string& name) {
  const auto checked = check_name(name);
  return checked ? "" : checked.error().message;
}

std::string check_override(const std::string& text) {
  const auto equals = text.find('=');
  return equals == std::string::npos || equals == 0 ? "'" + text + "' is not of the form PATH=VALUE" : "";
}

}  // namespace

std::variant<Options, int> parse_options(int argc, const char* const* argv) {
  Options options;
  std::string rate = "realtime";
  std::string until;
  std::string lockstep;
  CLI::App app("Runs the soft bodies of a scene and streams every particle over DDS.", "flexcast-server");
  app.footer(example);
  app.add_option("SCENE", options.scene, "scene file (TOML)")->required();
  app.add_option("--world", options.world, "name on the network; default: the scene's name")->check(check_world);
  app.add_option("--domain", options.domain, "DDS domain; default 0")->check(CLI::Range(0, wire::maximum_domain));
  app.add_option("--profile", options.profile, "loopback (default), lan, or a Cyclone DDS configuration PATH.xml");
  app.add_option("--security", options.security, "folder with an identity; without it everything is in the open");
  app.add_option("--rate", rate, "realtime (default), max, or simulated seconds per wall second");
  app.add_flag("--paused", options.paused, "wait at step 0 for a command");
  app.add_option("--until", until, "simulated seconds after which the world is finished; the server stays");
  app.add_flag("--exit", options.exit, "end when --until is reached");
  app.add_option("--checkpoints", options.checkpoints,
                 "folder for checkpoints, made when needed; default: checkpoints; each is DIR/WORLD/NAME.checkpoint");
  app.add_flag("--lockstep", lockstep,
               "wait for the recorders that ask for it, so that they get every frame; "
               "--lockstep=N: begin when N of them have the first");
  app.add_option("--threads", options.threads, "threads of the engine; any number gives the same bits; default 1")
      ->check(CLI::Range(1, 1024));
  app.add_option("--set", options.overrides, "PATH=VALUE over what the scene file says; may be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->check(check_override);
  app.set_version_flag("--version", std::string("flexcast-server ") + FLEXCAST_VERSION);
  try {
    app.parse(argc, argv);
    options.rate = parse_rate(rate);
    if (!until.empty()) options.until = parse_until(until);
    if (!lockstep.empty()) options.lockstep = parse_lockstep(lockstep);
    if (options.exit && !options.until) throw CLI::ValidationError("--exit", "needs --until");
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  return options;
}

}  // namespace flexcast::server
