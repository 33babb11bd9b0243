// What each recorded event does to the simulation.
#include <algorithm>
#include <iterator>

#include "clients/verify/recorded_event.h"
#include "clients/verify/rerun.h"

namespace flexcast::verify {

using server::CommandKind;
using server::Event;
using server::EventKind;

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
