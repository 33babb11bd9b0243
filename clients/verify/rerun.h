// Rerun: one recorded run once more, from its scene and its events, compared frame by frame.
//
// Events act between the step they name and the next, in the order of their numbers. What a contract chose by the clock
// is taken from them; what it chose by tolerance must come out again.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>

#include "clients/verify/frame_check.h"
#include "clients/verify/run_report.h"
#include "core/scene/scene.h"

namespace flexcast::verify {

// Checkpoints that the recording has seen saved, by world and name.
using SavedCheckpoints = std::map<std::pair<std::string, std::string>, Checkpoint>;

// Told after every step; false ends the work.
using KeepGoing = std::function<bool(std::int64_t step)>;

class Rerun {
 public:
  // All must outlive the rerun. `checkpoints` of earlier runs; those saved in this one are added.
  Rerun(const RecordedRun& run, SavedCheckpoints& checkpoints, const KeepGoing& keep_going)
      : run_(run), checkpoints_(checkpoints), keep_going_(keep_going), check_(run.frames) {}

  // To the last frame, or to the last event that later runs need or that can be checked.
  RunReport execute();

 private:
  bool load();
  bool execute_events();
  bool execute_rest();
  bool advance_to(std::int64_t step, const server::Event& event);
  bool take_step();
  void add_frame();
  bool apply(const server::Event& event);
  bool apply_command(const server::Event& event);
  bool set(const server::Event& event);
  bool begin_with_kept(const server::Event& event);
  bool restore(const server::Event& event);
  bool choose(const server::Event& event);
  bool fail_as_recorded(const server::Event& event);
  bool check_choice();
  bool stop(Verdict verdict, std::string reason);

  const RecordedRun& run_;
  SavedCheckpoints& checkpoints_;
  const KeepGoing& keep_going_;
  FrameCheck check_;
  RunReport report_;
  Scene scene_;
  std::string last_event_ = "the start";
  TimeChoice choice_ = {.substeps = 0, .iterations = 0};  // the last one recorded
};

}  // namespace flexcast::verify
