#include "core/scene/value_text.h"

#include <charconv>
#include <sstream>

namespace flexcast {
namespace {

constexpr std::size_t longest = 60;

std::string in_quotes(std::string_view text) {
  std::string out = "\"";
  for (char c : text) {
    const bool between_characters = (static_cast<unsigned char>(c) & 0xc0) != 0x80;  // UTF-8
    if (out.size() > longest && between_characters) return out + "...\"";
    const bool control = static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
    if (c == '"' || c == '\\') out += '\\';
    out += control ? '?' : c;
  }
  return out + "\"";
}

std::string array_text(const toml::array& array) {
  std::string out = "[";
  for (const toml::node& element : array) {
    if (out.size() > 1) out += ", ";
    if (out.size() > longest) return out + "...]";
    out += to_text(element);
  }
  return out + "]";
}

}  // namespace

std::string number_text(double value) {
  char buffer[40];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  std::string text(buffer, end);
  return text.find_first_of(".enf") == std::string::npos ? text + ".0" : text;
}

std::string count_text(double count) {
  return count < 1e18 ? std::to_string(static_cast<std::int64_t>(count)) : number_text(count);
}

std::string to_text(const toml::node& value) {
  if (const auto* number = value.as_floating_point()) return number_text(number->get());
  if (const auto* number = value.as_integer()) return std::to_string(number->get());
  if (const auto* text = value.as_string()) return in_quotes(text->get());
  if (const auto* flag = value.as_boolean()) return flag->get() ? "true" : "false";
  if (const auto* array = value.as_array()) return array_text(*array);
  if (const auto* table = value.as_table()) return table->empty() ? "{}" : "{...}";
  std::ostringstream out;
  if (const auto* date = value.as_date()) out << date->get();
  if (const auto* time = value.as_time()) out << time->get();
  if (const auto* both = value.as_date_time()) out << both->get();
  return out.str();
}

std::string_view type_text(const toml::node& value) {
  switch (value.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return value.is_array_of_tables() ? "an array of tables" : "an array";
    case toml::node_type::string:
      return "a string";
    case toml::node_type::integer:
      return "an integer";
    case toml::node_type::floating_point:
      return "a number with decimals";
    case toml::node_type::boolean:
      return "a boolean";
    case toml::node_type::date:
    case toml::node_type::time:
    case toml::node_type::date_time:
      return "a date or time";
    case toml::node_type::none:
      break;
  }
  return "nothing";
}

}  // namespace flexcast
