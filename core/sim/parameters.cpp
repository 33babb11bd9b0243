#include "core/sim/parameters.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/base/checks.h"
#include "core/forces/model.h"

namespace flexcast {
namespace {

using Scope = ParameterRow::Scope;

std::string shortest_text(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0.0 ? "inf" : "-inf";
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;  // the shortest that reads back the same
  return {text, end};
}

std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

// The whole text as a number; "+1", "nan" and "inf" included.
bool read_number(std::string_view text, double& value) {
  text = trimmed(text);
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  return code == std::errc() && end == text.data() + text.size() && !text.empty();
}

bool read_integer(std::string_view text, std::int64_t& value) {
  text = trimmed(text);
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  return code == std::errc() && end == text.data() + text.size() && !text.empty();
}

std::string expected_text(const ParameterRow& row) {
  const std::string unit = row.unit.empty() ? "" : " in " + std::string(row.unit);
  switch (row.kind) {
    case ParameterKind::number:
      return "a number" + unit + ", " + row.range.text();
    case ParameterKind::integer:
      return "an integer" + unit + ", " + row.range.text();
    case ParameterKind::vector:
      return "three numbers" + unit + ", each " + row.range.text();
    case ParameterKind::choice:
      break;
  }
  std::string text = "one of";
  for (std::size_t i = 0; i < row.choices.size(); ++i) text += (i ? ", " : " ") + row.choices[i];
  return text;
}

Error make_error(const std::string& name, const ParameterRow& row, const ParameterValue& value) {
  return {name + " = " + to_text(value) + " is not allowed: expected " + expected_text(row)};
}

Scope scope_of(Obstacle::Shape shape) {
  switch (shape) {
    case Obstacle::Shape::plane:
      return Scope::plane;
    case Obstacle::Shape::sphere:
      return Scope::sphere;
    case Obstacle::Shape::box:
      break;
  }
  return Scope::box;
}

}  // namespace

bool has_rows_of(Scope thing, Scope row) {
  switch (row) {
    case Scope::any_body:
      return thing == Scope::fem_body || thing == Scope::spring_body;
    case Scope::any_obstacle:
      return thing == Scope::plane || thing == Scope::sphere || thing == Scope::box;
    default:
      return thing == row;
  }
}

std::string parameter_prefix(Scope scope, std::string_view owner) {
  switch (scope) {
    case Scope::scene:
      return "";
    case Scope::fem_body:
    case Scope::spring_body:
    case Scope::any_body:
      return std::string(owner) + ".";
    case Scope::plane:
    case Scope::sphere:
    case Scope::box:
    case Scope::any_obstacle:
      return "contact." + std::string(owner) + ".";
    case Scope::handle:
      break;
  }
  return "handle." + std::string(owner) + ".";
}

const ParameterRow& parameter_row(Scope scope, std::string_view scene_key) {
  const auto rows = parameter_rows();
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const ParameterRow& row) {
    return row.scene_key == scene_key && has_rows_of(scope, row.scope);
  });
  FLEXCAST_CHECK(found != rows.end());
  return *found;
}

std::vector<ParameterDescriptor> make_descriptors(const Model& model, const Settings& settings) {
  std::vector<ParameterDescriptor> descriptors;
  const auto add = [&](Scope scope, std::string_view owner, std::size_t index) {
    for (const ParameterRow& row : parameter_rows()) {
      if (!has_rows_of(scope, row.scope)) continue;
      descriptors.push_back(
          {parameter_prefix(scope, owner) + std::string(row.name), &row, index, row.get(model, settings, index)});
    }
  };
  add(Scope::scene, "", 0);
  for (std::size_t i = 0; i < model.bodies.size(); ++i)
    add(model.bodies[i].is_fem() ? Scope::fem_body : Scope::spring_body, model.bodies[i].name, i);
  for (std::size_t i = 0; i < model.obstacles.size(); ++i)
    add(scope_of(model.obstacles[i].shape), model.obstacles[i].name, i);
  for (std::size_t i = 0; i < model.handles.size(); ++i) add(Scope::handle, model.handles[i].name, i);
  return descriptors;
}

Result<void> check_model(const Model& model) {
  for (const Obstacle& obstacle : model.obstacles) {
    const std::string prefix = parameter_prefix(Scope::any_obstacle, obstacle.name);
    if (obstacle.shape == Obstacle::Shape::plane && obstacle.normal == Vec3::Zero())
      return Error{prefix + "normal = " + to_text(obstacle.normal) +
                   " is not allowed: expected a vector that is not zero"};
    if (obstacle.shape == Obstacle::Shape::box && !(obstacle.lo.array() < obstacle.hi.array()).all())
      return Error{prefix + "lo = " + to_text(obstacle.lo) + " is not allowed: expected less than " + prefix +
                   "hi = " + to_text(obstacle.hi) + " along every axis"};
  }
  return {};
}

Result<ParameterValue> convert_parameter(const std::string& name, const ParameterRow& row,
                                         const ParameterValue& value) {
  const double* number = std::get_if<double>(&value);
  const std::int64_t* integer = std::get_if<std::int64_t>(&value);
  switch (row.kind) {
    case ParameterKind::number:
    case ParameterKind::integer: {
      if (!number && !integer) break;
      const double as_number = number ? *number : static_cast<double>(*integer);
      if (!row.range.contains(as_number)) break;
      if (row.kind == ParameterKind::number) return ParameterValue(as_number);
      if (as_number != std::floor(as_number) || std::abs(as_number) > 9007199254740992.0) break;
      return ParameterValue(static_cast<std::int64_t>(as_number));
    }
    case ParameterKind::vector: {
      const Vec3* vector = std::get_if<Vec3>(&value);
      const auto allowed = [&](double component) { return row.range.contains(component); };
      if (!vector || !std::all_of(vector->begin(), vector->end(), allowed)) break;
      return value;
    }
    case ParameterKind::choice: {
      const std::string* choice = std::get_if<std::string>(&value);
      if (!choice || std::find(row.choices.begin(), row.choices.end(), *choice) == row.choices.end()) break;
      return value;
    }
  }
  return make_error(name, row, value);
}

std::string to_text(const ParameterValue& value) {
  if (const auto* number = std::get_if<double>(&value)) return shortest_text(*number);
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return std::to_string(*integer);
  if (const auto* vector = std::get_if<Vec3>(&value)) {
    return "[" + shortest_text(vector->x()) + ", " + shortest_text(vector->y()) + ", " + shortest_text(vector->z()) +
           "]";
  }
  return "\"" + std::get<std::string>(value) + "\"";
}

Result<ParameterValue> parse_parameter_value(std::string_view text) {
  text = trimmed(text);
  if (text.empty()) return Error{"a value is missing"};
  std::int64_t integer = 0;
  if (read_integer(text, integer)) return ParameterValue(integer);
  double number = 0.0;
  if (read_number(text, number)) return ParameterValue(number);
  if (text.front() == '[') {
    Vec3 vector;
    std::string_view rest = text.substr(1);
    for (int i = 0; i < 3; ++i) {
      const std::size_t end = rest.find(i < 2 ? ',' : ']');
      const bool last_is_last = i < 2 || end + 1 == rest.size();
      if (end == std::string_view::npos || !last_is_last || !read_number(rest.substr(0, end), vector[i])) {
        return Error{std::string(text) + " is not a vector: expected three numbers such as [0, 0, -9.81]"};
      }
      rest.remove_prefix(end + 1);
    }
    return ParameterValue(vector);
  }
  const bool quoted = text.size() >= 2 && (text.front() == '"' || text.front() == '\'') && text.back() == text.front();
  return ParameterValue(std::string(quoted ? text.substr(1, text.size() - 2) : text));
}

}  // namespace flexcast
