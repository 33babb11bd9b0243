#include "idl/wire/names.h"

#include <array>
#include <span>

namespace flexcast::wire {
namespace {

std::string_view pick(std::span<const std::string_view> names, std::size_t i) {
  return i < names.size() ? names[i] : "unknown";
}

constexpr std::array<std::string_view, 5> value_kinds{"number", "integer", "vector", "choice", "boolean"};
constexpr std::array<std::string_view, 4> world_states{"running", "paused", "finished", "failed"};
constexpr std::array<std::string_view, 14> command_kinds{"set",     "get",  "describe",  "reset", "pause",
                                                         "resume",  "step", "run_until", "load",  "save",
                                                         "restore", "grab", "release",   "status"};
constexpr std::array<std::string_view, 5> outcomes{"applied", "rejected", "unsupported", "wrong_state", "expired"};
constexpr std::array<std::string_view, 4> event_kinds{"command", "state", "choice", "warning"};
constexpr std::array<std::string_view, 5> recorder_states{"waiting", "recording", "paused", "finished", "failed"};
constexpr std::array<std::string_view, 4> recorder_commands{"start", "pause", "stop", "status"};

}  // namespace

std::string_view name_of(flexcast_ValueKind kind) {
  return pick(value_kinds, kind);
}
std::string_view name_of(flexcast_WorldState state) {
  return pick(world_states, state);
}
std::string_view name_of(flexcast_CommandKind kind) {
  return pick(command_kinds, kind);
}
std::string_view name_of(flexcast_ReplyOutcome outcome) {
  return pick(outcomes, outcome);
}
std::string_view name_of(flexcast_EventKind kind) {
  return pick(event_kinds, kind);
}
std::string_view name_of(flexcast_RecorderState state) {
  return pick(recorder_states, state);
}
std::string_view name_of(flexcast_RecorderCommandKind kind) {
  return pick(recorder_commands, kind);
}

}  // namespace flexcast::wire
