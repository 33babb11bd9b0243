// Values and step reports as JSON. Numbers that are not finite become null when printed.
#pragma once

#include <nlohmann/json.hpp>

#include "clients/client/value.h"

namespace flexcast::client {

using Json = nlohmann::ordered_json;

Json to_json(const Value& value);
Json to_json(const flexcast_StepReport& report);

}  // namespace flexcast::client
