// Definitions: the schemas and channels a reader has met, as copies that outlive the records they came in.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "clients/mcap/records.h"
#include "clients/mcap/status.h"

namespace flexcast::mcap {

struct SchemaInfo {
  std::string name;
  std::string encoding;
  std::string data;

  bool operator==(const SchemaInfo&) const = default;
};

struct ChannelInfo {
  SchemaId schema = 0;
  std::string topic;
  std::string message_encoding;
  TextPairs metadata;

  bool operator==(const ChannelInfo&) const = default;
};

class Definitions {
 public:
  // All copies together take about `max_bytes` at most.
  explicit Definitions(std::uint64_t max_bytes) : max_bytes_(max_bytes), bytes_left_(max_bytes) {}

  // Fails if the id stands for something else already, if the schema of a channel is not there or over the limit.
  Status add(const Schema& schema);
  Status add(const Channel& channel);

  // Null if there is none.
  const SchemaInfo* schema(SchemaId id) const;
  const ChannelInfo* channel(ChannelId id) const;

  const std::map<SchemaId, SchemaInfo>& schemas() const { return schemas_; }
  const std::map<ChannelId, ChannelInfo>& channels() const { return channels_; }

 private:
  template <class Id, class Info>
  Status insert(std::map<Id, Info>& infos, Id id, Info info, std::uint64_t bytes, const char* kind);

  std::uint64_t max_bytes_;
  std::uint64_t bytes_left_;
  std::map<SchemaId, SchemaInfo> schemas_;
  std::map<ChannelId, ChannelInfo> channels_;
};

}  // namespace flexcast::mcap
