#include "clients/client/connection.h"

#include <unistd.h>

#include <algorithm>
#include <random>
#include <set>

#include "idl/wire/fill.h"
#include "idl/wire/frame_size.h"
#include "idl/wire/names.h"

namespace flexcast::client {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

constexpr nanoseconds poll_interval = 5ms;   // while waiting for a match: matches take 2 to 4 ms
constexpr nanoseconds first_resend = 500ms;  // then doubled
constexpr nanoseconds longest_resend = 5s;

std::string make_client_id(const std::string& name) {
  std::random_device random;
  return name + "-" + std::to_string(getpid()) + "-" + std::to_string(random());
}

std::string describe_place(const std::string& world, const wire::Participant& participant) {
  return (world.empty() ? std::string("world") : "world '" + world + "'") + " on domain " +
         std::to_string(participant.domain()) + " (profile " + participant.profile() + ")";
}

std::string world_names(const wire::WorldWatch& watch) {
  std::set<std::string_view> names;
  for (const wire::World* world : watch.worlds()) names.insert(wire::world_name(*world));
  std::string list;
  for (const auto name : names) list += (list.empty() ? "" : ", ") + std::string(name);
  return list;
}

bool contains(const std::vector<wire::Guid>& guids, const wire::Guid& guid) {
  return std::find(guids.begin(), guids.end(), guid) != guids.end();
}

}  // namespace

Connection::Connection(ConnectOptions options, std::shared_ptr<const wire::Participant> participant,
                       wire::WorldWatch watch, wire::Reader<flexcast_Reply> replies,
                       wire::Result<wire::Writer<flexcast_Command>> commands)
    : options_(std::move(options)),
      client_id_(make_client_id(options_.name)),
      participant_(std::move(participant)),
      watch_(std::move(watch)),
      replies_(std::move(replies)),
      commands_(std::move(commands)) {}

Result<Connection> Connection::open(const ConnectOptions& options) {
  const Deadline deadline(options.wait);
  auto participant =
      wire::Participant::create({.domain = options.domain, .profile = options.profile, .security = options.security});
  if (!participant) return participant.error();
  auto watch = wire::WorldWatch::create(participant.value());
  if (!watch) return watch.error();
  auto replies = wire::Reader<flexcast_Reply>::create(participant.value());
  if (!replies) return replies.error();
  auto commands = wire::Writer<flexcast_Command>::create(participant.value());
  if (!commands && options.security.empty()) return commands.error();
  auto world = choose_world(watch.value(), options, participant.value());
  if (!world) return world.error();

  ConnectOptions chosen = options;
  chosen.world = world.value();
  Connection connection(std::move(chosen), std::make_shared<const wire::Participant>(std::move(participant).value()),
                        std::move(watch).value(), std::move(replies).value(), std::move(commands));
  if (!connection.commands_) return connection;
  if (auto matched = connection.wait_for_match(std::max<nanoseconds>(deadline.left(), 1s)); !matched)
    return matched.error();
  return connection;
}

Result<std::string> Connection::choose_world(wire::WorldWatch& watch, const ConnectOptions& options,
                                             const wire::Participant& participant) {
  const bool found = watch.wait_for(options.world, options.wait);
  if (found && !options.world.empty()) return options.world;
  const std::string place = describe_place(options.world, participant);
  if (!found) {
    const std::string others = world_names(watch);
    return Error{"no " + place + ": waited " + seconds_text(options.wait) +
                 (others.empty() ? "" : "; there: " + others)};
  }
  watch.discover();
  const std::string names = world_names(watch);
  if (names.find(", ") != std::string::npos) return Error{"more than one " + place + ", name one: " + names};
  return names;
}

std::string Connection::where() const {
  return describe_place(options_.world, *participant_);
}

// With several servers on the domain it is this world's server that counts.
bool Connection::is_matched() {
  watch_.update();
  const wire::World* world = watch_.find(options_.world);
  return world && contains(commands_.value().matched_participants(), world->participant) &&
         contains(replies_.matched_participants(), world->participant);
}

Result<void> Connection::wait_for_match(nanoseconds timeout) {
  for (const Deadline deadline(timeout); !is_matched();) {
    if (deadline.passed()) {
      if (!watch_.find(options_.world)) return Error{where() + " is gone: waited " + seconds_text(timeout)};
      return Error{where() + " takes no commands: waited " + seconds_text(timeout)};
    }
    replies_.wait(std::min(poll_interval, deadline.left()));
  }
  return {};
}

Result<Reply> Connection::send(const Request& request, nanoseconds timeout) {
  if (!commands_)
    return Error{"the identity in " + options_.security + " may not command " + where() + ": " +
                 commands_.error().message};
  if (auto matched = wait_for_match(options_.wait); !matched) return matched.error();
  wire::Owned<flexcast_Command> command;
  to_wire(*command, request);
  wire::set_string(command->world, options_.world);
  wire::set_string(command->client_id, client_id_);
  command->request_id = ++last_request_;
  command->expires_in = timeout == forever ? 0.0 : std::chrono::duration<double>(timeout).count();
  return await_reply(*command, timeout);
}

std::optional<Reply> Connection::take_reply(std::uint64_t request_id) {
  const auto samples = replies_.take();
  if (!samples) return {};
  std::optional<Reply> reply;
  for (const auto [sample, info] : samples.value())
    if (info.valid && sample.request_id == request_id && wire::text(sample.client_id) == client_id_ &&
        wire::text(sample.world) == options_.world)
      reply = from_wire(sample);
  return reply;
}

Result<Reply> Connection::await_reply(const flexcast_Command& command, nanoseconds timeout) {
  const Deadline deadline(timeout);
  nanoseconds interval = first_resend;
  for (;;) {
    if (auto written = commands_.value().write(command); !written) return written.error();
    const Deadline resend(std::min(interval, deadline.left()));
    do {
      if (auto reply = take_reply(command.request_id)) return std::move(*reply);
      replies_.wait(resend.left());
    } while (!resend.passed());
    if (auto reply = take_reply(command.request_id)) return std::move(*reply);
    if (deadline.passed())
      return Error{"no reply to " + std::string(wire::name_of(command.kind)) + " from " + where() + " within " +
                   seconds_text(timeout)};
    if (auto matched = wait_for_match(std::min(options_.wait, deadline.left())); !matched) return matched.error();
    interval = std::min(2 * interval, longest_resend);
  }
}

Result<Status> Connection::status(nanoseconds timeout) {
  watch_.update();
  const auto asked = Deadline::Clock::now();
  for (const Deadline deadline(timeout);;) {
    watch_.update();
    const wire::World* world = watch_.find(options_.world);
    if (world && world->heard > asked) return world->status;
    if (deadline.passed()) return Error{"no status from " + where() + " within " + seconds_text(timeout)};
    watch_.wait(std::min<nanoseconds>(100ms, deadline.left()));
  }
}

wire::Qos Connection::frames_qos(Keep keep) const {
  if (keep == Keep::newest) return wire::topic(wire::TopicId::frames).monitor;
  if (const auto reader = wire::Reader<flexcast_SceneInfo>::create(*participant_)) {
    for (const Deadline deadline(1s); !deadline.passed(); reader.value().wait(deadline.left())) {
      const auto samples = reader.value().take();
      if (!samples) break;
      for (const auto [scene, info] : samples.value())
        if (info.valid && wire::text(scene.world) == options_.world) {
          const wire::FrameSize size = wire::frame_size(scene);
          return wire::frames_recorder_qos(size.bytes, size.chunks);
        }
    }
  }
  return wire::frames_recorder_qos(wire::largest_sample, 1);
}

Result<FrameStream> Connection::frames(Keep keep) {
  auto reader = wire::Reader<flexcast_ParticleFrame>::create(*participant_, frames_qos(keep));
  if (!reader) return reader.error();
  for (const Deadline deadline(options_.wait);;) {
    watch_.update();
    const wire::World* world = watch_.find(options_.world);
    if (world && contains(reader.value().matched_participants(), world->participant)) break;
    if (deadline.passed()) return Error{"no frames of " + where() + ": waited " + seconds_text(options_.wait)};
    reader.value().wait(std::min(poll_interval, deadline.left()));
  }
  return FrameStream(participant_, std::move(reader).value(), options_.world);
}

}  // namespace flexcast::client
