#include "clients/record/repeats.h"

#include "idl/wire/decode.h"

namespace flexcast::record {

void Repeats::note(const Item& item) {
  if (std::holds_alternative<Attachment>(item)) return attachments_.push_back(item);
  const auto* message = std::get_if<Message>(&item);
  if (message == nullptr) return;
  switch (message->topic) {
    case wire::TopicId::scene:
      scene_ = item;
      return;
    case wire::TopicId::topology:
      return note_topology(item, *message);
    case wire::TopicId::parameters:
      parameters_ = item;
      return;
    case wire::TopicId::events:
      return note_event(item, *message);
    default:
      return;
  }
}

void Repeats::note_topology(const Item& item, const Message& message) {
  const auto topology = wire::decode<flexcast_Topology>(message.bytes);
  if (!topology) return;
  const flexcast_Topology& said = *topology.value();
  if (said.topology_revision != topology_revision_ || said.run_id != topology_run_) topology_.clear();
  topology_revision_ = said.topology_revision;
  topology_run_ = said.run_id;
  topology_.insert_or_assign({said.body, said.chunk}, item);
}

void Repeats::note_event(const Item& item, const Message& message) {
  const auto event = wire::decode<flexcast_Event>(message.bytes);
  if (!event) return;
  if (event.value()->run_id != event_run_) events_.clear();
  event_run_ = event.value()->run_id;
  events_.push_back(item);
}

std::vector<const Item*> Repeats::items() const {
  std::vector<const Item*> list;
  for (const Item& file : attachments_) list.push_back(&file);
  if (scene_) list.push_back(&*scene_);
  for (const auto& [key, item] : topology_) list.push_back(&item);
  if (parameters_) list.push_back(&*parameters_);
  for (const Item& event : events_) list.push_back(&event);
  return list;
}

}  // namespace flexcast::record
