#include "idl/wire/endpoint.h"

#include <dds/dds.h>

#include "idl/wire/qos_convert.h"

namespace flexcast::wire {

Result<Endpoint> Endpoint::create(Kind kind, const Participant& participant, const TopicRow& row, const Qos& qos) {
  const std::string name = row.name;
  auto topic = own_entity("cannot create the topic " + name,
                          dds_create_topic(participant.handle(), row.descriptor, row.name, nullptr, nullptr));
  if (!topic) return topic.error();
  const DdsQos dds_qos = to_dds(qos);
  const EntityHandle topic_handle = topic.value().handle();
  auto entity = kind == Kind::reader
                    ? own_entity("cannot read " + name,
                                 dds_create_reader(participant.handle(), topic_handle, dds_qos.get(), nullptr))
                    : own_entity("cannot write " + name,
                                 dds_create_writer(participant.handle(), topic_handle, dds_qos.get(), nullptr));
  if (!entity) return entity.error();
  return Endpoint(std::move(topic).value(), std::move(entity).value());
}

}  // namespace flexcast::wire
