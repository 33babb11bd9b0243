#include "clients/web/services.h"

#include <array>
#include <cmath>
#include <limits>

#include "idl/wire/names.h"

namespace flexcast::web {
namespace {

using client::Request;
using wire::Error;
using wire::Result;

constexpr bool required = true;
constexpr bool optional = false;

const std::array table{
    Service{"pause", flexcast_COMMAND_PAUSE, {}},
    Service{"resume", flexcast_COMMAND_RESUME, {}},
    Service{"step", flexcast_COMMAND_STEP, {{"count", FieldType::count, optional}}},
    Service{"run_until", flexcast_COMMAND_RUN_UNTIL, {{"time", FieldType::number, required}}},
    Service{"reset", flexcast_COMMAND_RESET, {{"keep_parameters", FieldType::boolean, optional}}},
    Service{"set",
            flexcast_COMMAND_SET,
            {{"values", FieldType::values, required}, {"if_revision", FieldType::revision, optional}}},
    Service{"get", flexcast_COMMAND_GET, {{"names", FieldType::names, optional}}},
    Service{"load", flexcast_COMMAND_LOAD, {{"name", FieldType::text, required}}},
    Service{"save", flexcast_COMMAND_SAVE, {{"name", FieldType::text, required}}},
    Service{"restore", flexcast_COMMAND_RESTORE, {{"name", FieldType::text, required}}},
    Service{"grab",
            flexcast_COMMAND_GRAB,
            {{"particle", FieldType::particle, required},
             {"target", FieldType::vector, required},
             {"stiffness", FieldType::number, optional}}},
    Service{"release", flexcast_COMMAND_RELEASE, {{"particle", FieldType::particle, required}}},
    Service{"status", flexcast_COMMAND_STATUS, {}},
};

const char* describe(FieldType type) {
  switch (type) {
    case FieldType::count:
      return "a whole number from 1 on";
    case FieldType::particle:
      return "a whole number from 0 to 4294967295";
    case FieldType::revision:
      return "a whole number from 0 on";
    case FieldType::number:
      return "a number";
    case FieldType::boolean:
      return "true or false";
    case FieldType::text:
      return "a text";
    case FieldType::names:
      return "an array of texts";
    case FieldType::values:
      return "an object {NAME: VALUE}";
    case FieldType::vector:
      return "an array of three numbers";
  }
  return "";
}

Json schema_of(FieldType type) {
  switch (type) {
    case FieldType::count:
      return {{"type", "integer"}, {"minimum", 1}};
    case FieldType::particle:
    case FieldType::revision:
      return {{"type", "integer"}, {"minimum", 0}};
    case FieldType::number:
      return {{"type", "number"}};
    case FieldType::boolean:
      return {{"type", "boolean"}};
    case FieldType::text:
      return {{"type", "string"}};
    case FieldType::names:
      return {{"type", "array"}, {"items", {{"type", "string"}}}};
    case FieldType::values:
      return {{"type", "object"}};
    case FieldType::vector:
      return {{"type", "array"}, {"items", {{"type", "number"}}}, {"minItems", 3}, {"maxItems", 3}};
  }
  return {};
}

std::optional<client::Vector> to_vector(const Json& json) {
  if (!json.is_array() || json.size() != 3) return {};
  client::Vector vector{};
  for (std::size_t i = 0; i < 3; ++i) {
    if (!json[i].is_number()) return {};
    vector[i] = json[i].get<double>();
  }
  return vector;
}

bool read_values(const Json& json, const FindKind& find_kind, Request& request, std::string& error) {
  if (!json.is_object()) return false;
  for (const auto& [name, content] : json.items()) {
    auto value = to_value(content, find_kind(name));
    if (!value) return error = name + ": " + value.error().message, false;
    request.values.push_back({name, std::move(value).value()});
  }
  return true;
}

bool read_names(const Json& json, Request& request) {
  if (!json.is_array()) return false;
  for (const Json& name : json) {
    if (!name.is_string()) return false;
    request.names.push_back(name.get<std::string>());
  }
  return true;
}

bool read_number(const Json& json, flexcast_CommandKind kind, Request& request) {
  if (!json.is_number()) return false;
  (kind == flexcast_COMMAND_GRAB ? request.stiffness : request.time) = json.get<double>();
  return true;
}

// False if the field is not what it must be; `error` may say more.
bool read_field(const Service& service, const Field& field, const Json& json, const FindKind& find_kind,
                Request& request, std::string& error) {
  const std::uint64_t whole = json.is_number_unsigned() ? json.get<std::uint64_t>() : 0;
  switch (field.type) {
    case FieldType::count:
      return request.count = whole, whole > 0;
    case FieldType::particle:
      request.particle = static_cast<std::uint32_t>(whole);
      return json.is_number_unsigned() && whole <= std::numeric_limits<std::uint32_t>::max();
    case FieldType::revision:
      return request.expected_revision = whole, json.is_number_unsigned();
    case FieldType::number:
      return read_number(json, service.kind, request);
    case FieldType::boolean:
      return json.is_boolean() && (request.keep_parameters = json.get<bool>(), true);
    case FieldType::text:
      return json.is_string() && (request.name = json.get<std::string>(), true);
    case FieldType::names:
      return read_names(json, request);
    case FieldType::values:
      return read_values(json, find_kind, request, error);
    case FieldType::vector: {
      const auto vector = to_vector(json);
      return vector && (request.target = *vector, true);
    }
  }
  return false;
}

const Field* find_field(const Service& service, std::string_view name) {
  for (const Field& field : service.fields)
    if (field.name == name) return &field;
  return nullptr;
}

std::string field_names(const Service& service) {
  std::string names;
  for (const Field& field : service.fields) names += (names.empty() ? "" : ", ") + std::string(field.name);
  return names.empty() ? "it takes none" : "it takes " + names;
}

std::string shorten(const Json& json) {
  const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  return text.size() <= 60 ? text : text.substr(0, 57) + "...";
}

}  // namespace

std::span<const Service> service_table() {
  return table;
}

Result<Request> parse_request(const Service& service, std::string_view text, const FindKind& find_kind) {
  const std::string verb(service.verb);
  const auto json = parse_json(text.empty() ? "{}" : text);
  if (!json) return Error{verb + ": " + json.error().message};
  if (!json.value().is_object()) return Error{verb + ": a request must be a JSON object"};
  Request request{.kind = service.kind};
  for (const auto& [name, content] : json.value().items()) {
    const Field* field = find_field(service, name);
    if (!field) return Error{verb + ": there is no field '" + name + "': " + field_names(service)};
    std::string error;
    if (read_field(service, *field, content, find_kind, request, error)) continue;
    if (!error.empty()) return Error{verb + ": " + error};
    return Error{verb + ": '" + name + "' must be " + describe(field->type) + ", not " + shorten(content)};
  }
  for (const Field& field : service.fields)
    if (field.required && !json.value().contains(field.name))
      return Error{verb + ": '" + std::string(field.name) + "' is missing: " + describe(field.type)};
  return request;
}

Result<client::Value> to_value(const Json& json, std::optional<flexcast_ValueKind> kind) {
  if (json.is_boolean()) return client::Value(json.get<bool>());
  if (json.is_string()) return client::parse_value(json.get<std::string>(), kind);
  if (const auto vector = to_vector(json)) return client::Value(*vector);
  if (!json.is_number())
    return Error{"a value is a number, a text, true, false or an array of three numbers, not " + shorten(json)};
  const auto number = json.get<double>();
  const bool is_whole = std::abs(number) < 9e15 && std::floor(number) == number;
  if (is_whole && kind == flexcast_VALUE_INTEGER) return client::Value(static_cast<std::int64_t>(number));
  return client::Value(number);
}

std::string to_response(const client::Reply& reply) {
  Json json{{"outcome", wire::name_of(reply.outcome)},
            {"reason", reply.reason},
            {"applied_step", reply.applied_step},
            {"time", reply.time},
            {"state", wire::name_of(reply.state)},
            {"run_id", std::to_string(reply.run_id)},
            {"parameter_revision", reply.parameter_revision},
            {"values", Json::object()}};
  for (const auto& [name, value] : reply.values) json["values"][name] = client::to_json(value);
  if (reply.kind == flexcast_COMMAND_STEP || reply.kind == flexcast_COMMAND_STATUS)
    json["report"] = client::to_json(reply.report);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string request_schema(const Service& service) {
  Json properties = Json::object(), names = Json::array();
  for (const Field& field : service.fields) {
    properties[std::string(field.name)] = schema_of(field.type);
    if (field.required) names.push_back(field.name);
  }
  Json schema{{"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
  if (!names.empty()) schema["required"] = std::move(names);
  return schema.dump();
}

std::string response_schema() {
  const Json text{{"type", "string"}}, number{{"type", "number"}}, whole{{"type", "integer"}},
      object{{"type", "object"}};
  return Json{{"type", "object"},
              {"properties",
               {{"outcome", text},
                {"reason", text},
                {"applied_step", whole},
                {"time", number},
                {"state", text},
                {"run_id", text},
                {"parameter_revision", whole},
                {"values", object},
                {"report", object}}}}
      .dump();
}

}  // namespace flexcast::web
