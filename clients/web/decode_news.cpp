#include "clients/web/decode_news.h"

#include "clients/client/frame.h"
#include "clients/web/point_cloud.h"
#include "idl/wire/decode.h"
#include "idl/wire/fill.h"
#include "idl/wire/message_head.h"

namespace flexcast::web {
namespace {

using wire::TopicId;

bool decode_topology(StateNews& news) {
  const auto topology = wire::decode<flexcast_Topology>(news.sample.bytes);
  if (!topology) return false;
  news.key = std::uint64_t{topology.value()->body} << 32 | topology.value()->chunk;
  news.run_id = topology.value()->run_id;
  news.revision = topology.value()->topology_revision;
  return true;
}

bool decode_parameters(StateNews& news) {
  const auto set = wire::decode<flexcast_ParameterSet>(news.sample.bytes);
  if (!set) return false;
  auto table = std::make_shared<ParameterTable>();
  for (const auto& value : wire::elements(set.value()->values)) table->values.push_back(client::from_wire(value));
  for (const auto& descriptor : wire::elements(set.value()->descriptors))
    table->descriptors.push_back(client::from_wire(descriptor));
  news.parameters = std::move(table);
  return true;
}

}  // namespace

std::optional<StateNews> decode_state(TopicId topic, Sample sample) {
  const auto world = wire::peek_world(topic, sample.bytes);
  if (!world) return {};
  StateNews news{.world = std::string(*world), .topic = topic, .sample = std::move(sample)};
  if (topic == TopicId::topology && !decode_topology(news)) return {};
  if (topic == TopicId::parameters && !decode_parameters(news)) return {};
  return news;
}

std::optional<Sample> make_points(const WholeFrame& frame) {
  client::FrameAssembler assembler;
  for (const Sample& chunk : frame.chunks) {
    const auto decoded = wire::decode<flexcast_ParticleFrame>(chunk.bytes);
    if (!decoded) return {};
    if (const auto whole = assembler.add(*decoded.value()))
      return Sample{make_point_cloud(*whole, chunk.time), chunk.time};
  }
  return {};
}

}  // namespace flexcast::web
