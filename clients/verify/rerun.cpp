#include "clients/verify/rerun.h"

#include <algorithm>

#include "clients/verify/recorded_event.h"
#include "clients/verify/recorded_scene.h"
#include "idl/wire/fill.h"

namespace flexcast::verify {
namespace {

using server::CommandKind;
using server::Event;
using server::EventKind;

// Events after the last frame that are executed all the same: failures are checked, checkpoints may be needed later.
std::uint64_t find_last_needed(const RecordedRun& run) {
  std::uint64_t last = 0;
  for (const auto& [index, event] : run.events) {
    const bool saves = event.kind == EventKind::command && event.command == CommandKind::save;
    if (saves || is_failure(event)) last = index + 1;
  }
  return last;
}

}  // namespace

bool Rerun::stop(Verdict verdict, std::string reason) {
  report_.verdict = verdict;
  report_.reason = std::move(reason);
  return false;
}

RunReport Rerun::execute() {
  report_.run_id = run_.run_id;
  report_.world = run_.world;
  report_.gaps = find_gaps(run_);
  for (const auto& [first, last] : report_.gaps) report_.missing_frames += last - first + 1;
  if (run_.frames.empty()) stop(Verdict::empty, "no frame of this run was recorded");
  if (load() && execute_events()) execute_rest();
  check_.settle();
  if (run_.frames.empty() && report_.verdict == Verdict::not_verifiable) report_.verdict = Verdict::empty;
  report_.frames = check_.compared();
  report_.differing = check_.differing();
  report_.first_difference = check_.first_difference();
  if (report_.first_difference && report_.verdict == Verdict::equal) {
    stop(Verdict::differs, std::to_string(report_.differing) + " of " + std::to_string(report_.frames) +
                               " frames differ from what scene and events give");
  }
  return std::move(report_);
}

bool Rerun::load() {
  if (!run_.scene) return stop(Verdict::not_verifiable, "the scene of this run is not in the recording");
  const flexcast_SceneInfo& info = **run_.scene;
  report_.scene = wire::text(info.name);
  report_.server_version = wire::text(info.version);
  if (const std::string missing = describe_missing_event(run_); !missing.empty()) {
    return stop(Verdict::not_verifiable, missing);
  }
  auto scene = load_recorded_scene(info);
  if (!scene) return stop(Verdict::not_verifiable, scene.error().message);
  scene_ = std::move(scene).value();
  add_frame();
  return true;
}

bool Rerun::execute_events() {
  const std::uint64_t needed = find_last_needed(run_);
  for (const auto& [index, event] : run_.events) {
    const auto place = find_place(event);
    if (!place) return stop(Verdict::not_verifiable, describe(event) + " does not say which step it left");
    const std::int64_t step = scene_.simulation->state().step;
    // A choice that a tolerance made in a step names the step before it, so nothing comes before the present one.
    if (*place < step) {
      return stop(Verdict::not_verifiable, describe(event) + " at step " + std::to_string(*place) +
                                               " follows an event at step " + std::to_string(step) +
                                               ": the recording contradicts itself");
    }
    if (check_.done() && index >= needed && *place > step) return true;
    if (!advance_to(*place, event) || !apply(event)) return false;
    check_.look_again(*scene_.simulation);
    last_event_ = describe(event);
    ++report_.events;
  }
  return true;
}

// After the last event, to the last frame.
bool Rerun::execute_rest() {
  const std::int64_t last = check_.last_step();
  while (!check_.done() && scene_.simulation->state().step < last) {
    if (!take_step()) return false;
  }
  if (const RecordedFrame* frame = check_.unreached()) {
    return stop(Verdict::differs, "frame " + std::to_string(frame->frame) + " (step " + std::to_string(frame->step) +
                                      ") is none that scene and events give");
  }
  return true;
}

bool Rerun::advance_to(std::int64_t step, const Event& event) {
  while (scene_.simulation->state().step < step) {
    if (take_step() && check_choice()) continue;
    if (report_.verdict == Verdict::differs) report_.reason += "; the next event is " + describe(event);
    return false;
  }
  return true;
}

bool Rerun::take_step() {
  check_.settle();
  Simulation& simulation = *scene_.simulation;
  if (!simulation.step()) {
    return stop(Verdict::differs, "step " + std::to_string(simulation.state().step + 1) +
                                      " was taken in the recording and cannot be taken here: " +
                                      (simulation.failure() ? simulation.failure()->text() : ""));
  }
  ++report_.steps;
  if (simulation.state().step % std::max(1, simulation.settings().stream.every) == 0) add_frame();
  if (keep_going_(simulation.state().step)) return true;
  return stop(Verdict::not_verifiable, "interrupted at step " + std::to_string(simulation.state().step));
}

void Rerun::add_frame() {
  check_.add_frame(*scene_.simulation, last_event_);
}

// A tolerance rests on nothing but the motion, so the same must have been chosen.
bool Rerun::check_choice() {
  const Simulation& simulation = *scene_.simulation;
  if (!simulation.has_contract() || simulation.settings().time.budget > 0.0 || simulation.choice() == choice_) {
    return true;
  }
  return stop(Verdict::differs, "step " + std::to_string(simulation.state().step) + " took " +
                                    std::to_string(simulation.choice().substeps) + " substeps here and " +
                                    std::to_string(choice_.substeps) + " in the recording");
}

}  // namespace flexcast::verify
