// Replay: a recording, its player and the thread that plays it, wired together.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "clients/replay/options.h"
#include "clients/replay/player.h"
#include "idl/wire/wait_set.h"

namespace flexcast::replay {

class Replay {
 public:
  // Told what there is to say while a recording is read, and later on.
  struct Listener {
    Publications::Say say;                 // a line for people
    recording::Index::Progress read = {};  // messages read so far
  };

  // Reads through the recording, joins the domain, claims the world's name and begins. Errors are for the user to read.
  static wire::Result<std::unique_ptr<Replay>> start(const Options& options, const Listener& listener);
  ~Replay() { stop(); }
  Replay(const Replay&) = delete;
  Replay& operator=(const Replay&) = delete;

  // Answers what is open, publishes a last status and says goodbye.
  void stop();

  // "world beam on domain 0, profile loopback: 2001 frames in 1 run, rate 1", as it began.
  const std::string& description() const { return description_; }
  const std::string& world() const { return world_; }

  // What is shown now, for people to look at.
  struct Latest {
    flexcast_WorldState state = flexcast_WORLD_PAUSED;
    Shown shown;
    std::uint64_t frames_published = 0;
  };
  Latest latest() const;
  bool ended() const { return latest().state == flexcast_WORLD_FINISHED; }

 private:
  Replay(wire::Participant participant, std::string world, Publications publications, CommandDesk desk,
         wire::GuardCondition stop_signal, wire::WaitSet wait_set);
  void run();
  void tell();

  wire::Participant participant_;
  std::string world_;
  std::string description_;
  Publications publications_;
  CommandDesk desk_;
  wire::GuardCondition stop_signal_;
  wire::WaitSet wait_set_;  // goes before what is attached to it
  std::unique_ptr<Player> player_;
  mutable std::mutex mutex_;  // guards latest_
  Latest latest_;
  std::atomic<bool> stopping_ = false;
  std::thread thread_;
};

}  // namespace flexcast::replay
