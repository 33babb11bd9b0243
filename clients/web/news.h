// What the DDS thread has to tell the network's thread.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "clients/client/reply.h"
#include "clients/web/sample.h"
#include "idl/wire/entity.h"
#include "idl/wire/topics.h"

namespace flexcast::web {

struct StatusNews {
  std::string world;
  std::uint64_t server_id = 0;
  wire::Guid server{};  // its participant
  Sample sample{};
};

// The writer of its status has gone.
struct EndNews {
  std::string world;
  bool on_purpose = false;
};

struct ParameterTable {
  std::vector<client::Parameter> values;
  std::vector<client::Descriptor> descriptors;
};

// Scene, topology or parameters.
struct StateNews {
  std::string world;
  wire::TopicId topic = wire::TopicId::scene;
  std::uint64_t key = 0;     // of topologies: body and chunk
  std::uint64_t run_id = 0;  // of topologies
  std::uint64_t revision = 0;
  Sample sample{};
  std::shared_ptr<const ParameterTable> parameters{};  // of parameters; shared: with the world's own record
};

struct EventNews {
  std::string world;
  std::uint64_t run_id = 0;
  Sample sample{};
};

struct ReplyNews {
  std::string world;
  std::uint64_t request_id = 0;
  client::Reply reply{};
};

using News = std::variant<StatusNews, EndNews, StateNews, EventNews, ReplyNews>;

// Everything since the last time: news in the order of arrival, and of each world the newest frame.
struct Delivery {
  std::vector<News> news;
  std::map<std::string, FramePointer> frames;
};

}  // namespace flexcast::web
