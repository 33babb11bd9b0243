// NewFile: a file that takes the place of another, or of none, only when it is whole and on the disk.
#pragma once

#include <memory>
#include <string>

#include "clients/mcap/file_sink.h"
#include "idl/wire/result.h"

namespace flexcast::record {

class NewFile {
 public:
  // Writes PATH.new until keep().
  static wire::Result<NewFile> create(const std::string& path);

  // Removes PATH.new unless it was kept.
  ~NewFile();
  NewFile(NewFile&&) noexcept = default;
  NewFile& operator=(NewFile&&) = delete;

  mcap::ByteSink& sink() { return *sink_; }

  // Waits for the disk and gives the file its name.
  wire::Result<void> keep();

 private:
  NewFile(std::string path, std::unique_ptr<mcap::FileSink> sink) : path_(std::move(path)), sink_(std::move(sink)) {}
  std::string temporary() const { return path_ + ".new"; }

  std::string path_;
  std::unique_ptr<mcap::FileSink> sink_;  // null: kept, or moved from
};

}  // namespace flexcast::record
