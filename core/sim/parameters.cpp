#include "core/sim/parameters.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/base/checks.h"

namespace flexcast {
namespace {

std::string number_text(double value) {
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

}  // namespace

const ParameterRow& parameter_row(ParameterRow::Scope scope, std::string_view scene_key) {
  const auto rows = parameter_rows();
  const bool of_body = scope != ParameterRow::Scope::scene;
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const ParameterRow& row) {
    return row.scene_key == scene_key &&
           (row.scope == scope || (of_body && row.scope == ParameterRow::Scope::any_body));
  });
  FLEXCAST_CHECK(found != rows.end());
  return *found;
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
  if (const auto* number = std::get_if<double>(&value)) return number_text(*number);
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return std::to_string(*integer);
  if (const auto* vector = std::get_if<Vec3>(&value)) {
    return "[" + number_text(vector->x()) + ", " + number_text(vector->y()) + ", " + number_text(vector->z()) + "]";
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
