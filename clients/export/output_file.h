// Files that are written from the first byte to the last.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "idl/wire/result.h"

namespace flexcast::exporting {

class OutputFile {
 public:
  // Replaces what is there. Errors name the file and the system's reason.
  static wire::Result<OutputFile> create(const std::filesystem::path& path);

  wire::Result<void> write(std::string_view content);
  wire::Result<void> close();  // once, at the end

  std::uint64_t bytes() const { return bytes_; }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  OutputFile(std::string path, std::FILE* file) : path_(std::move(path)), file_(file) {}
  wire::Error failure() const;

  std::string path_;
  std::unique_ptr<std::FILE, Close> file_;
  std::uint64_t bytes_ = 0;
};

// A whole file in one go.
wire::Result<void> write_file(const std::filesystem::path& path, std::string_view content);

// An error if there is such a file and it may not be replaced.
wire::Result<void> check_replaceable(const std::filesystem::path& path, bool force);

}  // namespace flexcast::exporting
