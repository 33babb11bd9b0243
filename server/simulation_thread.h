// SimulationThread: owns the step loop. It applies the commands that wait, steps, hands the frame on, keeps the pace;
// it never calls DDS and never waits for the publisher. In lockstep it takes a step only when the last frame has found
// room in the mailbox and the roll of recorders lets it; commands, heartbeat and statuses go on meanwhile.
#pragma once

#include <atomic>
#include <optional>
#include <thread>

#include "core/sim/particle_fields.h"
#include "server/activity.h"
#include "server/frame_mailbox.h"
#include "server/pacer.h"
#include "server/queue.h"
#include "server/rate_meter.h"
#include "server/recorder_roll.h"
#include "server/world.h"

namespace flexcast::server {

class SimulationThread {
 public:
  // `commands` in, `replies` and `mailbox` out, `roll` to run in lockstep (whoever changes it wakes `commands`); all
  // must outlive this object. The first status, frame and notices are handed on here.
  SimulationThread(World& world, Queue<Command>& commands, Queue<Reply>& replies, FrameMailbox& mailbox,
                   RecorderRoll* roll = nullptr);
  ~SimulationThread() { stop(); }
  SimulationThread(const SimulationThread&) = delete;
  SimulationThread& operator=(const SimulationThread&) = delete;

  void start();
  // Ends the loop after the present step or command, answers what is open and hands a last status on.
  void stop();
  // The same without waiting for it: stopped() says when it has come to that.
  void begin_stop();
  bool stopped() const { return stopped_; }

  // What the loop is at; from any thread.
  std::string activity() const { return activity_.text(); }

  // One turn of the loop, for tests that run it without the thread. Returns how long the loop may sleep.
  Clock::duration turn(Clock::time_point now);

  // As of the last turn: the world's state, and whether its newest frame is in the mailbox and, in lockstep, in the
  // hands of every recorder.
  WorldState state() const { return state_; }
  bool handed_over() const { return handed_over_; }

 private:
  static constexpr Clock::duration longest_sleep = std::chrono::milliseconds(50);
  static constexpr Clock::duration silent_hold = std::chrono::seconds(1);  // a longer one is told in the status

  void run();
  void apply_commands(Clock::time_point now);
  void follow(std::uint64_t run, double time);
  bool is_held(Clock::time_point now);
  RecorderRoll::Position position() const;
  void step();
  void hand_frame_over();
  ParticleFields* find_fields();
  void drop_pending_frame();
  void hand_on();  // notices, replies; status when wanted or the state changed
  void post_status();
  bool is_long_held() const { return held_since_ && turned_ - *held_since_ >= silent_hold; }

  World& world_;
  Queue<Command>& commands_;
  Queue<Reply>& replies_;
  FrameMailbox& mailbox_;
  RecorderRoll* roll_;                           // null: not in lockstep
  Clock::time_point turned_;                     // when the present turn began
  std::optional<Clock::time_point> held_since_;  // by recorders
  Pacer pacer_;
  RateMeter meter_;
  std::optional<FrameHeader> pending_;    // of the present state: found no room yet
  std::optional<ParticleFields> fields_;  // of the present scene, made when a frame first needs it
  std::uint64_t frames_skipped_ = 0;
  std::uint64_t topology_revision_ = 0;  // of the mailbox's scene
  std::uint64_t posted_run_ = 0;         // of the last status
  WorldState posted_state_ = WorldState::paused;
  std::atomic<WorldState> state_ = WorldState::paused;
  std::atomic<bool> handed_over_ = false;
  Activity activity_;
  std::atomic<bool> stopping_ = false;
  std::atomic<bool> stopped_ = false;  // the thread has no more to do
  std::thread thread_;
};

}  // namespace flexcast::server
