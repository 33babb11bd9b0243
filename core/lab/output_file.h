// A file of results: what cannot be written is an error, never a silent loss.
#pragma once

#include <filesystem>
#include <fstream>
#include <memory>
#include <ostream>
#include <string>

#include "core/base/result.h"

namespace flexcast {

class OutputFile {
 public:
  static Result<OutputFile> open(const std::filesystem::path& path);

  std::ostream& stream() { return *stream_; }  // has a stable address
  // Everything is on its way to the disk, or the error that names the file and the reason.
  Result<void> close();

 private:
  OutputFile() = default;

  std::filesystem::path path_;
  std::unique_ptr<std::ofstream> stream_;
};

// 17 significant digits: reads back as the same double.
std::string exact_text(double value);

}  // namespace flexcast
