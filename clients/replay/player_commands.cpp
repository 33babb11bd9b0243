// What each command does to a replay: one function a command.
#include <utility>

#include "clients/replay/player.h"
#include "idl/wire/names.h"

namespace flexcast::replay {

void Player::take_commands(Clock::time_point now) {
  for (Command& command : desk_.take()) execute(std::move(command), now);
}

void Player::execute(Command command, Clock::time_point now) {
  const flexcast_Command& c = *command;
  if (c.check_revision && c.expected_revision != shown_.parameter_revision) {
    return answer(c, flexcast_OUTCOME_REJECTED,
                  "parameter revision " + std::to_string(shown_.parameter_revision) + " is in force, not " +
                      std::to_string(c.expected_revision));
  }
  switch (c.kind) {
    case flexcast_COMMAND_SET:
      return set(c, now);
    case flexcast_COMMAND_GET:
      return get(c);
    case flexcast_COMMAND_DESCRIBE:
      return describe(c);
    case flexcast_COMMAND_RESET:
      return reset(c, now);
    case flexcast_COMMAND_PAUSE:
      return pause(c);
    case flexcast_COMMAND_RESUME:
      return resume(c);
    case flexcast_COMMAND_STEP:
      return step(std::move(command));
    case flexcast_COMMAND_RUN_UNTIL:
      return run_until(std::move(command));
    case flexcast_COMMAND_STATUS:
      return answer(c);
    default:
      return answer(c, flexcast_OUTCOME_UNSUPPORTED,
                    std::string(wire::name_of(c.kind)) + " is not for a replay: nothing is simulated here");
  }
}

// ---------------------------------------------------------------- parameters

void Player::set(const flexcast_Command& command, Clock::time_point now) {
  const auto change = parse_change(wire::elements(command.values), dials());
  if (!change) return answer(command, flexcast_OUTCOME_REJECTED, change.error().message);
  const Change& wanted = change.value();
  if (wanted.loop) settings_.loop = *wanted.loop;
  if (wanted.rate) set_rate(*wanted.rate);
  if (wanted.time) seek(*wanted.time, now);
  get(command);
}

// Of set, too: the values of what was set are those now in force.
void Player::get(const flexcast_Command& command) {
  std::vector<std::string> names;
  for (const auto& value : wire::elements(command.values)) names.emplace_back(wire::text(value.name));
  const auto values = values_of(dials(), names);
  if (!values) return answer(command, flexcast_OUTCOME_REJECTED, values.error().message);
  Reply reply = make_reply(command, flexcast_OUTCOME_APPLIED, "");
  const auto slots = wire::resize(reply->values, values.value().size());
  for (std::size_t i = 0; i < slots.size(); ++i) client::to_wire(slots[i], values.value()[i]);
  desk_.answer(std::move(reply));
}

void Player::describe(const flexcast_Command& command) {
  const auto values = values_of(dials(), {});
  Reply reply = make_reply(command, flexcast_OUTCOME_APPLIED, "");
  const auto slots = wire::resize(reply->values, values.value().size());
  for (std::size_t i = 0; i < slots.size(); ++i) client::to_wire(slots[i], values.value()[i]);
  fill_descriptors(reply->descriptors, dials());
  desk_.answer(std::move(reply));
}

Dials Player::dials() const {
  const Clip& clip = tape_.clips()[tape_.played_clip()];
  const auto frames = tape_.index().frames();
  return {settings_, options_.settings, shown_.time, frames[clip.begin].time, frames[clip.end - 1].time};
}

void Player::set_rate(double rate) {
  settings_.rate = rate;
  pacer_.set_rate(rate);
}

void Player::seek(double time, Clock::time_point now) {
  const std::size_t clip = tape_.played_clip();
  const auto frames = tape_.index().frames();
  std::size_t frame = tape_.clips()[clip].begin;
  while (frame + 1 < tape_.clips()[clip].end && !has_reached(frames[frame].time, time)) ++frame;
  interrupt_goal("replay.time was set");
  if (state_ == flexcast_WORLD_FINISHED) state_ = flexcast_WORLD_PAUSED;
  jump(clip, frame, now);
  settle();
}

// ---------------------------------------------------------------- the course of time

void Player::reset(const flexcast_Command& command, Clock::time_point now) {
  interrupt_goal("the replay was reset");
  if (!command.keep_parameters) {
    settings_.loop = options_.settings.loop;
    set_rate(options_.settings.rate);
  }
  if (state_ == flexcast_WORLD_FINISHED) state_ = options_.paused ? flexcast_WORLD_PAUSED : flexcast_WORLD_RUNNING;
  jump(0, tape_.clips().front().begin, now);
  answer(command);
  settle();
}

void Player::pause(const flexcast_Command& command) {
  if (running()) {
    state_ = flexcast_WORLD_PAUSED;
    publish_status(false);
    drop_goal("the replay was paused");
  }
  answer(command);
}

void Player::resume(const flexcast_Command& command) {
  if (state_ == flexcast_WORLD_FINISHED && !settings_.loop) {
    return answer(command, flexcast_OUTCOME_WRONG_STATE,
                  "the replay has reached its end; reset it, or set replay.time");
  }
  if (!running()) {
    state_ = flexcast_WORLD_RUNNING;
    pacer_.restart();
    publish_status(false);
  }
  answer(command);
}

void Player::step(Command command) {
  if (running()) return answer(*command, flexcast_OUTCOME_WRONG_STATE, "the replay is running; pause it first");
  if (command->count < 1) return answer(*command, flexcast_OUTCOME_REJECTED, "the number of frames must be from 1 on");
  if (tape_.at_end() && !settings_.loop) {
    return answer(*command, flexcast_OUTCOME_WRONG_STATE,
                  "the replay has reached its end; reset it, or set replay.time");
  }
  const std::uint64_t count = command->count;
  begin_goal({std::move(command), count, std::nullopt});
}

void Player::run_until(Command command) {
  const double time = command->time;
  const Dials now = dials();
  if (!(time >= 0.0) || !has_reached(now.last_time, time)) {
    return answer(*command, flexcast_OUTCOME_REJECTED,
                  "this run is there from " + client::to_text(now.first_time) + " s to " +
                      client::to_text(now.last_time) + " s, not until " + client::to_text(time) + " s");
  }
  if (has_reached(shown_.time, time) && !has_reached(time, shown_.time)) {
    return answer(*command, flexcast_OUTCOME_REJECTED,
                  "the replay is at " + client::to_text(shown_.time) + " s already, past " + client::to_text(time) +
                      " s; reset it, or set replay.time");
  }
  begin_goal({std::move(command), 0, time});
}

void Player::begin_goal(Goal goal) {
  drop_goal("replaced by a newer request");
  goal_ = std::move(goal);
  if (!running()) pacer_.restart();
  state_ = flexcast_WORLD_RUNNING;
  settle();
}

void Player::drop_goal(const std::string& reason) {
  if (!goal_) return;
  const Goal goal = std::move(*std::exchange(goal_, std::nullopt));
  answer(*goal.command, flexcast_OUTCOME_WRONG_STATE, "the goal was not reached: " + reason);
}

// The replay ran for its goal only.
void Player::interrupt_goal(const std::string& reason) {
  if (goal_) state_ = flexcast_WORLD_PAUSED;
  drop_goal(reason);
}

// ---------------------------------------------------------------- replies

Reply Player::make_reply(const flexcast_Command& command, flexcast_ReplyOutcome outcome,
                         const std::string& reason) const {
  Reply reply;
  wire::set_string(reply->world, options_.world);
  wire::set_string(reply->client_id, wire::text(command.client_id));
  reply->request_id = command.request_id;
  reply->kind = command.kind;
  reply->outcome = outcome;
  wire::set_string(reply->reason, reason);
  reply->run_id = shown_.run_id;
  reply->applied_step = shown_.step;
  reply->time = shown_.time;
  reply->state = state_;
  reply->parameter_revision = shown_.parameter_revision;
  if (command.kind == flexcast_COMMAND_STEP || command.kind == flexcast_COMMAND_STATUS) {
    reply->report = make_status(false)->report;
  }
  return reply;
}

void Player::answer(const flexcast_Command& command, flexcast_ReplyOutcome outcome, const std::string& reason) {
  desk_.answer(make_reply(command, outcome, reason));
}

}  // namespace flexcast::replay
