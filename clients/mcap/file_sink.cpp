#include "clients/mcap/file_sink.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace flexcast::mcap {

Result<std::unique_ptr<FileSink>> FileSink::create(const std::filesystem::path& path, FileSinkOptions options) {
  const int existing = options.replace_existing ? O_TRUNC : O_EXCL;
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | existing, 0666);
  if (descriptor < 0) return Status::failure("cannot create " + path.string() + ": " + std::strerror(errno));
  return std::unique_ptr<FileSink>(new FileSink(path, descriptor, options.buffer_bytes));
}

FileSink::FileSink(std::filesystem::path path, int descriptor, std::size_t buffer_bytes)
    : path_(std::move(path)), descriptor_(descriptor), buffer_bytes_(buffer_bytes) {
  buffer_.reserve(buffer_bytes_);
}

FileSink::~FileSink() {
  if (descriptor_ < 0) return;
  static_cast<void>(flush());
  ::close(descriptor_);
}

Status FileSink::write(Bytes bytes) {
  if (descriptor_ < 0) return Status::failure("cannot write " + path_.string() + ": it is closed");
  if (buffer_.size() + bytes.size() > buffer_bytes_) {
    if (Status status = flush(); !status) return status;
  }
  if (bytes.size() > buffer_bytes_) return write_through(bytes);
  buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
  return {};
}

Status FileSink::flush() {
  // What could not be written is dropped: a second try would leave a hole or a repetition in the file.
  Status status = write_through(buffer_);
  buffer_.clear();
  return status;
}

Status FileSink::cut(std::uint64_t bytes) {
  buffer_.clear();
  const auto end = static_cast<off_t>(bytes);
  if (::ftruncate(descriptor_, end) != 0 || ::lseek(descriptor_, end, SEEK_SET) != end) return system_failure("cut");
  return {};
}

Status FileSink::close() {
  if (descriptor_ < 0) return {};
  Status status = flush();
  // EINVAL and EROFS: a pipe or a device, which has no disk to wait for.
  if (status && ::fsync(descriptor_) != 0 && errno != EINVAL && errno != EROFS) status = system_failure("write");
  if (::close(std::exchange(descriptor_, -1)) != 0 && status) status = system_failure("close");
  return status;
}

Status FileSink::write_through(Bytes bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return system_failure("write");
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return {};
}

Status FileSink::system_failure(const char* what) const {
  const int reason = errno;
  return Status::failure(std::string("cannot ") + what + " " + path_.string() + ": " + std::strerror(reason));
}

}  // namespace flexcast::mcap
