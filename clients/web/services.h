// Services: the commands as Foxglove's clients call them, in JSON. THE table has a row for each.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clients/client/reply.h"
#include "clients/client/request.h"
#include "clients/web/client_message.h"

namespace flexcast::web {

enum class FieldType { count, particle, revision, number, boolean, text, names, values, vector };

struct Field {
  std::string_view name;
  FieldType type;
  bool required;
};

struct Service {
  std::string_view verb;  // "run_until"
  flexcast_CommandKind kind;
  std::vector<Field> fields;
};

std::span<const Service> service_table();

// The kind of the parameter of that name, if there is one.
using FindKind = std::function<std::optional<flexcast_ValueKind>(const std::string& name)>;

// The error names verb, field, what it is and what it must be. Fields that are not known are errors.
wire::Result<client::Request> parse_request(const Service& service, std::string_view json, const FindKind& find_kind);

// A number, text, boolean or array of three as a value of that kind where it can be; where it cannot, as what it looks
// like, so that the server refuses it in its own words. An error only when it is no value at all.
wire::Result<client::Value> to_value(const Json& json, std::optional<flexcast_ValueKind> kind);

// {"outcome": "applied", "reason": "", "applied_step": 3, ...}; with a "report" of step and status.
std::string to_response(const client::Reply& reply);

std::string request_schema(const Service& service);  // as JSON schemas
std::string response_schema();

}  // namespace flexcast::web
