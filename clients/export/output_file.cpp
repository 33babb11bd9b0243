#include "clients/export/output_file.h"

#include <cerrno>
#include <cstring>

namespace flexcast::exporting {

wire::Result<OutputFile> OutputFile::create(const std::filesystem::path& path) {
  OutputFile file(path.string(), std::fopen(path.c_str(), "wb"));
  if (!file.file_) return file.failure();
  return file;
}

wire::Result<void> OutputFile::write(std::string_view content) {
  if (std::fwrite(content.data(), 1, content.size(), file_.get()) != content.size()) return failure();
  bytes_ += content.size();
  return {};
}

wire::Result<void> OutputFile::close() {
  if (std::fclose(file_.release()) != 0) return failure();
  return {};
}

wire::Error OutputFile::failure() const {
  return {"cannot write " + path_ + ": " + std::strerror(errno)};
}

wire::Result<void> write_file(const std::filesystem::path& path, std::string_view content) {
  auto file = OutputFile::create(path);
  if (!file) return file.error();
  if (auto written = file.value().write(content); !written) return written;
  return file.value().close();
}

wire::Result<void> check_replaceable(const std::filesystem::path& path, bool force) {
  std::error_code ignored;
  if (force || !std::filesystem::exists(path, ignored)) return {};
  return wire::Error{path.string() + " exists already; --force replaces it"};
}

}  // namespace flexcast::exporting
