#include "clients/ctl/verbs.h"

#include "clients/ctl/doctor.h"
#include "clients/ctl/json.h"
#include "clients/ctl/status.h"
#include "clients/ctl/text.h"

namespace flexcast::ctl {
namespace {

using client::Reply;
using client::Request;
using client::Result;

int fail(std::ostream& err, const std::string& message) {
  err << "flexcast-ctl: " << message << "\n";
  return 1;
}

Result<Reply> execute(const Options& options, client::Connection& connection) {
  switch (options.verb) {
    case Verb::describe:
      return connection.describe();
    case Verb::get:
      return connection.get(options.words);
    case Verb::set:
      return connection.set_text(options.words, options.if_revision);
    case Verb::reset:
      return connection.reset(options.keep_parameters);
    case Verb::pause:
      return connection.pause();
    case Verb::resume:
      return connection.resume();
    case Verb::step:
      return connection.step(options.count);
    case Verb::run_until:
      return connection.run_until(options.time);
    case Verb::load:
      return connection.load(options.words.at(0));
    case Verb::save:
      return connection.save(options.words.at(0));
    case Verb::restore:
      return connection.restore(options.words.at(0));
    case Verb::grab:
      return connection.grab(options.particle, options.target, options.stiffness);
    case Verb::release:
      return connection.release(options.particle);
    case Verb::list:
    case Verb::status:
    case Verb::doctor:
      break;
  }
  return connection.send({.kind = flexcast_COMMAND_STATUS});
}

std::string text_of(Verb verb, const Reply& reply) {
  if (verb == Verb::describe) return descriptors_table(reply);
  if (verb == Verb::get) return values_table(reply.values);
  return outcome_line(reply) + "\n" + values_table(reply.values);
}

}  // namespace

int run_command(const Options& options, client::Connection& connection, std::ostream& out, std::ostream& err) {
  const auto reply = execute(options, connection);
  if (!reply) return fail(err, reply.error().message);
  const bool applied = reply.value().applied();
  if (options.json) out << to_json(reply.value(), connection.world()).dump() << std::endl;
  if (!applied) return fail(err, outcome_line(reply.value()));
  if (!options.json) out << text_of(options.verb, reply.value()) << std::flush;
  return 0;
}

int run_list(const Options& options, std::ostream& out, std::ostream& err) {
  const auto participant = join(options);
  if (!participant) return fail(err, participant.error().message);
  auto watch = wire::WorldWatch::create(participant.value());
  if (!watch) return fail(err, watch.error().message);
  watch.value().discover(std::min<std::chrono::nanoseconds>(options.connect.wait, std::chrono::seconds(1)));

  std::vector<const flexcast_Status*> statuses;
  for (const wire::World* world : watch.value().worlds())
    if (options.connect.world.empty() || options.connect.world == wire::world_name(*world))
      statuses.push_back(world->status.get());
  if (options.json) {
    Json worlds = Json::array();
    for (const auto* status : statuses) worlds.push_back(to_json(*status));
    out << Json{{"worlds", std::move(worlds)}}.dump() << std::endl;
  } else if (!statuses.empty()) {
    out << worlds_table(statuses) << std::flush;
  }
  if (statuses.empty())
    err << "flexcast-ctl: no worlds on domain " << options.connect.domain << " (profile "
        << participant.value().profile() << ")\n";
  return 0;
}

int run(int argc, const char* const* argv, std::ostream& out, std::ostream& err) {
  const Parsed parsed = parse(argc, argv, out, err);
  if (!parsed.options) return parsed.exit_code;
  const Options& options = *parsed.options;
  if (options.verb == Verb::list) return run_list(options, out, err);
  if (options.verb == Verb::status) return run_status(options, out, err);
  if (options.verb == Verb::doctor) return run_doctor(options, out, err);
  auto connection = client::Connection::open(options.connect);
  if (!connection) return fail(err, connection.error().message);
  return run_command(options, connection.value(), out, err);
}

}  // namespace flexcast::ctl
