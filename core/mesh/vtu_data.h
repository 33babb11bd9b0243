// The data arrays of VTK's XML files as bytes: base64 or raw, in one piece or in blocks that zlib has compressed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/mesh/vtk_numbers.h"

namespace flexcast {

enum class VtuEncoding { raw, base64 };

// How a file writes all of its arrays.
struct VtuLayout {
  ByteOrder order = ByteOrder::little;
  std::size_t header_bytes = 4;  // of each number before the data: 4 or 8
  bool compressed = false;       // by zlib
};

// The array that begins where `source` does; what follows it there is not looked at. It must have `expected` bytes,
// which are not allocated before it is sure that the source can hold so many. Errors without a place.
// Source: "VTK XML file formats", and what VTK 9.1 writes.
Result<std::string> unpack_vtu_data(std::string_view source, VtuEncoding encoding, const VtuLayout& layout,
                                    std::uint64_t expected);

}  // namespace flexcast
