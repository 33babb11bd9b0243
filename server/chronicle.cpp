#include "server/chronicle.h"

namespace flexcast::server {
namespace {

void describe(const ResetCommand& reset, Event& event) {
  event.keep_parameters = reset.keep_parameters;
}
void describe(const LoadCommand& load, Event& event) {
  event.name = load.name;
}
void describe(const SaveCommand& save, Event& event) {
  event.name = save.name;
}
void describe(const RestoreCommand& restore, Event& event) {
  event.name = restore.name;
}
void describe(const GrabCommand& grab, Event& event) {
  event.particle = grab.particle;
  event.target = grab.target;
  event.stiffness = grab.stiffness;
}
void describe(const ReleaseCommand& release, Event& event) {
  event.particle = release.particle;
}
template <class Other>
void describe(const Other&, Event&) {}

}  // namespace

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
  std::visit([&](const auto& body) { describe(body, event); }, command.body);
  notices_.emplace_back(std::move(event));
}

void Chronicle::note_state(const Moment& moment, std::string text) {
  notices_.emplace_back(make_event(moment, EventKind::state, std::move(text)));
}

void Chronicle::note_choice(const Moment& moment, std::string text, std::vector<ParameterAssignment> values) {
  Event event = make_event(moment, EventKind::choice, std::move(text));
  event.values = std::move(values);
  notices_.emplace_back(std::move(event));
}

void Chronicle::note_warning(const Moment& moment, std::string text) {
  notices_.emplace_back(make_event(moment, EventKind::warning, std::move(text)));
}

}  // namespace flexcast::server
