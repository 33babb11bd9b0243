#include "clients/client/value.h"

#include <charconv>
#include <cmath>
#include <limits>

#include "idl/wire/fill.h"

namespace flexcast::client {
namespace {

std::string number_text(double number) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, number).ptr;
  return {buffer, end};
}

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + '"';
}

struct ToText {
  std::string operator()(double number) const { return number_text(number); }
  std::string operator()(std::int64_t number) const { return std::to_string(number); }
  std::string operator()(const Vector& v) const {
    return "[" + number_text(v[0]) + ", " + number_text(v[1]) + ", " + number_text(v[2]) + "]";
  }
  std::string operator()(const std::string& text) const { return quoted(text); }
  std::string operator()(bool flag) const { return flag ? "true" : "false"; }
};

struct Fill {
  flexcast_ParameterValue& to;

  void numbers(std::span<const double> values) const { wire::copy(to.numbers, values); }
  void operator()(double number) const { numbers({&number, 1}); }
  void operator()(std::int64_t number) const { (*this)(static_cast<double>(number)); }
  void operator()(const Vector& v) const { numbers(v); }
  void operator()(const std::string& text) const { wire::set_string(to.text, text); }
  void operator()(bool flag) const { (*this)(flag ? 1.0 : 0.0); }
};

}  // namespace

std::string to_text(const Value& value) {
  return std::visit(ToText{}, value);
}

std::string range_text(const Descriptor& descriptor) {
  if (descriptor.kind == flexcast_VALUE_CHOICE) {
    std::string text;
    for (const auto& choice : descriptor.choices) text += (text.empty() ? "" : " | ") + choice;
    return text;
  }
  if (descriptor.kind == flexcast_VALUE_BOOLEAN) return "true | false";
  if (std::isinf(descriptor.minimum) && std::isinf(descriptor.maximum)) return "";
  const bool left_open = descriptor.minimum_open || std::isinf(descriptor.minimum);
  const bool right_open = descriptor.maximum_open || std::isinf(descriptor.maximum);
  const auto bound = [&](double number) {
    const bool whole = descriptor.kind == flexcast_VALUE_INTEGER && std::abs(number) < 9e15;
    return whole ? std::to_string(static_cast<std::int64_t>(number)) : number_text(number);
  };
  return (left_open ? "(" : "[") + bound(descriptor.minimum) + ", " + bound(descriptor.maximum) +
         (right_open ? ")" : "]");
}

void to_wire(flexcast_ParameterValue& to, const Parameter& from) {
  wire::set_string(to.name, from.name);
  to.kind = kind_of(from.value);
  std::visit(Fill{to}, from.value);
}

Parameter from_wire(const flexcast_ParameterValue& value) {
  const auto numbers = wire::elements(value.numbers);
  const auto number = [&](std::size_t i) {
    return i < numbers.size() ? numbers[i] : std::numeric_limits<double>::quiet_NaN();
  };
  Parameter result{std::string(wire::text(value.name)), number(0)};
  switch (value.kind) {
    case flexcast_VALUE_NUMBER:
      break;
    case flexcast_VALUE_INTEGER:
      if (std::abs(number(0)) < 9.2e18) result.value = static_cast<std::int64_t>(number(0));
      break;
    case flexcast_VALUE_VECTOR:
      result.value = Vector{number(0), number(1), number(2)};
      break;
    case flexcast_VALUE_CHOICE:
      result.value = std::string(wire::text(value.text));
      break;
    case flexcast_VALUE_BOOLEAN:
      result.value = number(0) != 0.0;
      break;
  }
  return result;
}

Descriptor from_wire(const flexcast_ParameterDescriptor& descriptor) {
  return {.name = std::string(wire::text(descriptor.name)),
          .kind = descriptor.kind,
          .unit = std::string(wire::text(descriptor.unit)),
          .initial = from_wire(descriptor.initial).value,
          .minimum = descriptor.minimum,
          .maximum = descriptor.maximum,
          .minimum_open = descriptor.minimum_open,
          .maximum_open = descriptor.maximum_open,
          .choices = wire::strings(descriptor.choices),
          .live = descriptor.live,
          .description = std::string(wire::text(descriptor.description))};
}

}  // namespace flexcast::client
