// RecordingFile: the MCAP file of a recording. Every recorded topic of the topic table is a channel.
#pragma once

#include <map>
#include <memory>
#include <string_view>

#include "clients/mcap/writer.h"
#include "clients/record/item.h"

namespace flexcast::record {

class RecordingFile {
 public:
  // The sink must outlive the file.
  static mcap::Result<std::unique_ptr<RecordingFile>> create(mcap::ByteSink& sink, mcap::Compression compression);

  mcap::Status write(const Item& item);

  // For times when nothing comes: hands a chunk that is old enough to the disk. `now`: ns since 1970.
  mcap::Status flush_if_older(std::int64_t now) { return writer_.flush_if_older(static_cast<mcap::Time>(now)); }

  mcap::Status add_metadata(std::string_view name, const mcap::TextPairs& values) {
    return writer_.add_metadata(name, values);
  }
  mcap::Status close() { return writer_.close(); }

  std::uint64_t bytes_written() const { return writer_.bytes_written(); }
  std::uint64_t messages() const { return writer_.totals().messages; }

 private:
  RecordingFile(mcap::ByteSink& sink, mcap::Compression compression) : writer_(sink, {.compression = compression}) {}
  mcap::Status add_channels();

  mcap::Writer writer_;
  std::map<wire::TopicId, mcap::ChannelId> channels_;
};

}  // namespace flexcast::record
