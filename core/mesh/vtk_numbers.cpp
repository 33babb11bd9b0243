#include "core/mesh/vtk_numbers.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <limits>
#include <string>

namespace flexcast {
namespace {

using enum NumberKind;

constexpr std::array legacy_types = {
    VtkNumberType{"char", signed_integer, 1},
    VtkNumberType{"unsigned_char", unsigned_integer, 1},
    VtkNumberType{"short", signed_integer, 2},
    VtkNumberType{"unsigned_short", unsigned_integer, 2},
    VtkNumberType{"int", signed_integer, 4},
    VtkNumberType{"unsigned_int", unsigned_integer, 4},
    VtkNumberType{"long", signed_integer, 8},
    VtkNumberType{"unsigned_long", unsigned_integer, 8},
    VtkNumberType{"vtkidtype", signed_integer, 4},  // VTK writes its ids as int
    VtkNumberType{"vtktypeint64", signed_integer, 8},
    VtkNumberType{"vtktypeuint64", unsigned_integer, 8},
    VtkNumberType{"vtktypeint32", signed_integer, 4},
    VtkNumberType{"vtktypeuint32", unsigned_integer, 4},
    VtkNumberType{"vtktypeint16", signed_integer, 2},
    VtkNumberType{"vtktypeuint16", unsigned_integer, 2},
    VtkNumberType{"vtktypeint8", signed_integer, 1},
    VtkNumberType{"vtktypeuint8", unsigned_integer, 1},
    VtkNumberType{"float", real, 4},
    VtkNumberType{"double", real, 8},
};

constexpr std::array xml_types = {
    VtkNumberType{"Int8", signed_integer, 1},  VtkNumberType{"UInt8", unsigned_integer, 1},
    VtkNumberType{"Int16", signed_integer, 2}, VtkNumberType{"UInt16", unsigned_integer, 2},
    VtkNumberType{"Int32", signed_integer, 4}, VtkNumberType{"UInt32", unsigned_integer, 4},
    VtkNumberType{"Int64", signed_integer, 8}, VtkNumberType{"UInt64", unsigned_integer, 8},
    VtkNumberType{"Float32", real, 4},         VtkNumberType{"Float64", real, 8},
};

template <std::size_t N>
const VtkNumberType* find(const std::array<VtkNumberType, N>& types, std::string_view name) {
  const auto found = std::find_if(types.begin(), types.end(), [&](const auto& type) { return type.name == name; });
  return found == types.end() ? nullptr : &*found;
}

// The value's bits, from the lowest byte on.
std::uint64_t load(const char* bytes, std::size_t count, ByteOrder order) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto byte = static_cast<unsigned char>(bytes[order == ByteOrder::little ? count - 1 - i : i]);
    bits = bits << 8 | byte;
  }
  return bits;
}

std::int64_t extend_sign(std::uint64_t bits, std::size_t bytes) {
  const unsigned unused = 64 - 8 * static_cast<unsigned>(bytes);
  return static_cast<std::int64_t>(bits << unused) >> unused;
}

double to_real(std::uint64_t bits, const VtkNumberType& type) {
  if (type.kind == signed_integer) return static_cast<double>(extend_sign(bits, type.bytes));
  if (type.kind == unsigned_integer) return static_cast<double>(bits);
  return type.bytes == 4 ? double{std::bit_cast<float>(static_cast<std::uint32_t>(bits))} : std::bit_cast<double>(bits);
}

}  // namespace

const VtkNumberType* find_legacy_type(std::string_view name) {
  std::string lower(name);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
  return find(legacy_types, lower);
}

const VtkNumberType* find_xml_type(std::string_view name) {
  return find(xml_types, name);
}

std::vector<double> read_reals(std::string_view bytes, const VtkNumberType& type, ByteOrder order) {
  std::vector<double> values(bytes.size() / type.bytes);
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = to_real(load(bytes.data() + i * type.bytes, type.bytes, order), type);
  }
  return values;
}

std::optional<std::vector<std::int64_t>> read_integers(std::string_view bytes, const VtkNumberType& type,
                                                       ByteOrder order) {
  std::vector<std::int64_t> values(bytes.size() / type.bytes);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::uint64_t bits = load(bytes.data() + i * type.bytes, type.bytes, order);
    values[i] = type.kind == signed_integer ? extend_sign(bits, type.bytes) : static_cast<std::int64_t>(bits);
    constexpr auto largest = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
    if (type.kind == unsigned_integer && bits > largest) return std::nullopt;
  }
  return values;
}

}  // namespace flexcast
