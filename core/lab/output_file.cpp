#include "core/lab/output_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace flexcast {
namespace {

Error make_error(const std::filesystem::path& path) {
  return {path.string() + ": cannot be written: " + (errno ? std::strerror(errno) : "unknown reason")};
}

}  // namespace

Result<OutputFile> OutputFile::open(const std::filesystem::path& path) {
  errno = 0;
  OutputFile file;
  file.path_ = path;
  file.stream_ = std::make_unique<std::ofstream>(path, std::ios::binary);
  if (!*file.stream_) return make_error(path);
  return file;
}

Result<void> OutputFile::close() {
  errno = 0;
  stream_->close();
  if (stream_->fail()) return make_error(path_);
  return {};
}

std::string exact_text(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

}  // namespace flexcast
