#include "core/scene/table_reader.h"

#include <algorithm>

#include "core/base/checks.h"
#include "core/scene/suggestion.h"
#include "core/scene/value_text.h"

namespace flexcast {
namespace {

constexpr std::string_view override_mark = "--set ";

std::string extend(const std::string& path, std::string_view key) {
  return path.empty() ? std::string(key) : path + "." + std::string(key);
}

[[noreturn]] void refuse_node(const Place& place, const toml::node& node, const std::string& what) {
  refuse(place, "= " + to_text(node) + " " + what);
}

[[noreturn]] void refuse_type(const Place& place, const toml::node& node, const std::string& expected) {
  refuse_node(place, node, "is " + std::string(type_text(node)) + "; expected " + expected);
}

[[noreturn]] void refuse_range(const Place& place, const toml::node& node, const Quantity& allowed) {
  refuse_node(place, node, "is out of range (allowed: " + allowed.text() + ")");
}

double to_number(const toml::node& node, const Place& place, const Quantity& allowed) {
  if (!node.is_number()) refuse_type(place, node, "a number (" + allowed.text() + ")");
  const double value =
      node.is_integer() ? static_cast<double>(node.as_integer()->get()) : node.as_floating_point()->get();
  if (!allowed.range.contains(value)) refuse_range(place, node, allowed);
  return value;
}

std::int64_t to_integer(const toml::node& node, const Place& place, const Quantity& allowed) {
  if (!node.is_integer()) refuse_type(place, node, "an integer (" + allowed.text() + ")");
  const std::int64_t value = node.as_integer()->get();
  if (!allowed.range.contains(static_cast<double>(value))) refuse_range(place, node, allowed);
  return value;
}

const std::string& to_choice(const toml::node& node, const Place& place, const std::vector<std::string_view>& choices) {
  if (!node.is_string()) refuse_type(place, node, "one of " + join_quoted(choices));
  const std::string& value = node.as_string()->get();
  if (std::find(choices.begin(), choices.end(), value) == choices.end())
    refuse_node(place, node, "is not known (allowed: " + join_quoted(choices) + ")" + calc_suggestion(value, choices));
  return value;
}

// Element `index` of an array: its place has the index in the key and its own line.
Place element_place(const Place& array, const toml::node& element, std::size_t index) {
  return {source_text(element, array.source), array.owner, array.key + "[" + std::to_string(index) + "]"};
}

std::vector<double> to_numbers(const toml::node& node, const Place& place, std::size_t count, const Quantity& allowed) {
  const std::string expected = "an array of " + std::to_string(count) + " numbers (" + allowed.text() + ")";
  const toml::array* array = node.as_array();
  if (!array) refuse_type(place, node, expected);
  if (array->size() != count)
    refuse_node(place, node, "has " + std::to_string(array->size()) + " elements; expected " + expected);
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i)
    values.push_back(to_number(*array->get(i), element_place(place, *array->get(i), i), allowed));
  return values;
}

}  // namespace

std::string Quantity::text() const {
  return range.text() + (unit.empty() || unit == "1" ? "" : ", " + std::string(unit));
}

bool is_name(std::string_view text) {
  constexpr std::string_view allowed = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-";
  return !text.empty() && text.size() <= 64 && text.find_first_not_of(allowed) == std::string_view::npos;
}

std::string source_text(const toml::node& node, const std::string& otherwise) {
  const toml::source_region& source = node.source();
  if (!source.path) return otherwise;
  const bool overridden = source.path->compare(0, override_mark.size(), override_mark) == 0;
  return overridden ? *source.path : *source.path + ":" + std::to_string(source.begin.line);
}

TableReader::TableReader(TableEntry entry, std::vector<std::string_view> keys)
    : entry_(std::move(entry)), keys_(std::move(keys)) {
  // The first in the order of the file, whatever the order of the table.
  const toml::node* first = nullptr;
  std::string_view first_key;
  for (const auto& [key, value] : *entry_.table) {
    if (std::find(keys_.begin(), keys_.end(), key.str()) != keys_.end()) continue;
    if (first && first->source().begin.line <= value.source().begin.line) continue;
    first = &value;
    first_key = key.str();
  }
  if (first) refuse_unknown(first_key, *first);
}

void TableReader::refuse_unknown(std::string_view key, const toml::node& value) const {
  const Place place = place_of(key);
  const std::string kind = value.is_table() || value.is_array_of_tables() ? "" : " = " + to_text(value);
  refuse_owner(place,
               "unknown key " + place.key + kind + " (allowed: " + join(keys_) + ")" + calc_suggestion(key, keys_));
}

const toml::node* TableReader::find(std::string_view key) const {
  FLEXCAST_CHECK(std::find(keys_.begin(), keys_.end(), key) != keys_.end());
  return entry_.table->get(key);
}

Place TableReader::place_of(std::string_view key) const {
  const toml::node* node = entry_.table->get(key);
  const Place& table = entry_.place;
  return {node ? source_text(*node, table.source) : table.source, table.owner, extend(table.key, key)};
}

void TableReader::refuse_value(std::string_view key, const std::string& what) const {
  refuse_node(place_of(key), *find(key), what);
}

void TableReader::refuse_missing(std::string_view key, const std::string& expected) const {
  refuse_owner(place(), "missing key " + extend(place().key, key) + "; expected " + expected);
}

std::optional<double> TableReader::number(std::string_view key, const Quantity& allowed) const {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  return to_number(*node, place_of(key), allowed);
}

double TableReader::require_number(std::string_view key, const Quantity& allowed) const {
  if (!has(key)) refuse_missing(key, "a number (" + allowed.text() + ")");
  return *number(key, allowed);
}

std::optional<std::int64_t> TableReader::integer(std::string_view key, const Quantity& allowed) const {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  return to_integer(*node, place_of(key), allowed);
}

std::optional<std::vector<double>> TableReader::numbers(std::string_view key, std::size_t count,
                                                        const Quantity& allowed) const {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  return to_numbers(*node, place_of(key), count, allowed);
}

std::optional<Vec3> TableReader::vector(std::string_view key, const Quantity& allowed) const {
  const auto values = numbers(key, 3, allowed);
  if (!values) return std::nullopt;
  return Vec3((*values)[0], (*values)[1], (*values)[2]);
}

Vec3 TableReader::require_vector(std::string_view key, const Quantity& allowed) const {
  if (!has(key)) refuse_missing(key, "an array of 3 numbers (" + allowed.text() + ")");
  return *vector(key, allowed);
}

std::optional<std::vector<std::vector<double>>> TableReader::rows(std::string_view key, std::size_t row_count,
                                                                  std::size_t count, const Quantity& allowed) const {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  const Place place = place_of(key);
  const toml::array* array = node->as_array();
  if (!array || array->size() != row_count)
    refuse_node(place, *node,
                "is not right; expected " + std::to_string(row_count) + " arrays of " + std::to_string(count) +
                    " numbers (" + allowed.text() + ")");
  std::vector<std::vector<double>> values;
  for (std::size_t i = 0; i < row_count; ++i)
    values.push_back(to_numbers(*array->get(i), element_place(place, *array->get(i), i), count, allowed));
  return values;
}

std::optional<std::vector<std::int64_t>> TableReader::integers(std::string_view key, const Quantity& allowed) const {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  const Place place = place_of(key);
  const toml::array* array = node->as_array();
  if (!array) refuse_type(place, *node, "an array of integers (" + allowed.text() + ")");
  std::vector<std::int64_t> values;
  for (const toml::node& element : *array)
    values.push_back(to_integer(element, element_place(place, element, values.size()), allowed));
  return values;
}

std::optional<std::string> TableReader::text(std::string_view key) const {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  if (!node->is_string()) refuse_type(place_of(key), *node, "a string");
  return node->as_string()->get();
}

std::optional<std::string> TableReader::choice(std::string_view key,
                                               const std::vector<std::string_view>& choices) const {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  return to_choice(*node, place_of(key), choices);
}

std::string TableReader::require_choice(std::string_view key, const std::vector<std::string_view>& choices) const {
  if (!has(key)) refuse_missing(key, "one of " + join_quoted(choices));
  return *choice(key, choices);
}

std::optional<std::vector<std::string>> TableReader::choices(std::string_view key,
                                                             const std::vector<std::string_view>& allowed) const {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  const Place place = place_of(key);
  const toml::array* array = node->as_array();
  if (!array) refuse_type(place, *node, "an array with some of " + join_quoted(allowed));
  if (array->empty()) refuse_node(place, *node, "is empty; expected some of " + join_quoted(allowed));
  std::vector<std::string> values;
  for (const toml::node& element : *array) {
    const Place here = element_place(place, element, values.size());
    const std::string& value = to_choice(element, here, allowed);
    if (std::find(values.begin(), values.end(), value) != values.end()) refuse_node(here, element, "is there twice");
    values.push_back(value);
  }
  return values;
}

std::string TableReader::require_name(std::string_view key) const {
  const std::string allowed = "1 to 64 of A-Z, a-z, 0-9, _ and -";
  if (!has(key)) refuse_missing(key, "a name (" + allowed + ")");
  std::string value = *text(key);
  if (!is_name(value)) refuse_value(key, "is not a name (allowed: " + allowed + ")");
  return value;
}

void TableReader::require_true(std::string_view key) const {
  const toml::node* node = find(key);
  if (!node) refuse_missing(key, "true");
  if (node->value_exact<bool>() != true) refuse_value(key, "is not right; expected true");
}

std::optional<TableEntry> TableReader::table(std::string_view key) const {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  const Place place = place_of(key);
  if (!node->is_table()) refuse_type(place, *node, "a table");
  return TableEntry{node->as_table(), place};
}

TableEntry TableReader::require_table(std::string_view key) const {
  if (!has(key)) refuse_missing(key, "a table");
  return *table(key);
}

std::vector<TableEntry> TableReader::tables(std::string_view key) const {
  const toml::node* node = find(key);
  if (!node) return {};
  const Place place = place_of(key);
  const toml::array* array = node->as_array();
  if (!array) refuse_type(place, *node, "an array of tables");
  std::vector<TableEntry> entries;
  for (const toml::node& element : *array) {
    const Place here = element_place(place, element, entries.size());
    if (!element.is_table()) refuse_type(here, element, "a table");
    entries.push_back({element.as_table(), here});
  }
  return entries;
}

}  // namespace flexcast
