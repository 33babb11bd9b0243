#include "clients/replay/options.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <string_view>

#include "idl/wire/participant.h"

namespace flexcast::replay {
namespace {

constexpr const char* example = R"(
Example:
  flexcast-replay drop.mcap --rate 0.5 --from 1.2 --to 2 --loop

shows what happened between 1.2 s and 2 s at half speed, again and again, to every program that reads the world. It takes
the commands pause, resume, step, run-until, reset, status, describe, get and set of flexcast-ctl; its parameters are
replay.rate, replay.time (set it to seek) and replay.loop. Without --exit it stays at its end until it is interrupted.)";

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

std::optional<double> parse_time(const char* option, const std::string& text) {
  if (text.empty()) return std::nullopt;
  const auto time = parse_number(text);
  if (!time || *time < 0.0) throw CLI::ValidationError(option, "'" + text + "' is not a time in seconds from 0 on");
  return time;
}

std::string check_name(const std::string& name) {
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-";
  const bool good = !name.empty() && name.size() <= 64 && name.find_first_not_of(letters) == std::string::npos;
  return good ? "" : "'" + name + "' is not a name: 1 to 64 of A-Z, a-z, 0-9, _ and -";
}

void check_together(const Options& options) {
  if (options.from && options.to && *options.from > *options.to) {
    throw CLI::ValidationError("--from", "lies after --to");
  }
  if (options.loop && options.exit)
    throw CLI::ValidationError("--exit", "makes no sense with --loop, which never ends");
}

}  // namespace

std::variant<Options, int> parse_options(int argc, const char* const* argv) {
  Options options;
  std::string rate = "realtime", from, to;
  CLI::App app("Publishes a recording again, so that every watcher sees the world as it was.", "flexcast-replay");
  app.footer(example);
  app.add_option("RUN", options.file, "recording (MCAP)")->required();
  app.add_option("--rate", rate, "realtime (default), max, or simulated seconds per wall second");
  app.add_option("--from", from, "begin each run at this simulated time, s");
  app.add_option("--to", to, "end each run at this simulated time, s");
  app.add_flag("--loop", options.loop, "begin again at the end, as a new run");
  app.add_flag("--paused", options.paused, "wait at the first frame for a command");
  app.add_option("--as,--world", options.world, "name on the network; default: as recorded")->check(check_name);
  app.add_option("--domain", options.domain, "DDS domain; default 0")->check(CLI::Range(0, wire::maximum_domain));
  app.add_option("--profile", options.profile, "loopback (default), lan, or a Cyclone DDS configuration PATH.xml");
  app.add_option("--security", options.security, "folder with the identity to join the domain with");
  app.add_flag("--exit", options.exit, "end when the recording does");
  app.set_version_flag("--version", std::string("flexcast-replay ") + FLEXCAST_VERSION);
  try {
    app.parse(argc, argv);
    options.rate = parse_rate(rate);
    options.from = parse_time("--from", from);
    options.to = parse_time("--to", to);
    check_together(options);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  return options;
}

}  // namespace flexcast::replay
