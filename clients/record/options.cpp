#include "clients/record/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <charconv>
#include <map>

#include "idl/wire/participant.h"

namespace flexcast::record {
namespace {

constexpr const char* example = R"(
Example:
  flexcast-record -o drop.mcap --world beam --duration 10

records the world 'beam' of domain 0 for ten seconds: every frame as it came off the wire, and beside them scene,
topology, parameters, events, commands and replies. Without --frames and --duration it records until it is interrupted
(Ctrl-C). Frames that are missing are counted and named at the end, and stored in the file.

  flexcast-record --recover drop.mcap

completes what a recorder that was killed has left.)";

// Schemas and indexes take some hundred kilobytes in every file.
constexpr std::uint64_t smallest_part = 1'000'000;

// Of a positive number of seconds; the bound keeps it countable in nanoseconds.
std::string check_seconds(const std::string& text) {
  constexpr double longest = 1e9;
  double seconds = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seconds);
  const bool is_number = error == std::errc() && end == text.data() + text.size();
  return is_number && seconds > 0 && seconds <= longest ? "" : "'" + text + "' is not a number of seconds above 0";
}

std::string check_id(const std::string& text) {
  const auto allowed = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-'; };
  const bool fits = !text.empty() && text.size() <= 64 && std::all_of(text.begin(), text.end(), allowed);
  return fits ? "" : "'" + text + "' is not 1 to 64 of A-Z, a-z, 0-9, _ and -";
}

template <class T>
void assign(std::optional<T>& option, const CLI::Option* given, const T& value) {
  if (given->count() > 0) option = value;
}

}  // namespace

std::variant<Options, int> parse_options(int argc, const char* const* argv) {
  Options options;
  std::uint64_t frames = 0;
  double duration = 0;
  std::string compression = "lz4";
  const std::map<std::string, mcap::Compression> compressions{
      {"lz4", mcap::Compression::kLz4}, {"zstd", mcap::Compression::kZstd}, {"none", mcap::Compression::kNone}};

  CLI::App app("Records a world to an MCAP file.", "flexcast-record");
  app.footer(example);
  auto* output = app.add_option("-o,--output", options.file, "RUN.mcap, the file to write");
  app.add_option("--world", options.world, "name of the world; may be left out if there is only one on the domain");
  app.add_option("--domain", options.domain, "DDS domain; default 0")->check(CLI::Range(0, wire::maximum_domain));
  app.add_option("--profile", options.profile, "loopback (default), lan, or a Cyclone DDS configuration PATH.xml");
  app.add_option("--security", options.security, "folder with an identity; without it everything is in the open");
  auto* frames_given = app.add_option("--frames", frames, "stop after so many frames")->check(CLI::PositiveNumber);
  auto* duration_given = app.add_option("--duration", duration, "stop so many seconds after the first frame")
                             ->check(check_seconds)
                             ->excludes(frames_given);
  app.add_option("--compression", compression, "lz4 (default), zstd or none")
      ->check(CLI::IsMember({"lz4", "zstd", "none"}));
  app.add_option("--wait", options.wait, "seconds to wait for a server; default 10")->check(check_seconds);
  app.add_option("--id", options.id, "name for remote control; default: one of its own")->check(check_id);
  app.add_flag("--paused", options.paused, "record no frames until a RECORDER_START comes");
  std::uint64_t split_size = 0;
  auto* split_given =
      app.add_option("--split-size", split_size, "RUN-0000.mcap, RUN-0001.mcap, ... of such a size: 64MB")
          ->transform(CLI::AsSizeValue(true))
          ->check(CLI::Range(smallest_part, std::uint64_t{1} << 62));
  double keep_last = 0;
  auto* keep_given = app.add_option("--keep-last", keep_last, "keep only the frames of the last so many seconds")
                         ->check(check_seconds)
                         ->excludes(split_given);
  std::string recovered;
  app.add_option("--recover", recovered, "complete RUN.mcap, which a killed recorder has left; records nothing")
      ->excludes(output);
  app.add_flag("--force", options.force, "replace the file if it exists");
  app.add_flag("--json", options.json, "print the summary as JSON");
  app.set_version_flag("--version", std::string("flexcast-record ") + FLEXCAST_VERSION);
  try {
    app.parse(argc, argv);
    if (recovered.empty() && options.file.empty()) throw CLI::RequiredError("--output");
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  assign(options.frames, frames_given, frames);
  assign(options.duration, duration_given, duration);
  assign(options.split_size, split_given, split_size);
  assign(options.keep_last, keep_given, keep_last);
  options.recover = !recovered.empty();
  if (options.recover) options.file = recovered;
  options.compression = compressions.at(compression);
  return options;
}

}  // namespace flexcast::record
