// What flexcast-ctl prints with --json. Numbers that are not finite become null.
#pragma once

#include "clients/client/json.h"
#include "clients/client/reply.h"
#include "idl/wire/world_watch.h"

namespace flexcast::ctl {

using client::Json;
using client::to_json;

// {"outcome": "applied", "applied_step": 12, "time": 0.012, "values": {NAME: VALUE}, ...}; "reason" unless applied,
// "descriptors" and "report" where the kind of command has them.
Json to_json(const client::Reply& reply, const std::string& world);
Json to_json(const flexcast_Status& status);

}  // namespace flexcast::ctl
