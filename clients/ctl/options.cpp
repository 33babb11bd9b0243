#include "clients/ctl/options.h"

#include <CLI/CLI.hpp>

namespace flexcast::ctl {
namespace {

constexpr const char* footer = R"(Examples:
  flexcast-ctl list
  flexcast-ctl --world cantilever set beam.young=2e6 'gravity=[0, 0, -3]'
  flexcast-ctl set --if-revision 3 gravity='[0, 0, 0]'
  flexcast-ctl step 100 --json
  flexcast-ctl save before-the-fall
  flexcast-ctl restore before-the-fall
  flexcast-ctl grab 120 0.5 0 -0.2 --stiffness 40
  flexcast-ctl release 120
  flexcast-ctl status --watch
  flexcast-ctl doctor --profile lan

Values are written as in TOML; texts need no quotes. Results go to stdout, messages to stderr.
Exit code: 0 done, 1 the operation failed, 2 bad usage.)";

CLI::App* add_verb(CLI::App& app, Options& options, Verb verb, const char* name, const char* description) {
  CLI::App* command = app.add_subcommand(name, description);
  command->fallthrough();  // options may follow the verb
  command->callback([&options, verb] { options.verb = verb; });
  return command;
}

void add_named(CLI::App& app, Options& options, Verb verb, const char* name, const char* description,
               const char* what) {
  add_verb(app, options, verb, name, description)->add_option("NAME", options.words, what)->required()->expected(1);
}

void add_particle(CLI::App& verb, Options& options) {
  verb.add_option("PARTICLE", options.particle, "Number within the world")->required();
}

void add_verbs(CLI::App& app, Options& options) {
  add_verb(app, options, Verb::list, "list", "The worlds on the domain");
  add_verb(app, options, Verb::describe, "describe", "The parameters: values, units, ranges");
  add_verb(app, options, Verb::get, "get", "Values of parameters")
      ->add_option("NAME", options.words, "Names; none: all parameters");
  CLI::App* set = add_verb(app, options, Verb::set, "set", "Change parameters, all or nothing");
  set->add_option("NAME=VALUE", options.words, "0.5, 3, [x, y, z], \"text\" or text")->required();
  set->add_option("--if-revision", options.if_revision, "Refuse unless this parameter revision is in force");
  add_verb(app, options, Verb::reset, "reset", "Start a new run from the scene's initial state")
      ->add_flag("--keep-parameters", options.keep_parameters, "Keep changed parameters");
  add_verb(app, options, Verb::pause, "pause", "Stop the course of time");
  add_verb(app, options, Verb::resume, "resume", "Go on");
  add_verb(app, options, Verb::step, "step", "Do N steps and pause")
      ->add_option("N", options.count, "Number of steps")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  add_verb(app, options, Verb::run_until, "run-until", "Run until a simulated time and stop there")
      ->add_option("T", options.time, "Simulated time, s")
      ->required();
  add_named(app, options, Verb::save, "save", "Save a checkpoint on the server's disk", "Name of the checkpoint");
  add_named(app, options, Verb::restore, "restore", "Go back (or on) to a checkpoint", "Name of the checkpoint");
  add_named(app, options, Verb::load, "load", "Replace the scene by another one of the server's folder",
            "The scene's file, without .toml");
  CLI::App* grab = add_verb(app, options, Verb::grab, "grab", "Pull a particle to a place until it is released");
  add_particle(*grab, options);
  for (const auto& [i, axis] : {std::pair(0, "X"), std::pair(1, "Y"), std::pair(2, "Z")})
    grab->add_option(axis, options.target[i], "Place, m")->required();
  grab->add_option("--stiffness", options.stiffness, "Of the pull, N/m; 0: chosen by the server")
      ->capture_default_str();
  add_particle(*add_verb(app, options, Verb::release, "release", "Let a grabbed particle go"), options);
  add_verb(app, options, Verb::status, "status", "State, health and the report of the newest step")
      ->add_flag("--watch", options.watch,
                 "Until interrupted: a view on a terminal, a line for every status in a pipe");
  add_verb(app, options, Verb::doctor, "doctor", "Looks for what keeps programs apart, and says what to do");
}

}  // namespace

Parsed parse(int argc, const char* const* argv, std::ostream& out, std::ostream& err) {
  Options options;
  options.connect.name = "ctl";
  std::optional<double> wait;
  CLI::App app("Controls flexcast servers over the network.", "flexcast-ctl");
  app.footer(footer);
  app.set_version_flag("--version", "flexcast-ctl " FLEXCAST_VERSION);
  app.require_subcommand(1);
  app.add_option("--world", options.connect.world, "The world; may be left out when there is one only");
  app.add_option("--domain", options.connect.domain, "DDS domain")
      ->check(CLI::Range(0, wire::maximum_domain))
      ->capture_default_str();
  app.add_option("--profile", options.connect.profile, "Network: loopback, lan or PATH.xml (default: loopback)");
  app.add_option("--security", options.connect.security, "Folder with an identity (default: none, in the open)");
  app.add_option("--wait", wait, "Seconds to wait for the server and for its reply (default: 10; status, doctor: 3)")
      ->check(CLI::Range(0.0, 1e6));
  app.add_flag("--json", options.json, "Print one JSON object");
  add_verbs(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return {{}, app.exit(error, out, err) == 0 ? 0 : 2};
  }
  const bool looks_only = options.verb == Verb::status || options.verb == Verb::doctor;
  const double seconds = wait.value_or(looks_only ? 3.0 : 10.0);
  options.connect.wait = std::chrono::nanoseconds(static_cast<std::int64_t>(seconds * 1e9));
  options.connect.timeout = std::max<std::chrono::nanoseconds>(options.connect.wait, std::chrono::seconds(1));
  return {std::move(options), 0};
}

}  // namespace flexcast::ctl
