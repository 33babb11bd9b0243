// THE parameter table: everything a user may read by name, and mostly change while the scene runs. One row a
// parameter; the scene reader takes ranges and units from it, `describe` and the documentation print it.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/base/math.h"
#include "core/base/range.h"
#include "core/base/result.h"

namespace flexcast {

class Simulation;
struct Model;
struct Settings;

enum class ParameterKind { number, integer, vector, choice };
using ParameterValue = std::variant<double, std::int64_t, Vec3, std::string>;  // in the order of ParameterKind

// A row: one kind of parameter. A row of a body yields one parameter a body, named "BODY.name".
struct ParameterRow {
  enum class Scope { scene, fem_body, spring_body, any_body };
  Scope scope = Scope::scene;
  std::string_view name;       // "gravity", "time.step"; of bodies without the body's name: "young"
  std::string_view scene_key;  // where the scene file has it: "time.step"; below the body: "material.young"
  ParameterKind kind = ParameterKind::number;
  std::string_view unit;
  Range range;  // numbers and integers; each component of vectors
  std::vector<std::string> choices;
  bool live = true;  // false: fixed when the scene is loaded
  std::string_view description;
  std::function<ParameterValue(const Model&, const Settings&, std::size_t body)> get;
  std::function<void(Model&, Settings&, std::size_t body, const ParameterValue&)> set;
};

std::span<const ParameterRow> parameter_rows();

// The row with this scene key in this scope or in any_body; FLEXCAST_CHECKs that there is one.
const ParameterRow& parameter_row(ParameterRow::Scope scope, std::string_view scene_key);

// One parameter of one simulation.
struct ParameterDescriptor {
  std::string name;
  const ParameterRow* row = nullptr;
  std::size_t body = 0;    // meaningful for rows of bodies
  ParameterValue initial;  // the scene's value: what reset restores
};

struct ParameterAssignment {
  std::string name;
  ParameterValue value;
};

// Checks kind, range and choice of one value. A whole number is accepted where a number is wanted, and a number without
// fraction where an integer is. Returns the value in the row's own kind, or an error that names parameter, value and
// what is allowed.
Result<ParameterValue> convert_parameter(const std::string& name, const ParameterRow& row, const ParameterValue& value);

// As in scene files: 0.5, 3, [0, 0, -9.81], "pcg".
std::string to_text(const ParameterValue& value);
// The same without quotes being required around choices. "nan" and "inf" are read (and refused by the range later).
Result<ParameterValue> parse_parameter_value(std::string_view text);

}  // namespace flexcast
