// Strict reading of one TOML table: every key is known, of the right type and in range, or SceneError says where it
// stands, what was found and what is allowed.
#pragma once

#include <toml++/toml.h>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/math.h"
#include "core/base/range.h"
#include "core/scene/place.h"

namespace flexcast {

// What a number may be.
struct Quantity {
  Range range;
  std::string_view unit;

  std::string text() const;  // "> 0, Pa"
};

// A table of the scene and where it stands.
struct TableEntry {
  const toml::table* table = nullptr;
  Place place;
};

// The file and line of a node, or the override that set it; `otherwise` for nodes that nobody wrote.
std::string source_text(const toml::node& node, const std::string& otherwise);

class TableReader {
 public:
  // Refuses a table with a key that is not among `keys`.
  TableReader(TableEntry entry, std::vector<std::string_view> keys);

  const Place& place() const { return entry_.place; }
  Place place_of(std::string_view key) const;
  bool has(std::string_view key) const { return find(key) != nullptr; }

  // Absent keys give no value; what is there must be right. require_... refuse an absent key.
  std::optional<double> number(std::string_view key, const Quantity& allowed) const;
  double require_number(std::string_view key, const Quantity& allowed) const;
  std::optional<std::int64_t> integer(std::string_view key, const Quantity& allowed) const;
  std::optional<Vec3> vector(std::string_view key, const Quantity& allowed) const;
  Vec3 require_vector(std::string_view key, const Quantity& allowed) const;
  std::optional<std::vector<double>> numbers(std::string_view key, std::size_t count, const Quantity& allowed) const;
  std::optional<std::vector<std::int64_t>> integers(std::string_view key, const Quantity& allowed) const;
  std::optional<std::string> text(std::string_view key) const;
  std::optional<std::string> choice(std::string_view key, const std::vector<std::string_view>& choices) const;
  std::optional<std::vector<std::string>> choices(std::string_view key,
                                                  const std::vector<std::string_view>& allowed) const;
  std::string require_choice(std::string_view key, const std::vector<std::string_view>& choices) const;
  std::string require_name(std::string_view key) const;  // [A-Za-z0-9_-]{1,64}
  void require_true(std::string_view key) const;         // nothing but true
  std::optional<TableEntry> table(std::string_view key) const;
  TableEntry require_table(std::string_view key) const;
  std::vector<TableEntry> tables(std::string_view key) const;  // an array of tables; absent: none
  std::optional<std::vector<std::vector<double>>> rows(std::string_view key, std::size_t row_count, std::size_t count,
                                                       const Quantity& allowed) const;

  // Refuse the key: KEY = VALUE WHAT, or: missing key KEY; expected EXPECTED.
  [[noreturn]] void refuse_value(std::string_view key, const std::string& what) const;
  [[noreturn]] void refuse_missing(std::string_view key, const std::string& expected) const;

 private:
  const toml::node* find(std::string_view key) const;
  void refuse_unknown(std::string_view key, const toml::node& value) const;

  TableEntry entry_;
  std::vector<std::string_view> keys_;
};

// Whether the text is a name: 1 to 64 of A-Z, a-z, 0-9, _ and -.
bool is_name(std::string_view text);

}  // namespace flexcast
