#include "clients/web/client_message.h"

#include <cstring>
#include <limits>

namespace flexcast::web {
namespace {

using wire::Error;
using wire::Result;

Error bad_field(const std::string& field, const std::string& what) {
  return Error{"'" + field + "' must be " + what};
}

const Json* find(const Json& object, const char* field) {
  const auto found = object.is_object() ? object.find(field) : object.end();
  return object.is_object() && found != object.end() ? &*found : nullptr;
}

std::optional<std::uint32_t> to_u32(const Json* json) {
  if (!json || !json->is_number_unsigned()) return {};
  const auto number = json->get<std::uint64_t>();
  if (number > std::numeric_limits<std::uint32_t>::max()) return {};
  return static_cast<std::uint32_t>(number);
}

// An array, each of whose elements `read` turns into a T or nothing.
template <class T, class Read>
Result<std::vector<T>> read_array(const Json& message, const char* field, const char* what, const Read& read) {
  const Json* array = find(message, field);
  if (!array || !array->is_array()) return bad_field(field, what);
  std::vector<T> values;
  for (const Json& element : *array) {
    std::optional<T> value = read(element);
    if (!value) return bad_field(field, what);
    values.push_back(std::move(*value));
  }
  return values;
}

std::optional<std::string> to_string(const Json& json) {
  if (!json.is_string()) return {};
  return json.get<std::string>();
}

Result<std::vector<std::string>> read_names(const Json& message) {
  return read_array<std::string>(message, "parameterNames", "an array of strings", to_string);
}

Result<std::optional<std::string>> read_id(const Json& message) {
  const Json* id = find(message, "id");
  if (!id) return std::optional<std::string>();
  if (!id->is_string()) return bad_field("id", "a string");
  return std::optional(id->get<std::string>());
}

Result<ClientMessage> parse_subscribe(const Json& message) {
  auto entries = read_array<Subscribe::Entry>(
      message, "subscriptions", "an array of objects with the numbers 'id' and 'channelId'",
      [](const Json& json) -> std::optional<Subscribe::Entry> {
        const auto id = to_u32(find(json, "id")), channel = to_u32(find(json, "channelId"));
        if (!id || !channel) return {};
        return Subscribe::Entry{*id, *channel};
      });
  if (!entries) return entries.error();
  return ClientMessage(Subscribe{std::move(entries).value()});
}

Result<ClientMessage> parse_unsubscribe(const Json& message) {
  auto ids = read_array<std::uint32_t>(message, "subscriptionIds", "an array of numbers",
                                       [](const Json& json) { return to_u32(&json); });
  if (!ids) return ids.error();
  return ClientMessage(Unsubscribe{std::move(ids).value()});
}

Result<ClientMessage> parse_get(const Json& message) {
  auto names = read_names(message);
  if (!names) return names.error();
  auto id = read_id(message);
  if (!id) return id.error();
  return ClientMessage(GetParameters{std::move(names).value(), std::move(id).value()});
}

Result<ClientMessage> parse_set(const Json& message) {
  auto entries =
      read_array<SetParameters::Entry>(message, "parameters", "an array of objects with a string 'name' and a 'value'",
                                       [](const Json& json) -> std::optional<SetParameters::Entry> {
                                         const Json* name = find(json, "name");
                                         if (!name || !name->is_string()) return {};
                                         const Json* value = find(json, "value");
                                         return SetParameters::Entry{name->get<std::string>(), value ? *value : Json()};
                                       });
  if (!entries) return entries.error();
  auto id = read_id(message);
  if (!id) return id.error();
  return ClientMessage(SetParameters{std::move(entries).value(), std::move(id).value()});
}

Result<ClientMessage> parse_watch(const Json& message, bool on) {
  auto names = read_names(message);
  if (!names) return names.error();
  return ClientMessage(WatchParameters{on, std::move(names).value()});
}

Result<ClientMessage> parse_text(std::string_view text) {
  const auto json = parse_json(text);
  if (!json) return json.error();
  const Json& message = json.value();
  const Json* op = find(message, "op");
  if (!op || !op->is_string()) return Error{"a message must be a JSON object with a string 'op'"};
  const auto name = op->get<std::string>();
  if (name == "subscribe") return parse_subscribe(message);
  if (name == "unsubscribe") return parse_unsubscribe(message);
  if (name == "getParameters") return parse_get(message);
  if (name == "setParameters") return parse_set(message);
  if (name == "subscribeParameterUpdates") return parse_watch(message, true);
  if (name == "unsubscribeParameterUpdates") return parse_watch(message, false);
  return Error{"'" + name.substr(0, 40) + "' is not among the capabilities of this server"};
}

// opcode u8, service u32, call u32, length of the encoding u32, encoding, payload; little-endian
Result<ClientMessage> parse_binary(std::string_view bytes) {
  constexpr char call_service = 2;
  constexpr std::size_t head = 13;
  if (bytes.empty()) return Error{"an empty message"};
  if (bytes[0] != call_service) return Error{"binary messages must be service calls (opcode 2)"};
  if (bytes.size() < head) return Error{"a service call ends within its head"};
  const auto number = [&](std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
  };
  const std::size_t length = number(9);
  if (length > bytes.size() - head) return Error{"a service call ends within the name of its encoding"};
  return ClientMessage(CallService{number(1), number(5), std::string(bytes.substr(head, length)),
                                   std::string(bytes.substr(head + length))});
}

}  // namespace

Result<Json> parse_json(std::string_view text) {
  bool too_deep = false;
  const auto check = [&](int depth, Json::parse_event_t, Json&) {
    too_deep |= depth > deepest_json;
    return !too_deep;
  };
  Json json = Json::parse(text, check, false);
  if (too_deep) return Error{"JSON that is nested too deep"};
  if (json.is_discarded()) return Error{"this is no JSON"};
  return json;
}

Result<ClientMessage> parse_message(bool is_text, std::string_view message) {
  return is_text ? parse_text(message) : parse_binary(message);
}

}  // namespace flexcast::web
