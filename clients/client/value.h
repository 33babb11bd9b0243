// Values of parameters, as the network carries them and as people write them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "idl/wire/result.h"
#include "idl/wire/types.h"

namespace flexcast::client {

using wire::Error;
using wire::Result;

using Vector = std::array<double, 3>;

// In the order of flexcast_ValueKind: number, integer, vector, choice (text), boolean.
using Value = std::variant<double, std::int64_t, Vector, std::string, bool>;

inline flexcast_ValueKind kind_of(const Value& value) {
  return static_cast<flexcast_ValueKind>(value.index());
}

struct Parameter {
  std::string name;
  Value value;
  friend bool operator==(const Parameter&, const Parameter&) = default;
};

// What the server says of a parameter.
struct Descriptor {
  std::string name;
  flexcast_ValueKind kind = flexcast_VALUE_NUMBER;
  std::string unit;                                 // "" for pure numbers and choices
  Value initial;                                    // what reset restores
  double minimum = 0, maximum = 0;                  // numbers, integers, components of vectors; -inf, +inf: unbounded
  bool minimum_open = false, maximum_open = false;  // the bound itself is not allowed
  std::vector<std::string> choices;                 // of a choice
  bool live = false;                                // may change while the scene runs
  std::string description;
};

// As in TOML: 0.5, 3, [0, 0, -9.81], "pcg", true. Numbers come back bit for bit when parsed.
std::string to_text(const Value& value);

// "[0, 0.5)", "(0, inf)", "pcg | ldlt"; "" when nothing is excluded.
std::string range_text(const Descriptor& descriptor);

// Reads a value written as in TOML: 0.5, 1_000, 3, nan, [x, y, z], "text", 'text', true, or bare text. With `wanted`
// the text is read as that kind where it can be (3 as a number, bare or numeric text as a choice); where it cannot, as
// what it looks like, so that the server refuses it in its own words. An error only when it cannot be read at all.
Result<Value> parse_value(std::string_view text, std::optional<flexcast_ValueKind> wanted = {});

// "NAME=VALUE"; the kind comes from the descriptor of that name, if there is one.
Result<Parameter> parse_assignment(std::string_view text, const std::vector<Descriptor>& descriptors);

// To and from the generated structs (the targets must be zeroed: fresh).
void to_wire(flexcast_ParameterValue& to, const Parameter& from);
Parameter from_wire(const flexcast_ParameterValue& value);
Descriptor from_wire(const flexcast_ParameterDescriptor& descriptor);

}  // namespace flexcast::client
