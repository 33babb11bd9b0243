// What each command does to a world: one function a command.

#include "server/world.h"

namespace flexcast::server {
namespace {

constexpr double most_steps = 1e15;

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
  const bool recovered = state_ == WorldState::failed && !simulation_.failure();
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
  const bool by_goal = goal_.has_value();
  const bool at_start = state_ == WorldState::finished || state_ == WorldState::failed;
  drop_goal("the world was reset");
  parameters_.reset(reset.keep_parameters);
  if (by_goal) state_ = WorldState::paused;
  if (at_start) state_ = options_.paused ? WorldState::paused : WorldState::running;
  begin_run();
  auto kept = parameters_.changed();
  chronicle_.note_command(moment(), command, kept.empty() ? "reset" : "reset, keeping " + list_text(kept),
                          std::move(kept));
  chronicle_.note_state(moment(), running() ? "started" : "started, paused");
  follow_parameters();
  answer(command, Outcome::applied);
}

void World::do_command(const Command& command, const PauseCommand&) {
  if (state_ == WorldState::failed) {
    return answer(command, Outcome::wrong_state, "the world has failed; set a parameter or reset it");
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
    return answer(command, Outcome::wrong_state, "the world has failed; set a parameter or reset it");
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
    return answer(command, Outcome::wrong_state, "the world has failed; set a parameter or reset it");
  }
  if (step.count < 1 || static_cast<double>(step.count) > most_steps) {
    return answer(command, Outcome::rejected, "the number of steps must be from 1 to 10^15");
  }
  const std::int64_t now = simulation_.state().step;
  const std::string count = std::to_string(step.count) + (step.count == 1 ? " step" : " steps");
  begin_goal(command, now + static_cast<std::int64_t>(step.count), count);
}

void World::do_command(const Command& command, const RunUntilCommand& run_until) {
  if (state_ == WorldState::failed) {
    return answer(command, Outcome::wrong_state, "the world has failed; set a parameter or reset it");
  }
  if (!(run_until.time >= 0.0 && run_until.time / simulation_.settings().time.step < most_steps)) {
    return answer(command, Outcome::rejected, "a time from 0 s on, within 10^15 steps, is needed");
  }
  const std::int64_t target = simulation_.step_at(run_until.time);
  const std::int64_t now = simulation_.state().step;
  if (target < now) {
    return answer(command, Outcome::rejected,
                  "the world is at " + number_text(simulation_.state().time) + " s already, past " +
                      number_text(run_until.time) + " s; reset it first");
  }
  begin_goal(command, target, "run until " + number_text(run_until.time) + " s");
}

void World::do_command(const Command& command, const StatusCommand&) {
  answer(command, Outcome::applied);
}

void World::do_command(const Command& command, const UnsupportedCommand&) {
  answer(command, Outcome::unsupported, "this server does not know this command yet");
}

void World::do_command(const Command& command, const MalformedCommand& malformed) {
  answer(command, Outcome::rejected, malformed.reason);
}

}  // namespace flexcast::server
