// Our enumerations and the contract's have the same order.
#pragma once

#include <cstdint>
#include <cstring>

#include "idl/wire/types.h"
#include "server/convert/command_types.h"
#include "server/convert/notice_types.h"

namespace flexcast::server {

// What a message says, also where it is none of the enumerators: such a value must not be read as the enumeration.
template <class Enum>
std::uint32_t number_of(const Enum& enumerator) {
  static_assert(sizeof(Enum) == sizeof(std::uint32_t));
  std::uint32_t number = 0;
  std::memcpy(&number, &enumerator, sizeof number);
  return number;
}

inline flexcast_WorldState to_wire(WorldState state) {
  return static_cast<flexcast_WorldState>(state);
}
inline flexcast_CommandKind to_wire(CommandKind kind) {
  return static_cast<flexcast_CommandKind>(kind);
}
inline flexcast_ReplyOutcome to_wire(Outcome outcome) {
  return static_cast<flexcast_ReplyOutcome>(outcome);
}
inline flexcast_EventKind to_wire(EventKind kind) {
  return static_cast<flexcast_EventKind>(kind);
}
inline flexcast_ValueKind to_wire(ParameterKind kind) {
  return static_cast<flexcast_ValueKind>(kind);
}

static_assert(static_cast<int>(WorldState::running) == flexcast_WORLD_RUNNING);
static_assert(static_cast<int>(WorldState::failed) == flexcast_WORLD_FAILED);
static_assert(static_cast<int>(CommandKind::set) == flexcast_COMMAND_SET);
static_assert(static_cast<int>(CommandKind::run_until) == flexcast_COMMAND_RUN_UNTIL);
static_assert(static_cast<int>(CommandKind::status) == flexcast_COMMAND_STATUS);
static_assert(static_cast<int>(Outcome::applied) == flexcast_OUTCOME_APPLIED);
static_assert(static_cast<int>(Outcome::expired) == flexcast_OUTCOME_EXPIRED);
static_assert(static_cast<int>(EventKind::command) == flexcast_EVENT_COMMAND);
static_assert(static_cast<int>(EventKind::warning) == flexcast_EVENT_WARNING);
static_assert(static_cast<int>(ParameterKind::number) == flexcast_VALUE_NUMBER);
static_assert(static_cast<int>(ParameterKind::choice) == flexcast_VALUE_CHOICE);

}  // namespace flexcast::server
