#include "server/world.h"

#include <algorithm>
#include <utility>

#include "core/base/checks.h"

namespace flexcast::server {

World::World(Scene scene, const WorldOptions& options, RunIds& run_ids)
    : scene_(std::make_shared<const Scene>(std::move(scene))),
      options_(options),
      run_ids_(run_ids),
      checkpoints_(options.checkpoints),
      parameters_(*scene_->simulation, options.rate) {
  state_ = options_.paused ? WorldState::paused : WorldState::running;
  begin_run();
  chronicle_.note_state(moment(), options_.paused ? "started, paused" : "started");
  follow_parameters();
}

// ---------------------------------------------------------------- stepping

double World::next_time() const {
  return simulation().state().time + simulation().settings().time.step;
}

void World::take_step() {
  FLEXCAST_CHECK(running());
  if (arrived()) return;  // nothing left to do: settle() ends it
  const Moment start = moment();
  stepped_ = scene_->simulation->step();
  if (!stepped_) return fail();
  note_choice(start);
  if (simulation().state().step % std::max(1, simulation().settings().stream.every) == 0) make_frame_due();
}

void World::settle(double wall_seconds) {
  wall_seconds_ = wall_seconds;
  if (std::exchange(stepped_, false)) follow_budget();
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

// What the next steps are taken with, by the time that the last ones took.
void World::follow_budget() {
  const bool kept = budget_.warning().empty();
  scene_->simulation->choose(budget_.follow(simulation(), wall_seconds_));
  note_choice(moment());
  if (kept != budget_.warning().empty()) note_new_warnings();
}

// A contract's choice that differs from its last one, in force from the given moment on.
void World::note_choice(const Moment& from) {
  const TimeChoice choice = simulation().choice();
  if (!simulation().has_contract() || choice == noted_choice_) return;
  noted_choice_ = choice;
  const bool by_time = simulation().settings().time.budget > 0.0;
  std::string text = std::string(by_time ? "time.budget" : "time.tolerance") + " chose " +
                     std::to_string(choice.substeps) + (choice.substeps == 1 ? " substep" : " substeps");
  std::vector<ParameterAssignment> values = {{"time.substeps", std::int64_t{choice.substeps}}};
  if (choice.iterations > 0) {
    text += " of " + std::to_string(choice.iterations) + (choice.iterations == 1 ? " iteration" : " iterations");
    values.push_back({"solver.iterations", std::int64_t{choice.iterations}});
  }
  chronicle_.note_choice(from, std::move(text), std::move(values));
  if (choice.substeps >= ToleranceControl::most_substeps) note_new_warnings();
}

void World::fail() {
  const std::string text = simulation().failure() ? simulation().failure()->text() : "the step could not be taken";
  change_state(WorldState::failed, text);
  drop_goal("the world failed: " + text);
}

void World::close() {
  drop_goal("the server is ending");
}

// ---------------------------------------------------------------- runs, goals, states

void World::begin_run() {
  chronicle_.begin_run(
      {run_ids_.next(), topology_revision_, simulation().settings().time.step, simulation().settings().stream, scene_});
  next_frame_ = 0;
  noted_choice_ = {.substeps = 0, .iterations = 0};
  wall_seconds_ = 0.0;
  end_step_ = find_end_step();
  format_ = make_stream_format(simulation().settings().stream);
  warnings_.clear();
  make_frame_due();
}

// After a reset or a load.
void World::begin_again() {
  if (state_ == WorldState::finished || state_ == WorldState::failed) {
    state_ = options_.paused ? WorldState::paused : WorldState::running;
  }
  begin_run();
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
  if (!options_.until || *options_.until / simulation().settings().time.step > never) return std::nullopt;
  return simulation().step_at(*options_.until);
}

bool World::arrived() const {
  return goal_ ? simulation().state().step >= goal_->step : at_end();
}

void World::drop_goal(const std::string& reason) {
  if (!goal_) return;
  const Goal goal = *std::exchange(goal_, std::nullopt);
  answer(goal.command, Outcome::wrong_state, "step " + std::to_string(goal.step) + " was not reached: " + reason);
}

// The world ran for its goal only.
void World::interrupt_goal(const std::string& reason) {
  if (goal_) state_ = WorldState::paused;
  drop_goal(reason);
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
      goal_->step = simulation().step_at(run->time);
    }
  }
  format_ = make_stream_format(simulation().settings().stream);
  if (due_frame_) {
    due_frame_->format = format_;
    due_frame_->parameter_revision = parameters_.revision();
  }
  budget_.begin();
  note_choice(moment());
  note_new_warnings();
  chronicle_.note_parameters(
      {run_id(), simulation().state().step, parameters_.revision(), parameters_.descriptors(), parameters_.values()});
}

void World::note_new_warnings() {
  auto warnings = simulation().calc_warnings();
  if (!budget_.warning().empty()) warnings.push_back(budget_.warning());
  for (const auto& warning : warnings) {
    if (std::find(warnings_.begin(), warnings_.end(), warning) == warnings_.end()) {
      chronicle_.note_warning(moment(), warning);
    }
  }
  warnings_ = std::move(warnings);
}

void World::make_frame_due() {
  due_frame_ = FrameHeader{
      run_id(),           next_frame_++, simulation().state().step, simulation().state().time, parameters_.revision(),
      topology_revision_, format_};
}

std::optional<FrameHeader> World::take_due_frame() {
  return std::exchange(due_frame_, std::nullopt);
}

// ---------------------------------------------------------------- what is known

Moment World::moment() const {
  return {simulation().state().step, simulation().state().time, state_, parameters_.revision()};
}

MeasuredReport World::calc_measured_report() const {
  return {simulation().calc_report(), wall_seconds_};
}

WorldStatus World::calc_status() const {
  WorldStatus status;
  status.run_id = run_id();
  status.state = state_;
  status.report = calc_measured_report();
  status.rate = parameters_.rate();
  status.parameter_revision = parameters_.revision();
  status.topology_revision = topology_revision_;
  status.failure = simulation().failure();
  status.warnings = warnings_;
  for (const auto& probe : simulation().probes()) {
    status.probes.push_back({probe.name, block3(simulation().state().positions, probe.particle),
                             block3(simulation().state().velocities, probe.particle)});
  }
  status.handles = simulation().calc_handle_reports();
  return status;
}

Reply World::make_reply(const Command& command, Outcome outcome, std::string reason) const {
  Reply reply;
  reply.key = command.key;
  reply.kind = command.kind;
  reply.outcome = outcome;
  reply.reason = std::move(reason);
  reply.run_id = run_id();
  reply.applied_step = simulation().state().step;
  reply.time = simulation().state().time;
  reply.state = state_;
  reply.parameter_revision = parameters_.revision();
  if (command.kind == CommandKind::step || command.kind == CommandKind::status) reply.report = calc_measured_report();
  return reply;
}

void World::answer(const Command& command, Outcome outcome, std::string reason) {
  replies_.push_back(make_reply(command, outcome, std::move(reason)));
}

}  // namespace flexcast::server
