#include "clients/record/open_file.h"

namespace flexcast::record {
namespace {

// What the metadata may grow by while the causes of the last gaps are written down.
constexpr std::uint64_t spare_room = 16 * 1024;

std::uint64_t size_of(const mcap::TextPairs& pairs) {
  std::uint64_t bytes = 0;
  for (const auto& [key, value] : pairs) bytes += 8 + key.size() + value.size();
  return bytes;
}

wire::Result<void> to_wire(const mcap::Status& status) {
  if (!status) return wire::Error{status.message()};
  return {};
}

}  // namespace

mcap::Status complete_file(RecordingFile& file, Report& report) {
  if (auto status = file.add_metadata("flexcast.recording", recording_metadata(report)); !status) return status;
  if (auto status = file.add_metadata("flexcast.gaps", gaps_metadata(report)); !status) return status;
  report.messages = file.messages();
  if (auto status = file.close(); !status) return status;
  report.bytes = file.bytes_written();
  return {};
}

wire::Result<OpenFile> OpenFile::create(const std::string& path, mcap::Compression compression, bool replace) {
  auto sink = mcap::FileSink::create(path, {.replace_existing = replace});
  if (!sink) return wire::Error{sink.status().message()};
  auto file = RecordingFile::create(*sink.value(), compression);
  if (!file) return wire::Error{file.status().message()};
  return OpenFile(path, std::move(sink).value(), std::move(file).value());
}

wire::Result<void> OpenFile::complete(Report& report) {
  if (auto status = complete_file(*file_, report); !status) return wire::Error{status.message()};
  return to_wire(sink_->close());
}

wire::Result<void> OpenFile::leave() {
  if (auto status = file_->flush(); !status) return wire::Error{status.message()};
  return to_wire(sink_->close());
}

wire::Result<std::vector<wire::FrameHead>> OpenFile::cut_back(const Report& report) {
  const std::uint64_t room = size_of(recording_metadata(report)) + size_of(gaps_metadata(report)) + spare_room;
  auto cut = file_->cut_back(room);
  if (!cut) return wire::Error{cut.status().message()};
  return std::move(cut).value();
}

}  // namespace flexcast::record
