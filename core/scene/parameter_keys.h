// Keys of the scene file that are parameters: their range, unit and choices come from the parameter table.
#pragma once

#include "core/scene/table_reader.h"
#include "core/sim/parameters.h"

namespace flexcast {

// Range and unit of the parameter that the scene file has at `scene_key`.
Quantity parameter_quantity(ParameterRow::Scope scope, std::string_view scene_key);

// Each reads `key` of the reader's table, whose place within scene or body makes it the scene key. Absent: `otherwise`.
double read_parameter(const TableReader& reader, ParameterRow::Scope scope, std::string_view key, double otherwise);
int read_parameter(const TableReader& reader, ParameterRow::Scope scope, std::string_view key, int otherwise);
Vec3 read_parameter(const TableReader& reader, ParameterRow::Scope scope, std::string_view key, const Vec3& otherwise);
std::string read_parameter(const TableReader& reader, ParameterRow::Scope scope, std::string_view key,
                           const std::string& otherwise);
double require_parameter(const TableReader& reader, ParameterRow::Scope scope, std::string_view key);
Vec3 require_vector_parameter(const TableReader& reader, ParameterRow::Scope scope, std::string_view key);

}  // namespace flexcast
