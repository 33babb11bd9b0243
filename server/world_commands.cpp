// What each command does to a world: one function a command.

#include "server/world.h"

#include <algorithm>

namespace flexcast::server {
namespace {

constexpr double most_steps = 1e15;
constexpr const char* world_has_failed = "the world has failed; set a parameter, restore a checkpoint or reset it";

std::string number_text(double value) {
  return to_text(ParameterValue(value));
}

std::string list_text(const std::vector<ParameterAssignment>& values) {
  std::string text;
  for (const auto& value : values) text += (text.empty() ? "" : ", ") + value.name + " = " + to_text(value.value);
  return text;
}

}  // namespace

void World::apply(const Command& command, Clock::time_point now) {
  if (command.deadline && now > *command.deadline) {
    return answer(command, Outcome::expired, "the command came too late: it expired before its turn");
  }
  if (command.expected_revision && *command.expected_revision != parameters_.revision()) {
    return answer(command, Outcome::rejected,
                  "parameter revision " + std::to_string(parameters_.revision()) + " is in force, not " +
                      std::to_string(*command.expected_revision));
  }
  std::visit([&](const auto& body) { do_command(command, body); }, command.body);
}

void World::do_command(const Command& command, const SetCommand& set) {
  if (set.values.empty()) return answer(command, Outcome::rejected, "no parameter was named");
  if (auto result = parameters_.set(set.values); !result) {
    return answer(command, Outcome::rejected, result.error().message);
  }
  std::vector<std::string> names;
  for (const auto& value : set.values) names.push_back(value.name);
  auto values = parameters_.values_of(names).value();
  const bool recovered = state_ == WorldState::failed && !simulation().failure();
  if (recovered) state_ = WorldState::paused;
  chronicle_.note_command(moment(), command, "set " + list_text(values), values);
  if (recovered) chronicle_.note_state(moment(), "a parameter was set: the failure is cleared");
  follow_parameters();
  Reply reply = make_reply(command, Outcome::applied);
  reply.values = std::move(values);
  replies_.push_back(std::move(reply));
}

void World::do_command(const Command& command, const GetCommand& get) {
  auto values = get.names.empty() ? parameters_.values() : parameters_.values_of(get.names);
  if (!values) return answer(command, Outcome::rejected, values.error().message);
  Reply reply = make_reply(command, Outcome::applied);
  reply.values = std::move(values).value();
  replies_.push_back(std::move(reply));
}

void World::do_command(const Command& command, const DescribeCommand&) {
  Reply reply = make_reply(command, Outcome::applied);
  reply.values = parameters_.values();
  reply.descriptors = parameters_.descriptors();
  replies_.push_back(std::move(reply));
}

void World::do_command(const Command& command, const ResetCommand& reset) {
  interrupt_goal("the world was reset");
  parameters_.reset(reset.keep_parameters);
  begin_again();
  auto kept = parameters_.changed();
  chronicle_.note_command(moment(), command, kept.empty() ? "reset" : "reset, keeping " + list_text(kept),
                          std::move(kept));
  chronicle_.note_state(moment(), running() ? "started" : "started, paused");
  follow_parameters();
  answer(command, Outcome::applied);
}

void World::do_command(const Command& command, const PauseCommand&) {
  if (state_ == WorldState::failed) {
    return answer(command, Outcome::wrong_state, world_has_failed);
  }
  if (running()) {
    state_ = WorldState::paused;
    chronicle_.note_command(moment(), command, "pause");
    chronicle_.note_state(moment(), "paused");
    drop_goal("the world was paused");
  }
  answer(command, Outcome::applied);
}

void World::do_command(const Command& command, const ResumeCommand&) {
  if (state_ == WorldState::failed) {
    return answer(command, Outcome::wrong_state, world_has_failed);
  }
  if (state_ == WorldState::finished) {
    return answer(command, Outcome::wrong_state,
                  "the world has reached its end; reset it, or go on with step or run_until");
  }
  if (!running()) {
    state_ = WorldState::running;
    chronicle_.note_command(moment(), command, "resume");
    chronicle_.note_state(moment(), "resumed");
  }
  answer(command, Outcome::applied);
}

void World::do_command(const Command& command, const StepCommand& step) {
  if (running()) return answer(command, Outcome::wrong_state, "the world is running; pause it first");
  if (state_ == WorldState::failed) {
    return answer(command, Outcome::wrong_state, world_has_failed);
  }
  if (step.count < 1 || static_cast<double>(step.count) > most_steps) {
    return answer(command, Outcome::rejected, "the number of steps must be from 1 to 10^15");
  }
  const std::int64_t now = simulation().state().step;
  const std::string count = std::to_string(step.count) + (step.count == 1 ? " step" : " steps");
  begin_goal(command, now + static_cast<std::int64_t>(step.count), count);
}

void World::do_command(const Command& command, const RunUntilCommand& run_until) {
  if (state_ == WorldState::failed) {
    return answer(command, Outcome::wrong_state, world_has_failed);
  }
  if (!(run_until.time >= 0.0 && run_until.time / simulation().settings().time.step < most_steps)) {
    return answer(command, Outcome::rejected, "a time from 0 s on, within 10^15 steps, is needed");
  }
  const std::int64_t target = simulation().step_at(run_until.time);
  const std::int64_t now = simulation().state().step;
  if (target < now) {
    return answer(command, Outcome::rejected,
                  "the world is at " + number_text(simulation().state().time) + " s already, past " +
                      number_text(run_until.time) + " s; reset it first");
  }
  begin_goal(command, target, "run until " + number_text(run_until.time) + " s");
}

void World::do_command(const Command& command, const LoadCommand& load) {
  if (!options_.load_scene) return answer(command, Outcome::unsupported, "this server has no folder of scenes");
  auto scene = options_.load_scene(load.name);
  if (!scene) return answer(command, Outcome::rejected, scene.error().message);
  interrupt_goal("another scene was loaded");
  const auto loaded = std::make_shared<const Scene>(std::move(scene).value());
  parameters_.follow(*loaded->simulation);
  scene_ = loaded;
  ++topology_revision_;
  begin_again();
  chronicle_.note_command(moment(), command, "load " + load.name);
  chronicle_.note_state(moment(), running() ? "started" : "started, paused");
  follow_parameters();
  answer(command, Outcome::applied);
}

void World::do_command(const Command& command, const SaveCommand& save) {
  const auto path = checkpoints_.save(save.name, simulation().save());
  if (!path) return answer(command, Outcome::rejected, path.error().message);
  chronicle_.note_command(moment(), command, "save " + save.name + ": " + path.value().string());
  answer(command, Outcome::applied);
}

void World::do_command(const Command& command, const RestoreCommand& restore) {
  const auto checkpoint = checkpoints_.load(restore.name);
  if (!checkpoint) return answer(command, Outcome::rejected, checkpoint.error().message);
  const std::int64_t left = simulation().state().step;
  if (auto restored = scene_->simulation->restore(checkpoint.value()); !restored) {
    return answer(command, Outcome::rejected, "checkpoint '" + restore.name + "': " + restored.error().message);
  }
  const WorldState before = state_;
  interrupt_goal("a checkpoint was restored");
  if (!running()) state_ = WorldState::paused;
  end_step_ = find_end_step();
  if (at_end()) end_step_.reset();  // it lies behind
  make_frame_due();
  chronicle_.note_command(moment(), command, "restore " + restore.name + ", from step " + std::to_string(left),
                          {{"left_step", left}});
  if (state_ != before) chronicle_.note_state(moment(), "paused");
  follow_parameters();
  answer(command, Outcome::applied);
}

void World::do_command(const Command& command, const GrabCommand& grab) {
  if (auto grabbed = scene_->simulation->grab(grab.particle, grab.target, grab.stiffness); !grabbed) {
    return answer(command, Outcome::rejected, grabbed.error().message);
  }
  const auto& grabs = simulation().grabs();
  const auto found =
      std::find_if(grabs.begin(), grabs.end(), [&](const Grab& g) { return g.particle == grab.particle; });
  Command in_force = command;
  in_force.body = GrabCommand{grab.particle, found->target, found->stiffness};
  chronicle_.note_command(moment(), in_force,
                          "grab " + std::to_string(grab.particle) + " towards " + to_text(found->target) + " m with " +
                              number_text(found->stiffness) + " N/m");
  // A stiffness that was not chosen for it may be too much for the step; where the target is does not matter.
  if (grab.stiffness > 0.0) note_new_warnings();
  answer(command, Outcome::applied);
}

void World::do_command(const Command& command, const ReleaseCommand& release) {
  if (auto released = scene_->simulation->release(release.particle); !released) {
    return answer(command, Outcome::rejected, released.error().message);
  }
  chronicle_.note_command(moment(), command, "release " + std::to_string(release.particle));
  note_new_warnings();
  answer(command, Outcome::applied);
}

void World::do_command(const Command& command, const StatusCommand&) {
  answer(command, Outcome::applied);
}

void World::do_command(const Command& command, const MalformedCommand& malformed) {
  answer(command, Outcome::rejected, malformed.reason);
}

}  // namespace flexcast::server
