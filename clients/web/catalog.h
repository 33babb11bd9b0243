// Catalog: the channels and services of all worlds, each with a number that it keeps as long as the program runs.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clients/web/services.h"
#include "idl/wire/topics.h"

namespace flexcast::web {

// How a channel's samples are kept and sent.
enum class Flow {
  state,   // the newest of each key
  log,     // all of them
  frames,  // the newest whole one
  points,  // the same as a point cloud
};

struct ChannelRow {
  std::string_view topic;  // "flexcast/frames"
  std::string_view schema_name, schema;
  Flow flow;
  wire::TopicId id;  // points: frames
};

// The recorded topics but for commands and replies, and the points; in the order in which a new subscriber gets them.
std::span<const ChannelRow> channel_table();

struct Channel {
  std::uint32_t id = 0;
  std::string topic;  // with the world's prefix
  std::string world;
  const ChannelRow* row = nullptr;
};

struct ServiceEntry {
  std::uint32_t id = 0;
  std::string name;  // "WORLD/flexcast/pause"
  std::string world;
  const Service* service = nullptr;
};

class Catalog {
 public:
  // Those of a world; the same ones for the same world and prefix, however often it comes and goes.
  std::vector<const Channel*> channels(const std::string& world, const std::string& prefix);
  std::vector<const ServiceEntry*> services(const std::string& world, const std::string& prefix);

  const Channel* find_channel(std::uint32_t id) const;  // null: there is none
  const ServiceEntry* find_service(std::uint32_t id) const;

 private:
  std::vector<std::unique_ptr<Channel>> channels_;  // by id, from 1
  std::vector<std::unique_ptr<ServiceEntry>> services_;
  std::map<std::pair<std::string, std::string>, std::uint32_t> channel_ids_;  // of world and topic
  std::map<std::pair<std::string, std::string>, std::uint32_t> service_ids_;
};

}  // namespace flexcast::web
