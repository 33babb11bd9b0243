#include "clients/client/reply.h"

#include "idl/wire/fill.h"

namespace flexcast::client {

const Value* Reply::find(std::string_view name) const {
  for (const Parameter& parameter : values)
    if (parameter.name == name) return &parameter.value;
  return nullptr;
}

Reply from_wire(const flexcast_Reply& reply) {
  Reply result{.kind = reply.kind,
               .outcome = reply.outcome,
               .reason = std::string(wire::text(reply.reason)),
               .run_id = reply.run_id,
               .applied_step = reply.applied_step,
               .time = reply.time,
               .state = reply.state,
               .parameter_revision = reply.parameter_revision,
               .report = reply.report};
  for (const auto& value : wire::elements(reply.values)) result.values.push_back(from_wire(value));
  for (const auto& descriptor : wire::elements(reply.descriptors)) result.descriptors.push_back(from_wire(descriptor));
  return result;
}

}  // namespace flexcast::client
