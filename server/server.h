// Server: a scene, its world and the threads around it, wired together.
#pragma once

#include <memory>
#include <string>

#include "core/base/result.h"
#include "core/scene/scene.h"
#include "server/command_service.h"
#include "server/frame_mailbox.h"
#include "server/options.h"
#include "server/publisher.h"
#include "server/recorder_watch.h"
#include "server/simulation_thread.h"

namespace flexcast::server {

class Server {
 public:
  // Loads the scene, joins the domain, claims the world's name and begins. Errors are for the user to read.
  static Result<std::unique_ptr<Server>> start(const Options& options);
  ~Server() { stop(); }
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  // Ends in order: no more commands, no more steps, what waits is published, a last status, goodbye.
  void stop();
  // The first half of it, without waiting: no more commands, and the step or command under way is the last. When
  // steps_ended(), stop() takes about a second at most.
  void begin_stop();
  bool steps_ended() const { return simulation_.stopped(); }
  // Instead of stop(), when a step or a command does not come to an end: what waits is published, the last status
  // says what was cut off, goodbye. The step loop still runs afterwards, in the midst of this object, which is neither
  // to be used nor to be destroyed any more: end the process.
  // `reason`: "5 s after SIGTERM". Returns what was cut off, for the user to read.
  std::string cut_off(const std::string& reason);

  // "world bunny on domain 0, profile loopback: 2500 particles, dt 0.001 s, rate 1", as it began.
  const std::string& description() const { return description_; }

  WorldState state() const { return simulation_.state(); }
  // The world stands at its end (or failed), and its last frame is on its way; in lockstep recorders have it.
  bool ended() const;
  Publisher::Latest latest() const { return publisher_.latest(); }

 private:
  Server(Scene scene, const WorldOptions& options, std::unique_ptr<RecorderRoll> roll, wire::Participant participant,
         Publications publications);

  wire::Result<void> watch_recorders();

  wire::Participant participant_;
  RunIds run_ids_;
  World world_;
  Queue<Command> commands_{4096};  // more than that and clients have to ask again
  Queue<Reply> replies_;
  FrameMailbox mailbox_;
  std::unique_ptr<RecorderRoll> roll_;  // null: not in lockstep
  SimulationThread simulation_;
  Publications publications_;
  Publisher publisher_;
  std::unique_ptr<CommandService> service_;
  std::unique_ptr<RecorderWatch> recorders_;  // with a roll
  std::string description_;
};

}  // namespace flexcast::server
