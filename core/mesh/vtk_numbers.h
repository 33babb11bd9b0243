// The number types of VTK's files, and arrays of them as they lie in a file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace flexcast {

enum class NumberKind { signed_integer, unsigned_integer, real };

struct VtkNumberType {
  std::string_view name;
  NumberKind kind;
  std::size_t bytes;
};

// By the names of the legacy format ("vtktypeint64", "double", ...) or of the XML format ("Int64", "Float64", ...).
// Null: there is no such type here.
const VtkNumberType* find_legacy_type(std::string_view name);  // in any case
const VtkNumberType* find_xml_type(std::string_view name);

enum class ByteOrder { little, big };

// All values in `bytes`, whose size is a multiple of the type's.
std::vector<double> read_reals(std::string_view bytes, const VtkNumberType& type, ByteOrder order);
// The same for types that are no reals; nothing if one is larger than 2^63 - 1.
std::optional<std::vector<std::int64_t>> read_integers(std::string_view bytes, const VtkNumberType& type,
                                                       ByteOrder order);

}  // namespace flexcast
