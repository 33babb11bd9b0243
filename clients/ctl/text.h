// What flexcast-ctl prints for people.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "clients/client/reply.h"
#include "idl/wire/types.h"

namespace flexcast::ctl {

std::string worlds_table(std::span<const flexcast_Status* const> statuses);
std::string descriptors_table(const client::Reply& reply);
std::string values_table(std::span<const client::Parameter> values);
std::string outcome_line(const client::Reply& reply);  // "applied at step 12 (0.012 s): paused"
std::string status_text(const flexcast_Status& status, std::string_view health);
std::string status_line(const flexcast_Status& status);  // of --watch

std::string rate_text(double rate);                             // "max", "realtime", "2x"
std::string number_text(double number, const char* unit = "");  // "-" for NaN: a scheme does not have it

}  // namespace flexcast::ctl
