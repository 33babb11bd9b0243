#include "clients/web/messages.h"

#include "clients/client/json.h"

namespace flexcast::web {
namespace {

using client::Json;

// Texts of others may hold bytes that are no UTF-8: those are replaced.
Outgoing text_message(const Json& json) {
  return {.head = json.dump(-1, ' ', false, Json::error_handler_t::replace)};
}

template <class T>
void append(std::string& bytes, T number) {
  for (std::size_t i = 0; i < sizeof number; ++i) bytes += static_cast<char>(number >> (8 * i) & 0xff);
}

const char* type_of(const client::Value& value) {
  if (std::holds_alternative<double>(value)) return "float64";
  return std::holds_alternative<client::Vector>(value) ? "float64_array" : nullptr;
}

}  // namespace

Outgoing server_info_message(const std::string& session, const std::string& world) {
  return text_message({{"op", "serverInfo"},
                       {"name", "flexcast-web"},
                       {"capabilities", {"parameters", "parametersSubscribe", "services", "time"}},
                       {"supportedEncodings", {"json"}},
                       {"metadata", {{"version", FLEXCAST_VERSION}, {"world", world}}},
                       {"sessionId", session}});
}

Outgoing status_message(Level level, const std::string& text, const std::string& id) {
  Json json{{"op", "status"}, {"level", static_cast<int>(level)}, {"message", text}};
  if (!id.empty()) json["id"] = id;
  return text_message(json);
}

Outgoing remove_status_message(const std::string& id) {
  return text_message({{"op", "removeStatus"}, {"statusIds", Json::array({id})}});
}

Outgoing advertise_message(std::span<const Channel* const> channels) {
  Json list = Json::array();
  for (const Channel* channel : channels)
    list.push_back({{"id", channel->id},
                    {"topic", channel->topic},
                    {"encoding", "cdr"},
                    {"schemaName", channel->row->schema_name},
                    {"schema", channel->row->schema},
                    {"schemaEncoding", "omgidl"}});
  return text_message({{"op", "advertise"}, {"channels", std::move(list)}});
}

Outgoing unadvertise_message(std::span<const std::uint32_t> channels) {
  return text_message({{"op", "unadvertise"}, {"channelIds", std::vector(channels.begin(), channels.end())}});
}

Outgoing advertise_services_message(std::span<const ServiceEntry* const> services) {
  Json list = Json::array();
  for (const ServiceEntry* entry : services) {
    const std::string verb(entry->service->verb);
    const std::string request = request_schema(*entry->service), response = response_schema();
    const auto describe = [&](const std::string& part, const std::string& schema) {
      return Json{{"encoding", "json"},
                  {"schemaName", "flexcast/" + verb + part},
                  {"schemaEncoding", "jsonschema"},
                  {"schema", schema}};
    };
    list.push_back({{"id", entry->id},
                    {"name", entry->name},
                    {"type", "flexcast/" + verb},
                    {"requestSchema", request},
                    {"responseSchema", response},
                    {"request", describe("_request", request)},
                    {"response", describe("_response", response)}});
  }
  return text_message({{"op", "advertiseServices"}, {"services", std::move(list)}});
}

Outgoing unadvertise_services_message(std::span<const std::uint32_t> services) {
  return text_message({{"op", "unadvertiseServices"}, {"serviceIds", std::vector(services.begin(), services.end())}});
}

Outgoing parameter_values_message(const std::vector<client::Parameter>& values, const std::optional<std::string>& id) {
  Json list = Json::array();
  for (const auto& [name, value] : values) {
    Json parameter{{"name", name}, {"value", client::to_json(value)}};
    if (const char* type = type_of(value)) parameter["type"] = type;
    list.push_back(std::move(parameter));
  }
  Json json{{"op", "parameterValues"}, {"parameters", std::move(list)}};
  if (id) json["id"] = *id;
  return text_message(json);
}

Outgoing service_failure_message(std::uint32_t service, std::uint32_t call, const std::string& text) {
  return text_message({{"op", "serviceCallFailure"}, {"serviceId", service}, {"callId", call}, {"message", text}});
}

Outgoing service_response_message(std::uint32_t service, std::uint32_t call, const std::string& json) {
  constexpr std::string_view encoding = "json";
  Outgoing message{.is_text = false, .head = "\x03"};
  append(message.head, service);
  append(message.head, call);
  append(message.head, static_cast<std::uint32_t>(encoding.size()));
  message.head += encoding;
  message.head += json;
  return message;
}

Outgoing data_message(std::uint32_t subscription, const Sample& sample) {
  Outgoing message{.is_text = false, .head = "\x01", .body = sample.bytes};
  append(message.head, subscription);
  append(message.head, static_cast<std::uint64_t>(sample.time));
  return message;
}

Outgoing time_message(std::int64_t time) {
  Outgoing message{.is_text = false, .head = "\x02"};
  append(message.head, static_cast<std::uint64_t>(time));
  return message;
}

}  // namespace flexcast::web
