// Connection: a client of one running world. Commands go out and come back acknowledged; frames and statuses come in.
//
//   auto connection = client::Connection::open({.world = "cantilever", .domain = 7}).value();
//   auto frames = connection.frames().value();
//   auto reply = connection.set({{"gravity", client::Vector{0, 0, -3}}}).value();
//   auto frame = frames.wait_for_frame(
//       [&](const client::Frame& f) { return f.parameter_revision >= reply.parameter_revision; }, 5s);
//
// Two kinds of failure: an Error is a command that got no answer (no server, no such world, timeout); a Reply whose
// outcome is not applied is a server that said no, and why. Nothing throws. Use a connection from one thread at a time.
#pragma once

#include <chrono>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "clients/client/clock.h"
#include "clients/client/frame_stream.h"
#include "clients/client/reply.h"
#include "clients/client/request.h"
#include "idl/wire/world_watch.h"
#include "idl/wire/writer.h"

namespace flexcast::client {

struct ConnectOptions {
  std::string world{};    // "": the only world of the domain
  int domain = 0;         // 0..230
  std::string profile{};  // loopback, lan, PATH.xml; "": loopback unless CYCLONEDDS_URI is set
  // Folder with an identity; "": none. One that may only watch opens a connection whose commands are all errors.
  std::string security{};
  std::chrono::nanoseconds wait = std::chrono::seconds(10);     // for the world to appear, when opening and later on
  std::chrono::nanoseconds timeout = std::chrono::seconds(10);  // for the reply to a command
  std::string name = "client";  // the beginning of client_id: who this is, in the server's log and events
};

using Status = std::shared_ptr<const flexcast_Status>;  // never null: status->state, status->report.kinetic, ...

class Connection {
 public:
  // Waits until the world is there and, unless the identity may only watch, commands and replies are matched. The error
  // says what was looked for: world, domain and profile; with several worlds and no name given it lists them.
  static Result<Connection> open(const ConnectOptions& options);

  const std::string& world() const { return options_.world; }
  const std::string& client_id() const { return client_id_; }  // unique: name, process, random number

  // Sends a command and waits for its reply, which comes after the effect. The same request goes out again while there
  // is no answer; the server executes it once. It expires at the server when the timeout has passed. With `forever` it
  // waits as long as the world lives.
  Result<Reply> send(const Request& request, std::chrono::nanoseconds timeout);
  Result<Reply> send(const Request& request) { return send(request, options_.timeout); }

  // Parameters. Values of set are checked by the server; a batch takes effect as a whole or not at all.
  Result<Reply> describe();
  Result<Reply> get(const std::vector<std::string>& names = {});  // none: all
  // With a revision they are refused unless it is the parameter revision in force: nobody has changed any in between.
  Result<Reply> set(const std::vector<Parameter>& values, std::optional<std::uint64_t> if_revision = {});
  // NAME=VALUE as people write it ("gravity=[0, 0, -3]", "solver.linear=pcg"); asks for the descriptors first.
  Result<Reply> set_text(std::span<const std::string> assignments, std::optional<std::uint64_t> if_revision = {});

  // The course of time. The reply to step comes when the steps are done.
  Result<Reply> pause();
  Result<Reply> resume();
  Result<Reply> reset(bool keep_parameters = false);
  Result<Reply> step(std::uint64_t count = 1, std::chrono::nanoseconds timeout = forever);
  Result<Reply> run_until(double time, std::chrono::nanoseconds timeout = forever);

  // Checkpoints, by name, on the server's disk: also across restarts of the server. A restored state goes on to the
  // last bit as the saved one did.
  Result<Reply> save(const std::string& name);
  Result<Reply> restore(const std::string& name);

  // Replaces the scene by another one of the server's folder; the run is a new one.
  Result<Reply> load(const std::string& name);

  // Pulls a particle (number within the world) to a place, m, until it is released; a second grab moves the place.
  // stiffness in N/m; 0: chosen by the server.
  Result<Reply> grab(std::uint32_t particle, const Vector& target, double stiffness = 0.0);
  Result<Reply> release(std::uint32_t particle);

  // The next status the server publishes (four times a second): written after the call.
  Result<Status> status(std::chrono::nanoseconds timeout = std::chrono::seconds(5));

  // Subscribes to the frames and waits for the match. May be called several times.
  Result<FrameStream> frames(Keep keep = Keep::every);

 private:
  Connection(ConnectOptions options, std::shared_ptr<const wire::Participant> participant, wire::WorldWatch watch,
             wire::Reader<flexcast_Reply> replies, wire::Result<wire::Writer<flexcast_Command>> commands);
  static Result<std::string> choose_world(wire::WorldWatch& watch, const ConnectOptions& options,
                                          const wire::Participant& participant);
  bool is_matched();
  Result<void> wait_for_match(std::chrono::nanoseconds timeout);
  std::optional<Reply> take_reply(std::uint64_t request_id);
  Result<Reply> await_reply(const flexcast_Command& command, std::chrono::nanoseconds timeout);
  std::string where() const;  // "world 'beam' on domain 0 (profile loopback)"
  wire::Qos frames_qos(Keep keep) const;

  ConnectOptions options_;
  std::string client_id_;
  std::uint64_t last_request_ = 0;
  std::shared_ptr<const wire::Participant> participant_;  // shared: frame streams may outlive the connection
  wire::WorldWatch watch_;
  wire::Reader<flexcast_Reply> replies_;  // before commands_: no reply may come before there is a reader for it
  wire::Result<wire::Writer<flexcast_Command>> commands_;  // an error: the identity may only watch
};

}  // namespace flexcast::client
