#include "server/convert/parameters.h"

#include <array>
#include <cmath>
#include <variant>

#include "server/convert/enums.h"

namespace flexcast::server {
namespace {

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

Result<ParameterValue> value_from_wire(const flexcast_ParameterValue& message, const std::string& name) {
  const auto numbers = wire::elements(message.numbers);
  const std::size_t wanted = message.kind == flexcast_VALUE_VECTOR ? 3 : message.kind == flexcast_VALUE_CHOICE ? 0 : 1;
  if (numbers.size() < wanted) {
    return Error{name + ": " + std::to_string(wanted) + " numbers are needed, " + std::to_string(numbers.size()) +
                 " came"};
  }
  constexpr double largest_whole = 9007199254740992.0;  // 2^53: beyond it doubles skip whole numbers
  switch (message.kind) {
    case flexcast_VALUE_NUMBER:
      return ParameterValue(numbers[0]);
    case flexcast_VALUE_INTEGER:
    case flexcast_VALUE_BOOLEAN:
      if (!(std::abs(numbers[0]) <= largest_whole) || numbers[0] != std::floor(numbers[0])) {
        return Error{name + ": " + to_text(ParameterValue(numbers[0])) + " is not a whole number"};
      }
      return ParameterValue(static_cast<std::int64_t>(numbers[0]));
    case flexcast_VALUE_VECTOR:
      return ParameterValue(Vec3(numbers[0], numbers[1], numbers[2]));
    case flexcast_VALUE_CHOICE:
      return ParameterValue(std::string(wire::text(message.text)));
  }
  return Error{name + ": this kind of value is not known"};
}

}  // namespace

void to_wire(const ParameterAssignment& value, flexcast_ParameterValue& message) {
  wire::set_string(message.name, value.name);
  message.kind = to_wire(static_cast<ParameterKind>(value.value.index()));
  const auto set_numbers = [&](std::span<const double> numbers) { wire::copy(message.numbers, numbers); };
  std::visit(Overloaded{[&](double number) { set_numbers(std::array{number}); },
                        [&](std::int64_t number) { set_numbers(std::array{static_cast<double>(number)}); },
                        [&](const Vec3& vector) {
                          set_numbers({vector.data(), 3});
                        },
                        [&](const std::string& choice) { wire::set_string(message.text, choice); }},
             value.value);
}

void to_wire(const ParameterDescriptor& descriptor, flexcast_ParameterDescriptor& message) {
  const ParameterRow& row = *descriptor.row;
  wire::set_string(message.name, descriptor.name);
  message.kind = to_wire(row.kind);
  wire::set_string(message.unit, row.unit);
  to_wire(ParameterAssignment{descriptor.name, descriptor.initial}, message.initial);
  message.minimum = row.range.minimum;
  message.maximum = row.range.maximum;
  message.minimum_open = row.range.minimum_open;
  message.maximum_open = row.range.maximum_open;
  wire::set_strings(message.choices, row.choices);
  message.live = row.live;
  wire::set_string(message.description, row.description);
}

Result<ParameterAssignment> from_wire(const flexcast_ParameterValue& message) {
  std::string name(wire::text(message.name));
  auto value = value_from_wire(message, name);
  if (!value) return value.error();
  return ParameterAssignment{std::move(name), std::move(value).value()};
}

wire::Owned<flexcast_ParameterSet> to_wire(const ParametersChanged& parameters, std::string_view world) {
  wire::Owned<flexcast_ParameterSet> message;
  wire::set_string(message->world, world);
  message->run_id = parameters.run_id;
  message->step = static_cast<std::uint64_t>(parameters.step);
  message->parameter_revision = parameters.parameter_revision;
  to_wire(std::span<const ParameterDescriptor>(parameters.descriptors), message->descriptors);
  to_wire(std::span<const ParameterAssignment>(parameters.values), message->values);
  return message;
}

}  // namespace flexcast::server
