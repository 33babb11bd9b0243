// OpenFile: a recording on the disk that is being written.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "clients/mcap/file_sink.h"
#include "clients/record/recording_file.h"
#include "clients/record/report.h"
#include "idl/wire/result.h"

namespace flexcast::record {

class OpenFile {
 public:
  static wire::Result<OpenFile> create(const std::string& path, mcap::Compression compression, bool replace);

  RecordingFile& file() { return *file_; }
  const RecordingFile& file() const { return *file_; }
  const std::string& path() const { return path_; }

  // Writes metadata and end, waits for the disk; tells the report the size of the file.
  wire::Result<void> complete(Report& report);

  // Hands everything to the disk and closes the file without an end.
  wire::Result<void> leave();

  // See RecordingFile::cut_back(); leaves room for the metadata of `report`.
  wire::Result<std::vector<wire::FrameHead>> cut_back(const Report& report);

 private:
  OpenFile(std::string path, std::unique_ptr<mcap::FileSink> sink, std::unique_ptr<RecordingFile> file)
      : path_(std::move(path)), sink_(std::move(sink)), file_(std::move(file)) {}

  std::string path_;
  std::unique_ptr<mcap::FileSink> sink_;  // before the file that writes to it
  std::unique_ptr<RecordingFile> file_;
};

// Adds flexcast.recording and flexcast.gaps and completes the file; tells the report messages and bytes.
mcap::Status complete_file(RecordingFile& file, Report& report);

}  // namespace flexcast::record
