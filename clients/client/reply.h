// What the server answers to a command.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "clients/client/value.h"

namespace flexcast::client {

struct Reply {
  flexcast_CommandKind kind = flexcast_COMMAND_STATUS;
  flexcast_ReplyOutcome outcome = flexcast_OUTCOME_REJECTED;
  std::string reason{};  // "" when applied
  std::uint64_t run_id = 0;
  std::uint64_t applied_step = 0;                      // the command acted between this step and the next
  double time = 0;                                     // s, of applied_step
  flexcast_WorldState state = flexcast_WORLD_RUNNING;  // after the effect
  std::uint64_t parameter_revision = 0;
  std::vector<Parameter> values{};        // now in force: of set and get
  std::vector<Descriptor> descriptors{};  // of describe
  flexcast_StepReport report{};           // of status and step

  bool applied() const { return outcome == flexcast_OUTCOME_APPLIED; }

  // The value of that name among `values`; null: not there.
  const Value* find(std::string_view name) const;
};

Reply from_wire(const flexcast_Reply& reply);

}  // namespace flexcast::client
