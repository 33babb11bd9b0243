// World: a simulation, its state (running, paused, finished, failed) and what commands do to it. It has no thread and
// no clock: the simulation thread calls it and hands on what it leaves behind (frames due, replies, notices).
//
// A world that reaches the end it was given (`until`) is finished: it may be stepped or run further, and is paused
// then. After a reset a world runs if it ran, stands if it stood; a finished or failed one starts as it was started.
// Loading another scene is a reset that changes everything but the world's name. Restoring a checkpoint stays within
// the run: step and time jump, frames are numbered on, and the restored state is a frame; a finished or failed world is
// paused then. A goal (`step n`, `run_until t`) makes the world run and ends in `paused`; whatever stops the world
// earlier (pause, reset, load, restore, a failure, a newer goal) answers the goal's request with wrong_state and says
// why.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/scene.h"
#include "core/sim/budget_control.h"
#include "server/checkpoint_folder.h"
#include "server/chronicle.h"
#include "server/convert/command_types.h"
#include "server/convert/status_types.h"
#include "server/frame_ring.h"
#include "server/parameter_table.h"
#include "server/run_ids.h"

namespace flexcast::server {

// The scene of that name; an error says why there is none.
using SceneLoader = std::function<Result<Scene>(const std::string& name)>;

struct WorldOptions {
  double rate = 1.0;  // simulated seconds per wall second; 0: as fast as possible
  bool paused = false;
  std::optional<double> until = {};                   // s
  std::filesystem::path checkpoints = "checkpoints";  // folder of this world's
  SceneLoader load_scene = {};                        // none: no other scene can be loaded
};

class World {
 public:
  World(Scene scene, const WorldOptions& options, RunIds& run_ids);

  WorldState state() const { return state_; }
  bool running() const { return state_ == WorldState::running; }
  bool is_over() const { return state_ == WorldState::finished || state_ == WorldState::failed; }
  std::uint64_t run_id() const { return chronicle_.run_id(); }
  double rate() const { return parameters_.rate(); }
  std::uint64_t topology_revision() const { return topology_revision_; }  // grows with every scene that is loaded
  const Simulation& simulation() const { return *scene_->simulation; }
  const State& simulation_state() const { return simulation().state(); }
  const StreamFormat& stream_format() const { return format_; }
  double next_time() const;                                       // s, after the next step
  std::uint64_t newest_frame() const { return next_frame_ - 1; }  // of the run, which begins with one

  // Does what the command asks, between two steps. The answer is among the replies, at once or when it is reached.
  void apply(const Command& command, Clock::time_point now);

  // One step of a running world; a step that cannot be taken leaves it failed. Call settle() afterwards, when the frame
  // has been handed on.
  void take_step();
  // Ends the goal or the run that the last step has reached. `wall_seconds`: what that step took.
  void settle(double wall_seconds);

  // The server is ending: answers what is still open.
  void close();

  // The frame of the present state, once.
  std::optional<FrameHeader> take_due_frame();
  std::vector<Reply> take_replies() { return std::exchange(replies_, {}); }
  std::vector<Notice> take_notices() { return chronicle_.take(); }
  WorldStatus calc_status() const;

 private:
  struct Goal {
    Command command;
    std::int64_t step = 0;
  };

  void do_command(const Command& command, const SetCommand& set);
  void do_command(const Command& command, const GetCommand& get);
  void do_command(const Command& command, const DescribeCommand&);
  void do_command(const Command& command, const ResetCommand& reset);
  void do_command(const Command& command, const PauseCommand&);
  void do_command(const Command& command, const ResumeCommand&);
  void do_command(const Command& command, const StepCommand& step);
  void do_command(const Command& command, const RunUntilCommand& run_until);
  void do_command(const Command& command, const LoadCommand& load);
  void do_command(const Command& command, const SaveCommand& save);
  void do_command(const Command& command, const RestoreCommand& restore);
  void do_command(const Command& command, const GrabCommand& grab);
  void do_command(const Command& command, const ReleaseCommand& release);
  void do_command(const Command& command, const StatusCommand&);
  void do_command(const Command& command, const MalformedCommand& malformed);

  void begin_run();
  void begin_again();
  void begin_goal(const Command& command, std::int64_t step, const std::string& text);
  void drop_goal(const std::string& reason);
  void interrupt_goal(const std::string& reason);
  void change_state(WorldState state, const std::string& text);
  void fail();
  void follow_budget();
  void note_choice(const Moment& from);
  void follow_parameters();
  void note_new_warnings();
  std::optional<std::int64_t> find_end_step() const;
  bool at_end() const { return end_step_ && simulation().state().step >= *end_step_; }
  bool arrived() const;  // at the goal; without one at the end
  void make_frame_due();

  Moment moment() const;
  MeasuredReport calc_measured_report() const;
  Reply make_reply(const Command& command, Outcome outcome, std::string reason = {}) const;
  void answer(const Command& command, Outcome outcome, std::string reason = {});

  std::shared_ptr<const Scene> scene_;  // shared: see RunStarted
  std::uint64_t topology_revision_ = 1;
  WorldOptions options_;
  RunIds& run_ids_;
  CheckpointFolder checkpoints_;
  ParameterTable parameters_;
  Chronicle chronicle_;
  BudgetControl budget_;
  TimeChoice noted_choice_ = {.substeps = 0, .iterations = 0};  // the last one of this run in the chronicle
  bool stepped_ = false;                                        // a step was taken and is not settled
  WorldState state_ = WorldState::paused;
  StreamFormat format_;
  std::vector<std::string> warnings_;
  std::optional<std::int64_t> end_step_;  // of --until; gone once it has been reached
  std::optional<Goal> goal_;
  std::optional<FrameHeader> due_frame_;
  std::uint64_t next_frame_ = 0;
  double wall_seconds_ = 0.0;  // of the last step
  std::vector<Reply> replies_;
};

}  // namespace flexcast::server
