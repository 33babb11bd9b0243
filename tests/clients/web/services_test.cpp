#include "clients/web/services.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <stdexcept>

namespace flexcast::web {
namespace {

const Service& service(std::string_view verb) {
  for (const Service& row : service_table())
    if (row.verb == verb) return row;
  throw std::runtime_error("no such service");
}

wire::Result<client::Request> parse(std::string_view verb, const std::string& json) {
  return parse_request(service(verb), json, [](const std::string& name) -> std::optional<flexcast_ValueKind> {
    if (name == "substeps") return flexcast_VALUE_INTEGER;
    if (name == "young") return flexcast_VALUE_NUMBER;
    return {};
  });
}

std::string refusal_of(std::string_view verb, const std::string& json) {
  const auto request = parse(verb, json);
  return request ? "" : request.error().message;
}

TEST(Services, EveryCommandButDescribeIsOne) {
  std::set<flexcast_CommandKind> kinds;
  for (const Service& row : service_table()) kinds.insert(row.kind);
  EXPECT_EQ(kinds.size(), service_table().size());
  for (int kind = 0; kind <= flexcast_COMMAND_STATUS; ++kind)
    EXPECT_EQ(kinds.contains(static_cast<flexcast_CommandKind>(kind)), kind != flexcast_COMMAND_DESCRIBE) << kind;
}

TEST(Services, FieldsReachTheCommand) {
  EXPECT_EQ(parse("step", "").value().count, 1u);
  EXPECT_EQ(parse("step", R"({"count":7})").value().count, 7u);
  EXPECT_EQ(parse("run_until", R"({"time":2.5})").value().time, 2.5);
  EXPECT_TRUE(parse("reset", R"({"keep_parameters":true})").value().keep_parameters);
  EXPECT_EQ(parse("load", R"({"name":"rope"})").value().name, "rope");
  EXPECT_EQ(parse("get", R"({"names":["a"]})").value().names, std::vector<std::string>{"a"});
  const auto grab = parse("grab", R"({"particle":3,"target":[1,2,3],"stiffness":4})").value();
  EXPECT_EQ(grab.particle, 3u);
  EXPECT_EQ(grab.target, (client::Vector{1, 2, 3}));
  EXPECT_EQ(grab.stiffness, 4.0);
  const auto set = parse("set", R"({"values":{"young":2,"substeps":3,"g":[0,0,1]},"if_revision":0})").value();
  EXPECT_EQ(set.values[0].value, client::Value(2.0));
  EXPECT_EQ(set.values[1].value, client::Value(std::int64_t{3}));
  EXPECT_EQ(set.values[2].value, client::Value(client::Vector{0, 0, 1}));
  EXPECT_EQ(set.expected_revision, 0u);
}

TEST(Services, AMalformedRequestNamesFieldValueAndWhatIsAllowed) {
  EXPECT_EQ(refusal_of("step", R"({"count":"x"})"), "step: 'count' must be a whole number from 1 on, not \"x\"");
  EXPECT_EQ(refusal_of("step", R"({"count":0})"), "step: 'count' must be a whole number from 1 on, not 0");
  EXPECT_EQ(refusal_of("step", R"({"counts":1})"), "step: there is no field 'counts': it takes count");
  EXPECT_EQ(refusal_of("pause", R"({"a":1})"), "pause: there is no field 'a': it takes none");
  EXPECT_EQ(refusal_of("grab", R"({"particle":1})"), "grab: 'target' is missing: an array of three numbers");
  EXPECT_EQ(refusal_of("release", R"({"particle":4294967296})"),
            "release: 'particle' must be a whole number from 0 to 4294967295, not 4294967296");
  EXPECT_EQ(refusal_of("set", R"({"values":{"young":{}}})"),
            "set: young: a value is a number, a text, true, false or an array of three numbers, not {}");
  EXPECT_EQ(refusal_of("load", "[]"), "load: a request must be a JSON object");
}

TEST(Services, TextIsReadAsTheKindOfItsParameter) {
  EXPECT_EQ(to_value("2e6", flexcast_VALUE_NUMBER).value(), client::Value(2e6));
  EXPECT_EQ(to_value("pcg", flexcast_VALUE_CHOICE).value(), client::Value(std::string("pcg")));
  EXPECT_EQ(to_value(2.5, flexcast_VALUE_INTEGER).value(), client::Value(2.5));  // for the server to refuse
  EXPECT_FALSE(to_value(nullptr, flexcast_VALUE_NUMBER).ok());
}

TEST(Services, AResponseIsJsonWithNullForWhatIsNotFinite) {
  client::Reply reply{.kind = flexcast_COMMAND_STEP, .outcome = flexcast_OUTCOME_APPLIED, .run_id = ~0ull};
  reply.report.min_j = std::nan("");
  reply.values = {{"a", 1.5}};
  const Json json = Json::parse(to_response(reply));
  EXPECT_EQ(json["outcome"], "applied");
  EXPECT_EQ(json["run_id"], "18446744073709551615");
  EXPECT_EQ(json["values"]["a"], 1.5);
  EXPECT_TRUE(json["report"]["min_j"].is_null());
  const Json schema = Json::parse(response_schema());
  for (const auto& [name, value] : json.items()) EXPECT_TRUE(schema["properties"].contains(name)) << name;
}

TEST(Services, SchemasSayWhatIsRequired) {
  for (const Service& row : service_table()) {
    const Json schema = Json::parse(request_schema(row));
    EXPECT_EQ(schema["additionalProperties"], false);
    EXPECT_EQ(schema["properties"].size(), row.fields.size()) << row.verb;
  }
  EXPECT_EQ(Json::parse(request_schema(service("grab")))["required"], Json::parse(R"(["particle","target"])"));
}

}  // namespace
}  // namespace flexcast::web
