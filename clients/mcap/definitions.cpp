#include "clients/mcap/definitions.h"

#include <utility>

namespace flexcast::mcap {
namespace {

// What a definition takes besides its text, and a pair of metadata besides its eight bytes of lengths, roughly.
constexpr std::uint64_t kNodeBytes = 256;
constexpr std::uint64_t kMetadataFactor = 16;

Status over_limit() {
  return Status::failure("the schemas and channels take more memory than allowed");
}

}  // namespace

Status Definitions::add(const Schema& schema) {
  if (schema.id == 0) return Status::failure("a schema has the reserved id 0");
  const std::uint64_t bytes = kNodeBytes + schema.name.size() + schema.encoding.size() + schema.data.size();
  if (bytes > (schemas_.contains(schema.id) ? max_bytes_ : bytes_left_)) return over_limit();
  SchemaInfo info = {.name = std::string(schema.name),
                     .encoding = std::string(schema.encoding),
                     .data = std::string(reinterpret_cast<const char*>(schema.data.data()), schema.data.size())};
  return insert(schemas_, schema.id, std::move(info), bytes, "schema");
}

Status Definitions::add(const Channel& channel) {
  if (channel.schema != 0 && !schemas_.contains(channel.schema)) {
    return Status::failure("channel " + std::to_string(channel.id) + " names schema " + std::to_string(channel.schema) +
                           ", which is not there");
  }
  const std::uint64_t bytes = kNodeBytes + channel.topic.size() + channel.message_encoding.size() +
                              kMetadataFactor * channel.metadata.bytes().size();
  if (bytes > (channels_.contains(channel.id) ? max_bytes_ : bytes_left_)) return over_limit();
  ChannelInfo info = {.schema = channel.schema,
                      .topic = std::string(channel.topic),
                      .message_encoding = std::string(channel.message_encoding),
                      .metadata = channel.metadata.copy()};
  return insert(channels_, channel.id, std::move(info), bytes, "channel");
}

const SchemaInfo* Definitions::schema(SchemaId id) const {
  const auto found = schemas_.find(id);
  return found == schemas_.end() ? nullptr : &found->second;
}

const ChannelInfo* Definitions::channel(ChannelId id) const {
  const auto found = channels_.find(id);
  return found == channels_.end() ? nullptr : &found->second;
}

template <class Id, class Info>
Status Definitions::insert(std::map<Id, Info>& infos, Id id, Info info, std::uint64_t bytes, const char* kind) {
  if (const auto found = infos.find(id); found != infos.end()) {
    if (found->second == info) return {};
    return Status::failure(std::string(kind) + " " + std::to_string(id) + " is defined twice and differently");
  }
  infos.emplace(id, std::move(info));
  bytes_left_ -= bytes;
  return {};
}

}  // namespace flexcast::mcap
