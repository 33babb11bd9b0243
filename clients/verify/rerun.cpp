#include "clients/verify/rerun.h"

#include <algorithm>

#include "clients/verify/recorded_scene.h"
#include "idl/wire/fill.h"

namespace flexcast::verify {
namespace {

using server::CommandKind;
using server::Event;
using server::EventKind;
using server::WorldState;

std::string describe(const Event& event) {
  return "event " + std::to_string(event.index) + " (" + event.text + ")";
}

std::optional<std::int64_t> find_integer(const Event& event, std::string_view name) {
  for (const ParameterAssignment& value : event.values) {
    const auto* number = std::get_if<std::int64_t>(&value.value);
    if (value.name == name && number != nullptr) return *number;
  }
  return {};
}

bool is_restore(const Event& event) {
  return event.kind == EventKind::command && event.command == CommandKind::restore;
}

bool is_failure(const Event& event) {
  return event.kind == EventKind::state && event.state == WorldState::failed;
}

// The step that the world was at when it happened: a restored checkpoint is the only thing that moves it.
std::optional<std::int64_t> find_place(const Event& event) {
  return is_restore(event) ? find_integer(event, "left_step") : event.step;
}

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

// ---------------------------------------------------------------- events

bool Rerun::apply(const Event& event) {
  switch (event.kind) {
    case EventKind::command:
      return apply_command(event);
    case EventKind::choice:
      return choose(event);
    case EventKind::state:
      return !is_failure(event) || fail_as_recorded(event);
    case EventKind::warning:
      break;
  }
  return true;
}

bool Rerun::apply_command(const Event& event) {
  const auto done = [&](const Result<void>& result) {
    return result.ok() || stop(Verdict::differs, describe(event) + " is refused here: " + result.error().message);
  };
  switch (event.command) {
    case CommandKind::set:
      return set(event);
    case CommandKind::reset:
      return begin_with_kept(event);
    case CommandKind::save:
      checkpoints_.insert_or_assign(std::pair(run_.world, event.name), scene_.simulation->save());
      return true;
    case CommandKind::restore:
      return restore(event);
    case CommandKind::grab:
      return done(scene_.simulation->grab(event.particle, event.target, event.stiffness));
    case CommandKind::release:
      return done(scene_.simulation->release(event.particle));
    default:
      return true;  // the course of time, which is in the steps of the events, and the load that began this run
  }
}

// The server's own parameters are none of the simulation's.
bool Rerun::set(const Event& event) {
  std::vector<ParameterAssignment> values;
  std::copy_if(event.values.begin(), event.values.end(), std::back_inserter(values),
               [](const ParameterAssignment& value) { return !value.name.starts_with("server."); });
  if (values.empty()) return true;
  const auto set = scene_.simulation->set_parameters(values);
  return set.ok() || stop(Verdict::differs, describe(event) + " is refused here: " + set.error().message);
}

// A reset makes contracts anew under the values it keeps; setting them does not.
bool Rerun::begin_with_kept(const Event& event) {
  if (!set(event)) return false;
  scene_.simulation->reset(true);
  return true;
}

bool Rerun::restore(const Event& event) {
  const auto saved = checkpoints_.find({run_.world, event.name});
  if (saved == checkpoints_.end()) {
    return stop(Verdict::not_verifiable, describe(event) + " needs a checkpoint that was not saved in this recording");
  }
  check_.settle();
  if (auto restored = scene_.simulation->restore(saved->second); !restored) {
    return stop(Verdict::differs, describe(event) + " is refused here: " + restored.error().message);
  }
  if (scene_.simulation->state().step != event.step) {
    return stop(Verdict::not_verifiable, describe(event) + " went to step " + std::to_string(event.step) +
                                             ", and the checkpoint of that name in this recording is of step " +
                                             std::to_string(scene_.simulation->state().step));
  }
  last_event_ = describe(event);
  add_frame();
  return true;
}

bool Rerun::choose(const Event& event) {
  const auto substeps = find_integer(event, "time.substeps");
  if (!substeps || *substeps < 1 || *substeps > 1'000'000'000) {
    return stop(Verdict::not_verifiable, describe(event) + " does not say how many substeps were chosen");
  }
  const auto iterations = find_integer(event, "solver.iterations").value_or(0);
  choice_ = {static_cast<int>(*substeps), static_cast<int>(std::clamp<std::int64_t>(iterations, 0, 1'000'000'000))};
  scene_.simulation->choose(choice_);
  return true;
}

bool Rerun::fail_as_recorded(const Event& event) {
  check_.settle();
  if (!scene_.simulation->step()) return true;
  return stop(Verdict::differs, "step " + std::to_string(event.step + 1) +
                                    " could not be taken in the recording and is taken here: " + describe(event));
}

}  // namespace flexcast::verify
