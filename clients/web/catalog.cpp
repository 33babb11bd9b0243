#include "clients/web/catalog.h"

#include "clients/web/point_cloud.h"
#include "idl/wire/idl_text.h"

namespace flexcast::web {
namespace {

using wire::TopicId;

Flow flow_of(TopicId topic) {
  if (topic == TopicId::frames) return Flow::frames;
  return topic == TopicId::status || topic == TopicId::events ? Flow::log : Flow::state;
}

std::vector<ChannelRow> make_channel_table() {
  std::vector<ChannelRow> rows;
  for (const wire::TopicRow& topic : wire::topic_table()) {
    if (!topic.recorded || topic.id == TopicId::commands || topic.id == TopicId::replies) continue;
    rows.push_back({topic.name, topic.type_name, wire::idl_text(), flow_of(topic.id), topic.id});
  }
  rows.push_back({"flexcast/points", point_cloud_schema_name, point_cloud_idl(), Flow::points, TopicId::frames});
  return rows;
}

// The entry of that world and name, made if there is none.
template <class T>
T& find_or_make(std::vector<std::unique_ptr<T>>& entries,
                std::map<std::pair<std::string, std::string>, std::uint32_t>& ids, const std::string& world,
                const std::string& name) {
  const auto [found, is_new] = ids.try_emplace({world, name}, static_cast<std::uint32_t>(entries.size() + 1));
  if (is_new) {
    entries.push_back(std::make_unique<T>());
    entries.back()->id = found->second;
    entries.back()->world = world;
  }
  return *entries[found->second - 1];
}

}  // namespace

std::span<const ChannelRow> channel_table() {
  static const std::vector<ChannelRow> table = make_channel_table();
  return table;
}

std::vector<const Channel*> Catalog::channels(const std::string& world, const std::string& prefix) {
  std::vector<const Channel*> list;
  for (const ChannelRow& row : channel_table()) {
    const std::string topic = prefix + std::string(row.topic);
    Channel& channel = find_or_make(channels_, channel_ids_, world, topic);
    channel.topic = topic;
    channel.row = &row;
    list.push_back(&channel);
  }
  return list;
}

std::vector<const ServiceEntry*> Catalog::services(const std::string& world, const std::string& prefix) {
  std::vector<const ServiceEntry*> list;
  for (const Service& service : service_table()) {
    const std::string name = prefix + "flexcast/" + std::string(service.verb);
    ServiceEntry& entry = find_or_make(services_, service_ids_, world, name);
    entry.name = name;
    entry.service = &service;
    list.push_back(&entry);
  }
  return list;
}

const Channel* Catalog::find_channel(std::uint32_t id) const {
  return id >= 1 && id <= channels_.size() ? channels_[id - 1].get() : nullptr;
}

const ServiceEntry* Catalog::find_service(std::uint32_t id) const {
  return id >= 1 && id <= services_.size() ? services_[id - 1].get() : nullptr;
}

}  // namespace flexcast::web
