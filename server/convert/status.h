// Status and step reports for the network.
#pragma once

#include <string_view>

#include "idl/wire/owned.h"
#include "server/convert/status_types.h"

namespace flexcast::server {

// Who publishes.
struct ServerIdentity {
  std::string_view world;
  std::uint64_t server_id = 0;
};

// What is absent or not finite becomes NaN: "not computed".
flexcast_StepReport to_wire(const MeasuredReport& measured);

wire::Owned<flexcast_Status> to_wire(const WorldStatus& status, const DeliveryStatus& delivery,
                                     const ServerIdentity& identity);

}  // namespace flexcast::server
