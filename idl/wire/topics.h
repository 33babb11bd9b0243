// THE topic table: one row a topic. Server, clients and recorder take names, types and QoS from here.
#pragma once

#include <span>
#include <string_view>

#include "idl/wire/qos.h"
#include "idl/wire/types.h"

namespace flexcast::wire {

enum class TopicId {
  scene,
  topology,
  parameters,
  frames,
  status,
  commands,
  replies,
  events,
  recorders,
  recorder_commands
};

struct TopicRow {
  TopicId id;
  const char* name;                          // "flexcast/frames"
  std::string_view type_name;                // "flexcast::ParticleFrame"
  const dds_topic_descriptor_t* descriptor;  // of the generated type
  Qos writer;
  Qos monitor;   // a reader that wants the newest
  Qos recorder;  // a reader that wants everything
  bool recorded;
};

// In the order of TopicId. The frames' QoS is for small frames: see frames_writer_qos, frames_recorder_qos.
std::span<const TopicRow> topic_table();

const TopicRow& topic(TopicId id);

// Every topic has a type of its own, so the type names the row.
template <class T>
const TopicRow& topic_of();

template <>
inline const TopicRow& topic_of<flexcast_SceneInfo>() {
  return topic(TopicId::scene);
}
template <>
inline const TopicRow& topic_of<flexcast_Topology>() {
  return topic(TopicId::topology);
}
template <>
inline const TopicRow& topic_of<flexcast_ParameterSet>() {
  return topic(TopicId::parameters);
}
template <>
inline const TopicRow& topic_of<flexcast_ParticleFrame>() {
  return topic(TopicId::frames);
}
template <>
inline const TopicRow& topic_of<flexcast_Status>() {
  return topic(TopicId::status);
}
template <>
inline const TopicRow& topic_of<flexcast_Command>() {
  return topic(TopicId::commands);
}
template <>
inline const TopicRow& topic_of<flexcast_Reply>() {
  return topic(TopicId::replies);
}
template <>
inline const TopicRow& topic_of<flexcast_Event>() {
  return topic(TopicId::events);
}
template <>
inline const TopicRow& topic_of<flexcast_RecorderInfo>() {
  return topic(TopicId::recorders);
}
template <>
inline const TopicRow& topic_of<flexcast_RecorderCommand>() {
  return topic(TopicId::recorder_commands);
}

}  // namespace flexcast::wire
