// FileSink: a ByteSink that writes a file through a small buffer.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "clients/mcap/byte_sink.h"

namespace flexcast::mcap {

struct FileSinkOptions {
  std::size_t buffer_bytes = std::size_t{64} * 1024;  // a longer write goes to the file directly
  bool replace_existing = false;  // false: a file that is there already is an error and stays as it is
};

// Every error names the path and the system's reason. After an error the file may end inside a record.
class FileSink final : public ByteSink {
 public:
  static Result<std::unique_ptr<FileSink>> create(const std::filesystem::path& path, FileSinkOptions options = {});

  // Hands over what is buffered and drops errors: call close() to see them.
  ~FileSink() override;
  FileSink(const FileSink&) = delete;
  FileSink& operator=(const FileSink&) = delete;

  Status write(Bytes bytes) override;

  // Gives the buffer to the operating system: a killed process loses nothing, a power failure may.
  Status flush() override;

  Status cut(std::uint64_t bytes) override;

  // Flushes, waits until the disk has the data and closes the file. Further writes fail.
  Status close();

 private:
  FileSink(std::filesystem::path path, int descriptor, std::size_t buffer_bytes);
  Status write_through(Bytes bytes);
  Status system_failure(const char* what) const;

  std::filesystem::path path_;
  int descriptor_;
  std::size_t buffer_bytes_;
  std::vector<std::byte> buffer_;
};

}  // namespace flexcast::mcap
