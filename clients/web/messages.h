// What the bridge says to clients: JSON texts, and the heads of binary messages.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clients/client/value.h"
#include "clients/web/catalog.h"
#include "clients/web/line.h"
#include "clients/web/sample.h"

namespace flexcast::web {

enum class Level { info = 0, warning = 1, error = 2 };

Outgoing server_info_message(const std::string& session, const std::string& world);
Outgoing status_message(Level level, const std::string& text, const std::string& id = "");
Outgoing remove_status_message(const std::string& id);
Outgoing advertise_message(std::span<const Channel* const> channels);
Outgoing unadvertise_message(std::span<const std::uint32_t> channels);
Outgoing advertise_services_message(std::span<const ServiceEntry* const> services);
Outgoing unadvertise_services_message(std::span<const std::uint32_t> services);
// The names are full ones, with the prefix of their world.
Outgoing parameter_values_message(const std::vector<client::Parameter>& values, const std::optional<std::string>& id);
Outgoing service_failure_message(std::uint32_t service, std::uint32_t call, const std::string& text);
Outgoing service_response_message(std::uint32_t service, std::uint32_t call, const std::string& json);
Outgoing data_message(std::uint32_t subscription, const Sample& sample);
Outgoing time_message(std::int64_t time);

}  // namespace flexcast::web
