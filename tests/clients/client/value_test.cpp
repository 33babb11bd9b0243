#include "clients/client/value.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "idl/wire/owned.h"

namespace flexcast::client {
namespace {

Value parsed(std::string_view text, std::optional<flexcast_ValueKind> wanted = {}) {
  const auto value = parse_value(text, wanted);
  EXPECT_TRUE(value.ok()) << text << ": " << (value ? "" : value.error().message);
  return value ? value.value() : Value();
}

std::string error_of(std::string_view text) {
  const auto value = parse_value(text);
  return value ? "" : value.error().message;
}

TEST(ParseValue, ReadsWhatTomlWrites) {
  EXPECT_EQ(parsed("0.5"), Value(0.5));
  EXPECT_EQ(parsed("1e6"), Value(1e6));
  EXPECT_EQ(parsed("1_000.5"), Value(1000.5));
  EXPECT_EQ(parsed("-3"), Value(std::int64_t{-3}));
  EXPECT_EQ(parsed("+3"), Value(std::int64_t{3}));
  EXPECT_EQ(parsed("[0, 0, -9.81]"), Value(Vector{0, 0, -9.81}));
  EXPECT_EQ(parsed(" [1,2,3,] "), Value(Vector{1, 2, 3}));
  EXPECT_EQ(parsed("true"), Value(true));
  EXPECT_EQ(parsed(R"("a \"b\" \\")"), Value(std::string(R"(a "b" \)")));
  EXPECT_EQ(parsed(R"('C:\x')"), Value(std::string(R"(C:\x)")));
}

TEST(ParseValue, TakesBareTextAsText) {
  EXPECT_EQ(parsed("pcg"), Value(std::string("pcg")));
  EXPECT_EQ(parsed("1_"), Value(std::string("1_")));
  EXPECT_EQ(parsed("++1"), Value(std::string("++1")));
}

TEST(ParseValue, SendsNanAndInfinityAsNumbersForTheServerToRefuse) {
  EXPECT_TRUE(std::isnan(std::get<double>(parsed("nan"))));
  EXPECT_TRUE(std::isnan(std::get<double>(parsed("-nan", flexcast_VALUE_NUMBER))));
  EXPECT_EQ(parsed("inf"), Value(std::numeric_limits<double>::infinity()));
  EXPECT_EQ(parsed("-inf", flexcast_VALUE_INTEGER), Value(-std::numeric_limits<double>::infinity()));
  EXPECT_TRUE(std::isnan(std::get<Vector>(parsed("[0, nan, 0]"))[1]));
}

TEST(ParseValue, FollowsTheKindThatTheParameterWants) {
  EXPECT_EQ(parsed("3", flexcast_VALUE_NUMBER), Value(3.0));
  EXPECT_EQ(parsed("3.0", flexcast_VALUE_INTEGER), Value(std::int64_t{3}));
  EXPECT_EQ(parsed("2", flexcast_VALUE_CHOICE), Value(std::string("2")));
  EXPECT_EQ(parsed("\"2\"", flexcast_VALUE_CHOICE), Value(std::string("2")));
}

TEST(ParseValue, LeavesWhatDoesNotFitToTheServer) {
  EXPECT_EQ(parsed("2.5", flexcast_VALUE_INTEGER), Value(2.5));
  EXPECT_EQ(parsed("soft", flexcast_VALUE_NUMBER), Value(std::string("soft")));
  EXPECT_EQ(parsed("3", flexcast_VALUE_VECTOR), Value(std::int64_t{3}));
}

TEST(ParseValue, RefusesWhatCannotBeRead) {
  EXPECT_EQ(error_of(""), "a value is missing");
  EXPECT_EQ(error_of("[1, 2]"), "a vector is written [x, y, z], not [1, 2]");
  EXPECT_EQ(error_of("[1, 2, x]"), "a vector is written [x, y, z], not [1, 2, x]");
  EXPECT_EQ(error_of("["), "a vector is written [x, y, z], not [");
  EXPECT_EQ(error_of("\"open"), "a text that begins with a quote must end with one: \"open");
  EXPECT_EQ(error_of("'"), "a text that begins with a quote must end with one: '");
}

TEST(ParseAssignment, FindsTheKindByName) {
  Descriptor young;
  young.name = "beam.young";
  const auto parameter = parse_assignment(" beam.young = 1000 ", {young});
  ASSERT_TRUE(parameter.ok());
  EXPECT_EQ(parameter.value(), (Parameter{"beam.young", 1000.0}));
  EXPECT_EQ(parse_assignment("x=1", {young}).value(), (Parameter{"x", std::int64_t{1}}));
}

TEST(ParseAssignment, NamesTheTextThatIsNoAssignment) {
  EXPECT_EQ(parse_assignment("gravity", {}).error().message, "'gravity' is not of the form NAME=VALUE");
  EXPECT_EQ(parse_assignment("=3", {}).error().message, "'=3' is not of the form NAME=VALUE");
  EXPECT_EQ(parse_assignment("gravity=", {}).error().message, "gravity: a value is missing");
}

TEST(ToText, IsReadBackBitForBit) {
  for (const Value& value : {Value(0.1), Value(1e300), Value(-2.5e-7), Value(std::int64_t{-7}),
                             Value(Vector{1.0 / 3, 0, -9.81}), Value(std::string("a \"b\" \\ c")), Value(true)})
    EXPECT_EQ(parsed(to_text(value), kind_of(value)), value) << to_text(value);
}

TEST(Wire, ValuesOfEveryKindSurviveTheRoundTrip) {
  for (const Value& value :
       {Value(0.1), Value(std::int64_t{-7}), Value(Vector{1, 2, 3}), Value(std::string("pcg")), Value(false)}) {
    wire::Owned<flexcast_ParameterValue> sample;
    to_wire(*sample, {"name", value});
    EXPECT_EQ(from_wire(*sample), (Parameter{"name", value}));
  }
}

TEST(RangeText, SaysWhatIsAllowed) {
  Descriptor d;
  d.maximum = 0.5;
  d.maximum_open = true;
  EXPECT_EQ(range_text(d), "[0, 0.5)");
  d.maximum = std::numeric_limits<double>::infinity();
  d.minimum_open = true;
  EXPECT_EQ(range_text(d), "(0, inf)");
  d.kind = flexcast_VALUE_INTEGER;
  d.minimum = 1;
  d.maximum = 1e6;
  d.minimum_open = d.maximum_open = false;
  EXPECT_EQ(range_text(d), "[1, 1000000]");
  d.maximum = std::numeric_limits<double>::infinity();
  d.minimum = -d.maximum;
  EXPECT_EQ(range_text(d), "");
  d.kind = flexcast_VALUE_CHOICE;
  d.choices = {"pcg", "ldlt"};
  EXPECT_EQ(range_text(d), "pcg | ldlt");
}

}  // namespace
}  // namespace flexcast::client
