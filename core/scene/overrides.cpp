#include "core/scene/overrides.h"

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "core/scene/keys.h"
#include "core/scene/place.h"
#include "core/scene/suggestion.h"
#include "core/scene/value_text.h"
#include "core/sim/parameters.h"

namespace flexcast {
namespace {

using Keys = std::vector<std::string_view>;
using Scope = ParameterRow::Scope;

Keys split(std::string_view path) {
  Keys keys;
  for (std::size_t first = 0;;) {
    const std::size_t dot = path.find('.', first);
    keys.push_back(path.substr(first, dot == std::string_view::npos ? dot : dot - first));
    if (dot == std::string_view::npos) return keys;
    first = dot + 1;
  }
}

bool is_word(std::string_view text) {
  constexpr std::string_view allowed = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-./";
  return !text.empty() && text.find_first_not_of(allowed) == std::string_view::npos;
}

// A table with the one key "value".
toml::table parse_value(const std::string& value, const std::string& source) {
  try {
    toml::table parsed = toml::parse("value = " + value + "\n", source);
    if (parsed.size() == 1) return parsed;
    throw SceneError(source + ": the value is more than one TOML value");
  } catch (const toml::parse_error& error) {
    if (is_word(value)) return parse_value("\"" + value + "\"", source);
    throw SceneError(source + ": the value is not TOML: " + std::string(error.description()));
  }
}

// The tables of [[body]], [[probe]] or [[contact]], or a body's handles.
std::vector<toml::table*> tables_of(toml::table& owner, std::string_view kind) {
  std::vector<toml::table*> tables;
  if (toml::array* entries = owner[kind].as_array())
    for (toml::node& entry : *entries)
      if (toml::table* table = entry.as_table()) tables.push_back(table);
  return tables;
}

std::vector<toml::table*> handles_of(toml::table& document) {
  std::vector<toml::table*> handles;
  for (toml::table* body : tables_of(document, "body"))
    for (toml::table* handle : tables_of(*body, "handle")) handles.push_back(handle);
  return handles;
}

toml::table* find_named(const std::vector<toml::table*>& tables, std::string_view name) {
  const auto found = std::ranges::find_if(
      tables, [&](toml::table* table) { return (*table)["name"].value<std::string_view>() == name; });
  return found == tables.end() ? nullptr : *found;
}

Keys names_of(const std::vector<toml::table*>& tables) {
  Keys names;
  for (const toml::table* table : tables)
    if (const auto* name = table->get_as<std::string>("name")) names.push_back(name->get());
  return names;
}

Keys known_first_keys(toml::table& document) {
  Keys known;
  for (std::string_view key : scene_keys())
    if (key != "body" && key != "probe") known.push_back(key);
  if (!handles_of(document).empty()) known.push_back("handle");
  for (std::string_view kind : {"body", "probe"})
    for (std::string_view name : names_of(tables_of(document, kind))) known.push_back(name);
  return known;
}

// The scene key of the parameter with this name, when there is one in the scope. A table is never a parameter's value.
std::optional<std::string_view> find_scene_key(Scope scope, std::string_view name, const toml::node& value) {
  if (value.is_table()) return std::nullopt;
  for (const ParameterRow& row : parameter_rows()) {
    if (has_rows_of(scope, row.scope) && row.name == name) return row.scene_key;
  }
  return std::nullopt;
}

// What excludes the key in the same table, or nothing.
std::string_view find_alternative(std::string_view key) {
  constexpr std::pair<std::string_view, std::string_view> alternatives[] = {{"mass", "total_mass"}, {"at", "node"}};
  for (const auto& [one, other] : alternatives) {
    if (key == one) return other;
    if (key == other) return one;
  }
  return {};
}

// Puts the value where the keys lead; tables on the way are made when they are missing.
void put(toml::table& start, std::string_view path, toml::node&& value, const std::string& source) {
  toml::table* table = &start;
  const Keys keys = split(path);
  for (std::string_view key : std::span(keys).first(keys.size() - 1)) {
    if (!table->contains(key)) table->insert(key, toml::table{});
    toml::node& next = *table->get(key);
    if (!next.is_table())
      throw SceneError(source + ": " + std::string(key) + " is " + std::string(type_text(next)) +
                       ", which has no keys; set " + std::string(key) + " as a whole");
    table = next.as_table();
  }
  table->insert_or_assign(keys.back(), std::move(value));
  // Bodies and probes have exclusive keys at their top only ("damping.mass" excludes nothing).
  if (keys.size() == 1 && table == &start) table->erase(find_alternative(keys.back()));
}

// KIND.NAME.KEY with the tables of that kind.
void put_named(const std::vector<toml::table*>& tables, const Keys& keys, std::string_view path, toml::node&& value,
               const std::string& source) {
  const std::string kind(keys[0]);
  if (keys.size() < 3) throw SceneError(source + ": expected " + kind + ".NAME.KEY=VALUE");
  const Keys names = names_of(tables);
  if (std::ranges::find(names, keys[1]) == names.end())
    throw SceneError(source + ": there is no " + kind + " " + std::string(keys[1]) +
                     (names.empty() ? "" : " (known: " + join(names) + ")") + calc_suggestion(keys[1], names));
  put(*find_named(tables, keys[1]), path.substr(keys[0].size() + keys[1].size() + 2), std::move(value), source);
}

}  // namespace

void apply_override(toml::table& document, const std::string& assignment) {
  const std::string source = "--set " + assignment;
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0) throw SceneError(source + ": expected PATH=VALUE");
  const std::string_view path = std::string_view(assignment).substr(0, equals);
  const Keys keys = split(path);
  if (std::ranges::find(keys, "") != keys.end()) throw SceneError(source + ": the path has an empty part");

  toml::table parsed = parse_value(assignment.substr(equals + 1), source);
  toml::node& value = *parsed.get("value");
  const bool whole = keys.size() == 1;
  if (keys[0] == "contact" && !whole)
    return put_named(tables_of(document, "contact"), keys, path, std::move(value), source);
  if (keys[0] == "handle") return put_named(handles_of(document), keys, path, std::move(value), source);
  toml::table* body = find_named(tables_of(document, "body"), keys[0]);
  toml::table* named = body ? body : find_named(tables_of(document, "probe"), keys[0]);
  if (!named) {
    const Keys known = known_first_keys(document);
    if (std::ranges::find(known, keys[0]) == known.end())
      throw SceneError(source + ": there is no " + std::string(keys[0]) + " (known: " + join(known) + ")" +
                       calc_suggestion(keys[0], known));
    put(document, find_scene_key(Scope::scene, path, value).value_or(path), std::move(value), source);
    return;
  }
  if (whole) throw SceneError(source + ": expected a key below " + std::string(keys[0]));
  const std::string_view below = path.substr(keys[0].size() + 1);
  const bool fem = (*named)["model"].value<std::string_view>() == "fem";
  const auto key = body ? find_scene_key(fem ? Scope::fem_body : Scope::spring_body, below, value) : std::nullopt;
  put(*named, key.value_or(below), std::move(value), source);
}

}  // namespace flexcast
