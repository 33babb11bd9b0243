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

// A row: one kind of parameter. A row of bodies, obstacles or handles yields one parameter for each of them.
struct ParameterRow {
  // What has the parameter. any_body: bodies of both models; any_obstacle: obstacles of every shape.
  enum class Scope { scene, fem_body, spring_body, any_body, plane, sphere, box, any_obstacle, handle };
  Scope scope = Scope::scene;
  std::string_view name;       // "gravity", "time.step"; without the name of what has it: "young", "friction"
  std::string_view scene_key;  // where the scene file has it: "time.step"; below the owner: "material.young"
  ParameterKind kind = ParameterKind::number;
  std::string_view unit;
  Range range;  // numbers and integers; each component of vectors
  std::vector<std::string> choices;
  bool live = true;  // false: fixed when the scene is loaded
  std::string_view description;
  // `index` of the body, obstacle or handle in the model; set() of a row that is not live does nothing.
  std::function<ParameterValue(const Model&, const Settings&, std::size_t index)> get;
  std::function<void(Model&, Settings&, std::size_t index, const ParameterValue&)> set;
};

std::span<const ParameterRow> parameter_rows();

// Whether things of scope `thing` (any but the any_... scopes) have the rows of scope `row`.
bool has_rows_of(ParameterRow::Scope thing, ParameterRow::Scope row);

// What stands before a row's name in the names of parameters: nothing for the scene, "beam." for a body,
// "contact.ground." for an obstacle, "handle.grip." for a handle.
std::string parameter_prefix(ParameterRow::Scope scope, std::string_view owner);

// The row with this scene key that things of this scope have; FLEXCAST_CHECKs that there is one.
const ParameterRow& parameter_row(ParameterRow::Scope scope, std::string_view scene_key);

// One parameter of one simulation.
struct ParameterDescriptor {
  std::string name;
  const ParameterRow* row = nullptr;
  std::size_t index = 0;   // of the body, obstacle or handle
  ParameterValue initial;  // the scene's value: what reset restores
};

// All of a scene: its own, then those of the bodies, obstacles and handles in the model's order.
std::vector<ParameterDescriptor> make_descriptors(const Model& model, const Settings& settings);

struct ParameterAssignment {
  std::string name;
  ParameterValue value;
};

// Checks kind, range and choice of one value. A whole number is accepted where a number is wanted, and a number without
// fraction where an integer is. Returns the value in the row's own kind, or an error that names parameter, value and
// what is allowed.
Result<ParameterValue> convert_parameter(const std::string& name, const ParameterRow& row, const ParameterValue& value);

// What ranges of single values cannot say: the normal of a plane is not zero, a box has an extent along every axis.
// Errors name the parameter, its value and what is allowed.
Result<void> check_model(const Model& model);

// As in scene files: 0.5, 3, [0, 0, -9.81], "pcg".
std::string to_text(const ParameterValue& value);
// The same without quotes being required around choices. "nan" and "inf" are read (and refused by the range later).
Result<ParameterValue> parse_parameter_value(std::string_view text);

}  // namespace flexcast
