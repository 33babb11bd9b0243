#include "clients/record/new_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <filesystem>

namespace flexcast::record {
namespace {

namespace fs = std::filesystem;

// So that the new name outlives a power failure. Not every file system can: that is no failure.
void flush_folder(const fs::path& file) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  (void)::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace

wire::Result<NewFile> NewFile::create(const std::string& path) {
  auto sink = mcap::FileSink::create(path + ".new", {.replace_existing = true});
  if (!sink) return wire::Error{sink.status().message()};
  return NewFile(path, std::move(sink).value());
}

NewFile::~NewFile() {
  if (!sink_) return;
  sink_.reset();
  std::error_code ignored;
  fs::remove(temporary(), ignored);
}

wire::Result<void> NewFile::keep() {
  if (auto status = sink_->close(); !status) return wire::Error{status.message()};
  std::error_code error;
  fs::rename(temporary(), path_, error);
  if (error) return wire::Error{"cannot rename " + temporary() + " to " + path_ + ": " + error.message()};
  sink_.reset();
  flush_folder(path_);
  return {};
}

}  // namespace flexcast::record
