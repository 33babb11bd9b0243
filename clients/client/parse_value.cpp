// Reading values written as in TOML.
#include <algorithm>
#include <charconv>
#include <cmath>

#include "clients/client/value.h"

namespace flexcast::client {
namespace {

std::string_view trim(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// A number's text without its plus sign and the underscores between digits; empty if an underscore is elsewhere.
std::string plain(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  if (text.starts_with('+')) return {};
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '_')
      result += text[i];
    else if (i == 0 || i + 1 == text.size() || !is_digit(text[i - 1]) || !is_digit(text[i + 1]))
      return {};
  }
  return result;
}

template <class T>
std::optional<T> parse_number(std::string_view text) {
  const std::string digits = plain(text);
  T number{};
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc() || end != digits.data() + digits.size()) return {};
  return number;
}

// [x, y, z], the last comma optional, at least one number.
std::optional<std::vector<double>> parse_numbers(std::string_view text) {
  if (!text.starts_with('[') || !text.ends_with(']') || text.size() < 2) return {};
  text = trim(text.substr(1, text.size() - 2));
  if (text.ends_with(',')) text = trim(text.substr(0, text.size() - 1));
  std::vector<double> numbers;
  for (;;) {
    const std::size_t comma = std::min(text.find(','), text.size());
    const auto number = parse_number<double>(trim(text.substr(0, comma)));
    if (!number) return {};
    numbers.push_back(*number);
    if (comma == text.size()) return numbers;
    text.remove_prefix(comma + 1);
  }
}

// The text between double quotes, with \" and \\.
std::optional<std::string> unescape(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') return {};
    if (text[i] == '\\' && (++i == text.size() || (text[i] != '"' && text[i] != '\\'))) return {};
    result += text[i];
  }
  return result;
}

Result<Value> parse_quoted(std::string_view text) {
  const char quote = text.front();
  const Error bad{"a text that begins with a quote must end with one: " + std::string(text)};
  if (text.size() < 2 || text.back() != quote) return bad;
  const std::string_view inner = text.substr(1, text.size() - 2);
  if (quote == '\'') {
    if (inner.find('\'') != std::string_view::npos) return bad;
    return Value(std::string(inner));
  }
  if (auto content = unescape(inner)) return Value(std::move(*content));
  return bad;
}

}  // namespace

Result<Value> parse_value(std::string_view text, std::optional<flexcast_ValueKind> wanted) {
  text = trim(text);
  if (text.empty()) return Error{"a value is missing"};
  if (text.front() == '"' || text.front() == '\'') return parse_quoted(text);
  if (wanted == flexcast_VALUE_CHOICE) return Value(std::string(text));
  if (text.front() == '[') {
    const auto numbers = parse_numbers(text);
    if (!numbers || numbers->size() != 3) return Error{"a vector is written [x, y, z], not " + std::string(text)};
    return Value(Vector{(*numbers)[0], (*numbers)[1], (*numbers)[2]});
  }
  if (const auto integer = parse_number<std::int64_t>(text)) {
    if (wanted == flexcast_VALUE_NUMBER) return Value(static_cast<double>(*integer));
    return Value(*integer);
  }
  if (const auto number = parse_number<double>(text)) {
    const bool whole = std::abs(*number) < 9e15 && std::floor(*number) == *number;
    if (wanted == flexcast_VALUE_INTEGER && whole) return Value(static_cast<std::int64_t>(*number));
    return Value(*number);
  }
  if (text == "true" || text == "false") return Value(text == "true");
  return Value(std::string(text));
}

Result<Parameter> parse_assignment(std::string_view text, const std::vector<Descriptor>& descriptors) {
  const std::size_t equals = text.find('=');
  const std::string name(trim(text.substr(0, equals)));
  if (equals == std::string_view::npos || name.empty())
    return Error{"'" + std::string(text) + "' is not of the form NAME=VALUE"};
  std::optional<flexcast_ValueKind> wanted;
  for (const Descriptor& descriptor : descriptors)
    if (descriptor.name == name) wanted = descriptor.kind;
  auto value = parse_value(text.substr(equals + 1), wanted);
  if (!value) return Error{name + ": " + value.error().message};
  return Parameter{name, std::move(value).value()};
}

}  // namespace flexcast::client
