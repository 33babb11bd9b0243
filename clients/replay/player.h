// Player: plays a tape at its pace and does what commands ask. One thread calls it; it waits for nothing itself.
//
// The first pass publishes runs and frames as they were recorded, unless the recording is shown from a later time on.
// After every jump (reset, replay.time, the next round of a loop) the run is a new one, and its frames count from 0:
// readers ignore numbers that are not newer. A goal (`step n`, `run_until t`) makes the replay run and ends in
// `paused`; whatever stops it earlier answers the goal's request with wrong_state and says why.
#pragma once

#include <optional>
#include <string>

#include "clients/replay/command_desk.h"
#include "clients/replay/health.h"
#include "clients/replay/pacer.h"
#include "clients/replay/parameters.h"
#include "clients/replay/publications.h"
#include "clients/replay/run_ids.h"
#include "clients/replay/tape.h"

namespace flexcast::replay {

struct PlayerOptions {
  std::string world;
  std::uint64_t server_id = 0;
  Settings settings;
  bool paused = false;
};

class Player {
 public:
  // Publications and desk must outlive the player.
  Player(Tape tape, const PlayerOptions& options, Publications& publications, CommandDesk& desk);

  // A status that only announces the world: heartbeat 0.
  void announce();

  // Publishes the first frame.
  void begin(Clock::time_point now);

  // Publishes what is due and returns how long nothing more will be.
  Clock::duration turn(Clock::time_point now);

  // Executes what has come in.
  void take_commands(Clock::time_point now);

  // Answers what is open, publishes a last status and says goodbye.
  void close();

  flexcast_WorldState state() const { return state_; }
  const Shown& shown() const { return shown_; }
  std::uint64_t frames_published() const { return frames_published_; }  // of this run

 private:
  struct Goal {
    Command command;
    std::uint64_t frames = 0;    // left to show; 0: not a matter of frames
    std::optional<double> time;  // s
  };

  // player.cpp
  bool running() const { return state_ == flexcast_WORLD_RUNNING; }
  void show_next(Clock::time_point now);
  void settle();
  void end_pass(Clock::time_point now);
  void jump(std::size_t clip, std::size_t frame, Clock::time_point now);
  Clock::duration wait_for_next(Clock::time_point now);
  void publish(const recording::RecordedMessage& message);
  void show(const recording::RecordedMessage& message);
  void publish_status(bool as_it_came);
  void serve_late_reader(Clock::time_point now);
  Stamp stamp() const { return {options_.world, runs_}; }
  wire::Owned<flexcast_Status> make_status(bool as_it_came) const;

  // player_commands.cpp
  void execute(Command command, Clock::time_point now);
  void set(const flexcast_Command& command, Clock::time_point now);
  void get(const flexcast_Command& command);
  void describe(const flexcast_Command& command);
  void reset(const flexcast_Command& command, Clock::time_point now);
  void pause(const flexcast_Command& command);
  void resume(const flexcast_Command& command);
  void step(Command command);
  void run_until(Command command);
  void begin_goal(Goal goal);
  void drop_goal(const std::string& reason);
  void interrupt_goal(const std::string& reason);
  void seek(double time, Clock::time_point now);
  void set_rate(double rate);
  Dials dials() const;
  Reply make_reply(const flexcast_Command& command, flexcast_ReplyOutcome outcome, const std::string& reason) const;
  void answer(const flexcast_Command& command, flexcast_ReplyOutcome outcome = flexcast_OUTCOME_APPLIED,
              const std::string& reason = {});

  Tape tape_;
  PlayerOptions options_;
  Publications& publications_;
  CommandDesk& desk_;
  Settings settings_;
  Pacer pacer_;
  RunIds run_ids_;
  RunMap runs_;
  Health health_;
  flexcast_WorldState state_;
  std::optional<Goal> goal_;
  Shown shown_;
  std::uint64_t frames_published_ = 0;
  std::uint64_t heartbeat_ = 0;
  Clock::time_point status_written_;
  std::uint32_t readers_ever_ = 0;
  std::optional<Clock::time_point> reader_joined_;  // no frame was published since
};

}  // namespace flexcast::replay
