#include "clients/verify/recorded_event.h"

namespace flexcast::verify {

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

bool is_failure(const Event& event) {
  return event.kind == EventKind::state && event.state == WorldState::failed;
}

std::optional<std::int64_t> find_place(const Event& event) {
  const bool restores = event.kind == EventKind::command && event.command == server::CommandKind::restore;
  return restores ? find_integer(event, "left_step") : event.step;
}

}  // namespace flexcast::verify
