// RecordingCopy: a new MCAP file that takes over schemas, channels, messages, attachments and metadata of others, and
// keeps account of the frames.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>

#include "clients/mcap/reader.h"
#include "clients/mcap/writer.h"
#include "clients/record/content_ledger.h"
#include "clients/record/report.h"

namespace flexcast::record {

class RecordingCopy {
 public:
  // The sink must outlive the copy.
  RecordingCopy(mcap::ByteSink& sink, mcap::Compression compression) : writer_(sink, {.compression = compression}) {}

  // Takes over one record that `reader` has just given. Our own metadata stay behind: complete() writes them anew.
  mcap::Status take(const mcap::Reader& reader, const mcap::Record& record);

  const ContentLedger& ledger() const { return ledger_; }

  // Writes the metadata and the end. The report gets messages and bytes.
  mcap::Status complete(Report& report);

 private:
  struct Channel {
    mcap::ChannelId id = 0;              // in the copy
    std::optional<wire::TopicId> topic;  // if it is one of ours
  };
  mcap::Status take_message(const mcap::Reader& reader, const mcap::Message& message);
  mcap::Result<Channel> find_channel(const mcap::Reader& reader, mcap::ChannelId id);
  mcap::Result<Channel> make_channel(const mcap::Reader& reader, const mcap::ChannelInfo& channel);
  mcap::Result<mcap::SchemaId> find_schema(const mcap::SchemaInfo* schema);

  mcap::Writer writer_;
  ContentLedger ledger_;
  std::map<std::string, Channel> channels_;                                // by topic
  std::map<std::pair<std::string, std::string>, mcap::SchemaId> schemas_;  // by name and text
};

// The compression of the first chunk; lz4 if there is none.
mcap::Compression find_compression(mcap::Bytes file);

}  // namespace flexcast::record
