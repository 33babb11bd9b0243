// RecordingFile: one MCAP file of a recording. Every recorded topic of the topic table is a channel.
#pragma once

#include <chrono>
#include <deque>
#include <map>
#include <memory>
#include <string_view>
#include <vector>

#include "clients/mcap/writer.h"
#include "clients/record/item_sink.h"
#include "idl/wire/frame_head.h"

namespace flexcast::record {

class RecordingFile final : public ItemSink {
 public:
  // The sink must outlive the file.
  static mcap::Result<std::unique_ptr<RecordingFile>> create(mcap::ByteSink& sink, mcap::Compression compression);

  mcap::Status write(const Item& item) override;
  mcap::Status flush_if_older(std::int64_t now) override {
    return writer_.flush_if_older(static_cast<mcap::Time>(now));
  }

  mcap::Status write_message(const Message& message) {
    return write_message(message.topic, message.sequence, message.log_time, message.publish_time, message.bytes);
  }
  mcap::Status write_message(wire::TopicId topic, std::uint32_t sequence, std::int64_t log_time,
                             std::int64_t publish_time, mcap::Bytes bytes);
  mcap::Status write_attachment(std::string_view name, std::string_view media_type, std::int64_t log_time,
                                mcap::Bytes bytes);
  mcap::Status add_metadata(std::string_view name, const mcap::TextPairs& values) {
    return writer_.add_metadata(name, values);
  }
  mcap::Status flush() { return writer_.flush(); }
  mcap::Status close() { return writer_.close(); }

  // After a failed write: leaves as many whole chunks as can be completed with `room` bytes of metadata. Gives the
  // frames (each chunk of them) that are not in the file any more. See mcap::Writer::cut_back().
  mcap::Result<std::vector<wire::FrameHead>> cut_back(std::uint64_t room);

  // Of a file that has no whole chunk yet: every frame (each chunk of it) that was to be written.
  std::vector<wire::FrameHead> frames_before_first_chunk() const;
  bool has_chunks() const { return writer_.totals().chunks > 0; }

  std::uint64_t bytes_written() const override { return writer_.bytes_written(); }
  std::uint64_t bytes_when_closed() const { return writer_.bytes_when_closed(); }
  std::uint64_t messages() const { return writer_.totals().messages; }

 private:
  struct RecentFrame {
    std::uint64_t message = 0;  // number within the file
    wire::FrameHead head;       // without the world
  };

  RecordingFile(mcap::ByteSink& sink, mcap::Compression compression)
      : writer_(sink, {.compression = compression, .chunk_interval = chunk_interval}) {}
  mcap::Status add_channels();
  mcap::Status write_note(const AccountNote& note);
  void note_frame(mcap::Bytes bytes);

  // With the time until somebody looks, a killed recorder loses a quarter of a second.
  static constexpr std::chrono::milliseconds chunk_interval{200};

  mcap::Writer writer_;
  std::map<wire::TopicId, mcap::ChannelId> channels_;
  std::deque<RecentFrame> recent_;  // frames that cut_back() may cut off
};

}  // namespace flexcast::record
