#include "server/world.h"

#include <algorithm>
#include <utility>

#include "core/base/checks.h"

namespace flexcast::server {

World::World(Simulation& simulation, const WorldOptions& options, RunIds& run_ids)
    : simulation_(simulation), options_(options), run_ids_(run_ids), parameters_(simulation, options.rate) {
  state_ = options_.paused ? WorldState::paused : WorldState::running;
  begin_run();
  chronicle_.note_state(moment(), options_.paused ? "started, paused" : "started");
  follow_parameters();
}

// ---------------------------------------------------------------- stepping

double World::next_time() const {
  return simulation_.state().time + simulation_.settings().time.step;
}

void World::take_step() {
  FLEXCAST_CHECK(running());
  if (arrived()) return;  // nothing left to do: settle() ends it
  if (!simulation_.step()) return fail();
  if (simulation_.state().step % std::max(1, simulation_.settings().stream.every) == 0) make_frame_due();
}

void World::settle(double wall_seconds) {
  wall_seconds_ = wall_seconds;
  if (!running() || !arrived()) return;
  if (at_end()) {
    end_step_.reset();
    change_state(WorldState::finished, "reached the end it was given");
  } else {
    change_state(WorldState::paused, "arrived");
  }
  if (!goal_) return;
  const Goal goal = *std::exchange(goal_, std::nullopt);
  answer(goal.command, Outcome::applied);
}

void World::fail() {
  const std::string text = simulation_.failure() ? simulation_.failure()->text() : "the step could not be taken";
  change_state(WorldState::failed, text);
  drop_goal("the world failed: " + text);
}

void World::close() {
  drop_goal("the server is ending");
}

// ---------------------------------------------------------------- runs, goals, states

void World::begin_run() {
  chronicle_.begin_run({run_ids_.next(), 1, simulation_.settings().time.step, simulation_.settings().stream});
  next_frame_ = 0;
  wall_seconds_ = 0.0;
  end_step_ = find_end_step();
  format_ = make_stream_format(simulation_.settings().stream);
  warnings_.clear();
  make_frame_due();
}

void World::begin_goal(const Command& command, std::int64_t step, const std::string& text) {
  drop_goal("replaced by a newer request");
  goal_ = Goal{command, step};
  const bool stood = !running();
  state_ = WorldState::running;
  chronicle_.note_command(moment(), command, text);
  if (stood) chronicle_.note_state(moment(), "running");
}

std::optional<std::int64_t> World::find_end_step() const {
  constexpr double never = 1e15;  // steps: too far to be counted
  if (!options_.until || *options_.until / simulation_.settings().time.step > never) return std::nullopt;
  return simulation_.step_at(*options_.until);
}

bool World::arrived() const {
  return goal_ ? simulation_.state().step >= goal_->step : at_end();
}

void World::drop_goal(const std::string& reason) {
  if (!goal_) return;
  const Goal goal = *std::exchange(goal_, std::nullopt);
  answer(goal.command, Outcome::wrong_state,
         "ended at step " + std::to_string(simulation_.state().step) + ", before step " + std::to_string(goal.step) +
             ": " + reason);
}

void World::change_state(WorldState state, const std::string& text) {
  if (state == state_) return;
  state_ = state;
  chronicle_.note_state(moment(), text);
}

// What depends on the parameters, after they may have changed.
void World::follow_parameters() {
  if (end_step_) end_step_ = find_end_step();
  if (goal_) {
    if (const auto* run = std::get_if<RunUntilCommand>(&goal_->command.body)) {
      goal_->step = simulation_.step_at(run->time);
    }
  }
  format_ = make_stream_format(simulation_.settings().stream);
  if (due_frame_) {
    due_frame_->format = format_;
    due_frame_->parameter_revision = parameters_.revision();
  }
  auto warnings = simulation_.calc_warnings();
  for (const auto& warning : warnings) {
    if (std::find(warnings_.begin(), warnings_.end(), warning) == warnings_.end()) {
      chronicle_.note_warning(moment(), warning);
    }
  }
  warnings_ = std::move(warnings);
  chronicle_.note_parameters(
      {run_id(), simulation_.state().step, parameters_.revision(), parameters_.descriptors(), parameters_.values()});
}

void World::make_frame_due() {
  due_frame_ = FrameHeader{
      run_id(), next_frame_++, simulation_.state().step, simulation_.state().time, parameters_.revision(), 1, format_};
}

std::optional<FrameHeader> World::take_due_frame() {
  return std::exchange(due_frame_, std::nullopt);
}

// ---------------------------------------------------------------- what is known

Moment World::moment() const {
  return {simulation_.state().step, simulation_.state().time, state_, parameters_.revision()};
}

MeasuredReport World::calc_measured_report() const {
  return {simulation_.calc_report(), wall_seconds_, simulation_.settings().time.substeps};
}

WorldStatus World::calc_status() const {
  WorldStatus status;
  status.run_id = run_id();
  status.state = state_;
  status.report = calc_measured_report();
  status.rate = parameters_.rate();
  status.parameter_revision = parameters_.revision();
  status.failure = simulation_.failure();
  status.warnings = warnings_;
  for (const auto& probe : simulation_.probes()) {
    status.probes.push_back({probe.name, block3(simulation_.state().positions, probe.particle),
                             block3(simulation_.state().velocities, probe.particle)});
  }
  return status;
}

Reply World::make_reply(const Command& command, Outcome outcome, std::string reason) const {
  Reply reply;
  reply.key = command.key;
  reply.kind = command.kind;
  reply.outcome = outcome;
  reply.reason = std::move(reason);
  reply.run_id = run_id();
  reply.applied_step = simulation_.state().step;
  reply.time = simulation_.state().time;
  reply.state = state_;
  reply.parameter_revision = parameters_.revision();
  if (command.kind == CommandKind::step || command.kind == CommandKind::status) reply.report = calc_measured_report();
  return reply;
}

void World::answer(const Command& command, Outcome outcome, std::string reason) {
  replies_.push_back(make_reply(command, outcome, std::move(reason)));
}

}  // namespace flexcast::server
