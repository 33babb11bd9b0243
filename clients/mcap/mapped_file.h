// MappedFile: a whole file as bytes, read only, paged in as it is read.
#pragma once

#include <filesystem>

#include "clients/mcap/status.h"
#include "clients/mcap/types.h"

namespace flexcast::mcap {

// The bytes are valid as long as this object, and the file must not be cut shorter meanwhile.
class MappedFile {
 public:
  // Errors name the path and the system's reason. What is appended after opening is not seen.
  static Result<MappedFile> open(const std::filesystem::path& path);

  ~MappedFile();
  MappedFile(MappedFile&& other) noexcept;
  MappedFile& operator=(MappedFile&& other) noexcept;

  Bytes bytes() const { return bytes_; }

 private:
  explicit MappedFile(Bytes bytes) : bytes_(bytes) {}

  Bytes bytes_;
};

}  // namespace flexcast::mcap
