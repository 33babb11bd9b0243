// Parameters between engine and network.
#pragma once

#include <span>
#include <string_view>

#include "core/sim/parameters.h"
#include "idl/wire/fill.h"
#include "idl/wire/owned.h"
#include "server/convert/notice_types.h"

namespace flexcast::server {

// These fill zeroed structs.
void to_wire(const ParameterAssignment& value, flexcast_ParameterValue& message);
void to_wire(const ParameterDescriptor& descriptor, flexcast_ParameterDescriptor& message);

// Fills an empty sequence with the values (or descriptors).
template <class Sequence, class T>
void to_wire(std::span<const T> values, Sequence& sequence) {
  const auto slots = wire::resize(sequence, values.size());
  for (std::size_t i = 0; i < values.size(); ++i) to_wire(values[i], slots[i]);
}

// An error names the parameter and says what does not fit together; ranges are the engine's business.
Result<ParameterAssignment> from_wire(const flexcast_ParameterValue& message);

wire::Owned<flexcast_ParameterSet> to_wire(const ParametersChanged& parameters, std::string_view world);

}  // namespace flexcast::server
