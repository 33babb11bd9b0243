#include "core/scene/parameter_keys.h"

#include <algorithm>
#include <limits>

namespace flexcast {
namespace {

const ParameterRow& row_of(const TableReader& reader, ParameterRow::Scope scope, std::string_view key) {
  return parameter_row(scope, reader.place_of(key).key);
}

Quantity quantity_of(const ParameterRow& row) {
  return {row.range, row.unit};
}

}  // namespace

Quantity parameter_quantity(ParameterRow::Scope scope, std::string_view scene_key) {
  return quantity_of(parameter_row(scope, scene_key));
}

double read_parameter(const TableReader& reader, ParameterRow::Scope scope, std::string_view key, double otherwise) {
  return reader.number(key, quantity_of(row_of(reader, scope, key))).value_or(otherwise);
}

int read_parameter(const TableReader& reader, ParameterRow::Scope scope, std::string_view key, int otherwise) {
  Quantity allowed = quantity_of(row_of(reader, scope, key));
  constexpr double largest = std::numeric_limits<int>::max();
  if (allowed.range.maximum > largest) allowed.range.maximum = largest;
  return static_cast<int>(reader.integer(key, allowed).value_or(otherwise));
}

Vec3 read_parameter(const TableReader& reader, ParameterRow::Scope scope, std::string_view key, const Vec3& otherwise) {
  return reader.vector(key, quantity_of(row_of(reader, scope, key))).value_or(otherwise);
}

std::string read_parameter(const TableReader& reader, ParameterRow::Scope scope, std::string_view key,
                           const std::string& otherwise) {
  const ParameterRow& row = row_of(reader, scope, key);
  const std::vector<std::string_view> choices(row.choices.begin(), row.choices.end());
  return reader.choice(key, choices).value_or(otherwise);
}

double require_parameter(const TableReader& reader, ParameterRow::Scope scope, std::string_view key) {
  return reader.require_number(key, quantity_of(row_of(reader, scope, key)));
}

Vec3 require_vector_parameter(const TableReader& reader, ParameterRow::Scope scope, std::string_view key) {
  return reader.require_vector(key, quantity_of(row_of(reader, scope, key)));
}

}  // namespace flexcast
