// ChunkBuilder: the records of the chunk that is being filled, and where its messages are.
#pragma once

#include <vector>

#include "clients/mcap/types.h"

namespace flexcast::mcap {

struct MessageIndexEntry {
  Time log_time = 0;
  std::uint64_t offset = 0;  // of the message record in the unpacked chunk
};

class ChunkBuilder {
 public:
  // Buffers are kept from chunk to chunk; `expected_bytes` spares growing the first time.
  explicit ChunkBuilder(std::size_t expected_bytes);

  // A finished schema or channel record.
  void add_record(Bytes record);

  // A message up to its data, of which there are so many bytes: they follow by add_data(), or beside the builder as the
  // last of the chunk.
  void add_message_head(ChannelId channel, std::uint32_t sequence, Time log_time, Time publish_time,
                        std::size_t data_bytes);
  void add_data(Bytes data);

  // Starts the next chunk.
  void clear();

  Bytes records() const { return records_; }
  bool has_messages() const { return has_messages_; }

  // Log times of the message that came first and the smallest and largest of all; 0 without messages.
  Time first_log_time() const { return first_log_time_; }
  Time start_time() const { return start_time_; }
  Time end_time() const { return end_time_; }

  // The messages of one channel in the order they were added; at position `channel`, which may be empty.
  const std::vector<std::vector<MessageIndexEntry>>& messages_of_channel() const { return messages_of_channel_; }

 private:
  std::vector<std::byte> records_;
  std::vector<std::vector<MessageIndexEntry>> messages_of_channel_;
  bool has_messages_ = false;
  Time first_log_time_ = 0;
  Time start_time_ = 0;
  Time end_time_ = 0;
};

}  // namespace flexcast::mcap
