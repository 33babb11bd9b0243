#include "server/chronicle.h"

namespace flexcast::server {

void Chronicle::begin_run(RunStarted run) {
  run_id_ = run.run_id;
  next_index_ = 0;
  notices_.emplace_back(std::move(run));
}

Event Chronicle::make_event(const Moment& moment, EventKind kind, std::string text) {
  Event event;
  event.run_id = run_id_;
  event.index = next_index_++;
  event.step = moment.step;
  event.time = moment.time;
  event.kind = kind;
  event.state = moment.state;
  event.parameter_revision = moment.parameter_revision;
  event.text = std::move(text);
  return event;
}

void Chronicle::note_command(const Moment& moment, const Command& command, std::string text,
                             std::vector<ParameterAssignment> values) {
  Event event = make_event(moment, EventKind::command, std::move(text));
  event.key = command.key;
  event.command = command.kind;
  event.values = std::move(values);
  if (const auto* reset = std::get_if<ResetCommand>(&command.body)) event.keep_parameters = reset->keep_parameters;
  notices_.emplace_back(std::move(event));
}

void Chronicle::note_state(const Moment& moment, std::string text) {
  notices_.emplace_back(make_event(moment, EventKind::state, std::move(text)));
}

void Chronicle::note_warning(const Moment& moment, std::string text) {
  notices_.emplace_back(make_event(moment, EventKind::warning, std::move(text)));
}

}  // namespace flexcast::server
