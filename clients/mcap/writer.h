// Writer: writes one MCAP file from the first magic byte to the last.
//
//   Writer writer(sink, {.compression = Compression::kZstd});
//   Result<SchemaId> schema = writer.add_schema("flexcast::ParticleFrame", "omgidl", idl_text);
//   Result<ChannelId> channel = writer.add_channel("flexcast/frames", "cdr", schema.value());
//   Status status = writer.write_message(channel.value(), frame, received, sent, bytes);
//   ...
//   status = writer.close();
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "clients/mcap/chunk_builder.h"
#include "clients/mcap/compression.h"
#include "clients/mcap/output.h"
#include "clients/mcap/summary_builder.h"
#include "clients/mcap/types.h"

namespace flexcast::mcap {

struct WriterOptions {
  std::string profile = {};
  std::string library = "flexcast " FLEXCAST_VERSION;
  Compression compression = Compression::kLz4;
  int zstd_level = 1;

  // A chunk is closed as soon as its records reach this many bytes before compression, or, without compression, after a
  // message of 256 KiB or more, which then goes to the sink without a copy ...
  std::size_t chunk_bytes = std::size_t{1024} * 1024;

  // ... or when a message, or flush_if_older(), is this much later than the first message in it.
  std::chrono::nanoseconds chunk_interval = std::chrono::milliseconds(250);

  bool chunk_crc = true;
  bool attachment_crc = true;
  bool data_crc = true;
  bool summary_crc = true;
};

// Used by one thread at a time. Schemas, channels and messages wait in memory until their chunk is closed; a closed
// chunk is flushed to the sink at once, so that a killed process loses the open chunk only. After the sink failed once,
// every call gives that failure. A wrong argument (an id that was never given out) fails without harm to the file.
class Writer {
 public:
  // The sink must outlive the writer. Trouble with the first bytes shows in the next call.
  explicit Writer(ByteSink& sink, WriterOptions options = {});

  // Does not close: the file then ends after the last closed chunk.
  ~Writer() = default;
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  // `encoding` names the schema language (omgidl), `data` is the schema itself.
  Result<SchemaId> add_schema(std::string_view name, std::string_view encoding, Bytes data);
  Result<SchemaId> add_schema(std::string_view name, std::string_view encoding, std::string_view data);

  // `schema` 0: messages without a schema.
  Result<ChannelId> add_channel(std::string_view topic, std::string_view message_encoding, SchemaId schema,
                                const TextPairs& metadata = {});

  // Times in nanoseconds since the epoch: of receipt and of sending. Log times need not increase.
  Status write_message(ChannelId channel, std::uint32_t sequence, Time log_time, Time publish_time, Bytes data);

  // Go into the file at once, between two chunks.
  Status add_attachment(std::string_view name, std::string_view media_type, Time log_time, Time create_time,
                        Bytes data);
  Status add_metadata(std::string_view name, const TextPairs& values);

  // Closes the chunk if its first message is `chunk_interval` older than `now` (on the clock of the log times). For
  // times when no messages come; call it a few times per interval.
  Status flush_if_older(Time now);

  // Closes the chunk whatever is in it.
  Status flush();

  // Closes the chunk, writes the summary and the end of the file and flushes the sink. Every later call fails.
  Status close();

  // After a failure of the sink: cuts the file back to the end of a whole chunk, so that what is left, `room` bytes
  // more (for metadata) and the summary need no more than what the sink has taken before it failed. The open chunk and
  // those behind are gone, and with them attachments and metadata written after that chunk; totals() says what is left.
  // Metadata can be added again, and close() completes the file. When that fails, too, the next call cuts further back.
  // Fails when there is nothing left to go back to, or the sink cannot be cut.
  Status cut_back(std::uint64_t room);

  // How many messages will be left at least after cut_back() with a `room` of 256 KiB at most.
  std::uint64_t safe_messages() const { return chunk_ends_.empty() ? 0 : chunk_ends_.front().summary.totals.messages; }

  // What the file would take if it were closed now, with everything uncompressed that is not written yet.
  std::uint64_t bytes_when_closed() const { return output_.offset() + chunk_.records().size() + summary_.bytes(); }

  // What the sink has got so far, without the open chunk.
  std::uint64_t bytes_written() const { return output_.offset(); }

  // Of everything added so far, the open chunk included.
  const Totals& totals() const { return summary_.totals(); }

 private:
  // The state of the file at the end of a chunk.
  struct ChunkEnd {
    std::uint64_t offset = 0;
    std::uint32_t crc = 0;
    std::uint64_t summary_bytes = 0;
    SummaryBuilder::Mark summary;
  };

  Status ready() const;
  void note_chunk_end();
  Status add_definition(Bytes record);
  bool is_due(Time now) const;
  Status write_chunk(Bytes last_data = {});
  Status write_chunk_record(Bytes records, Bytes last_data, ChunkPlace& place);
  Status write_message_indexes(ChunkPlace& place);

  WriterOptions options_;
  Output output_;
  ChunkBuilder chunk_;
  Compressor compressor_;
  SummaryBuilder summary_;
  std::vector<std::byte> scratch_;
  std::deque<ChunkEnd> chunk_ends_;  // the last ones, as many as cut_back() may need
  std::uint64_t sound_bytes_ = 0;    // the sink has taken them
  bool closed_ = false;
};

}  // namespace flexcast::mcap
