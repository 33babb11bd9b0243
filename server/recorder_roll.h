// RecorderRoll: the recorders that a world in lockstep waits for, and what each of them has in hand. Filled by the
// thread that listens to recorders (recorder_watch.h), asked by the simulation thread before each step.
//
// A recorder holds the world until it has a frame of the present run, and again while the newest frame is too far ahead
// of what it has. One that pauses stays on the roll and holds nothing.
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <vector>

namespace flexcast::server {

class RecorderRoll {
 public:
  struct Rules {
    std::size_t recorders = 0;  // so many must have a frame in hand before the first step
    std::size_t history = 64;   // frames that the stream keeps for readers that lag
  };

  struct Standing {
    bool paused = false;
    std::uint64_t run_id = 0;      // 0: none yet
    std::uint64_t next_frame = 0;  // of that run: everything before it is in hand
  };

  // Where the world stands.
  struct Position {
    std::uint64_t run_id = 0;
    std::uint64_t frame = 0;   // the newest
    std::size_t mailbox = 64;  // frames that fit between simulation and publisher
  };

  explicit RecorderRoll(const Rules& rules) : rules_(rules) {}

  // A recorder registers, or has gone on.
  void note(const std::string& recorder, const Standing& standing);
  // It has ended, or is gone.
  void forget(const std::string& recorder);

  bool may_step(const Position& position);
  // No recorder lacks the newest frame.
  bool have_all(const Position& position) const;
  // Whom the world waits for, and why, for people; nothing when it may step.
  std::vector<std::string> calc_waits(const Position& position) const;

  // How far the newest frame may be ahead of what a recorder has: what is under way fits twice into the stream's
  // history, since a new run begins while the old one's frames are still under way.
  static std::uint64_t calc_window(std::size_t history, std::size_t mailbox);

 private:
  bool holds(const Standing& standing, const Position& position) const;
  std::size_t count_beginners(const Position& position) const;

  const Rules rules_;
  mutable std::mutex mutex_;
  std::map<std::string, Standing> recorders_;
  bool assembled_ = false;  // as many as the rules want have been there
};

}  // namespace flexcast::server
