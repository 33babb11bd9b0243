#include "clients/mcap/mapped_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

namespace flexcast::mcap {
namespace {

Result<Bytes> map(int descriptor, const std::string& path) {
  struct stat info = {};
  if (::fstat(descriptor, &info) != 0) return Status::failure("cannot read " + path + ": " + std::strerror(errno));
  if (!S_ISREG(info.st_mode)) return Status::failure("cannot read " + path + ": it is not a regular file");
  const auto size = static_cast<std::size_t>(info.st_size);
  if (size == 0) return Bytes();
  void* address = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor, 0);
  if (address == MAP_FAILED) return Status::failure("cannot read " + path + ": " + std::strerror(errno));
  ::madvise(address, size, MADV_SEQUENTIAL);
  return Bytes(static_cast<const std::byte*>(address), size);
}

}  // namespace

Result<MappedFile> MappedFile::open(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return Status::failure("cannot open " + path.string() + ": " + std::strerror(errno));
  const Result<Bytes> bytes = map(descriptor, path.string());
  ::close(descriptor);
  if (!bytes) return bytes.status();
  return MappedFile(bytes.value());
}

MappedFile::~MappedFile() {
  if (!bytes_.empty()) ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
}

MappedFile::MappedFile(MappedFile&& other) noexcept : bytes_(std::exchange(other.bytes_, Bytes())) {}

MappedFile& MappedFile::operator=(MappedFile&& other) noexcept {
  std::swap(bytes_, other.bytes_);
  return *this;
}

}  // namespace flexcast::mcap
