#include "clients/mcap/chunk_builder.h"

#include <algorithm>

#include "clients/mcap/encoder.h"

namespace flexcast::mcap {

ChunkBuilder::ChunkBuilder(std::size_t expected_bytes) {
  records_.reserve(expected_bytes);
}

void ChunkBuilder::add_record(Bytes record) {
  Encoder(records_).raw(record);
}

void ChunkBuilder::add_data(Bytes data) {
  Encoder(records_).raw(data);
}

void ChunkBuilder::add_message_head(ChannelId channel, std::uint32_t sequence, Time log_time, Time publish_time,
                                    std::size_t data_bytes) {
  constexpr std::uint64_t kFieldBytes = 2 + 4 + 8 + 8;
  if (channel >= messages_of_channel_.size()) messages_of_channel_.resize(std::size_t{channel} + 1);
  messages_of_channel_[channel].push_back({log_time, records_.size()});

  Encoder encoder(records_);
  encoder.record_prefix(Opcode::kMessage, kFieldBytes + data_bytes);
  encoder.u16(channel);
  encoder.u32(sequence);
  encoder.u64(log_time);
  encoder.u64(publish_time);

  if (!has_messages_) first_log_time_ = start_time_ = end_time_ = log_time;
  has_messages_ = true;
  start_time_ = std::min(start_time_, log_time);
  end_time_ = std::max(end_time_, log_time);
}

void ChunkBuilder::clear() {
  records_.clear();
  for (auto& messages : messages_of_channel_) messages.clear();
  has_messages_ = false;
  first_log_time_ = start_time_ = end_time_ = 0;
}

}  // namespace flexcast::mcap
