// The C structs that idlc makes from flexcast.idl, and what it takes to name them in templates.
#pragma once

#include <flexcast.h>  // generated

namespace flexcast::wire {

// descriptor_of<T>(): Cyclone's descriptor of one generated struct.
template <class T>
const dds_topic_descriptor_t& descriptor_of() = delete;

#define FLEXCAST_WIRE_TYPE(NAME)                                            \
  template <>                                                               \
  inline const dds_topic_descriptor_t& descriptor_of<::flexcast_##NAME>() { \
    return flexcast_##NAME##_desc;                                          \
  }

FLEXCAST_WIRE_TYPE(ParameterValue)
FLEXCAST_WIRE_TYPE(ParameterDescriptor)
FLEXCAST_WIRE_TYPE(BodyInfo)
FLEXCAST_WIRE_TYPE(ProbeInfo)
FLEXCAST_WIRE_TYPE(SceneFile)
FLEXCAST_WIRE_TYPE(SceneInfo)
FLEXCAST_WIRE_TYPE(Topology)
FLEXCAST_WIRE_TYPE(ParameterSet)
FLEXCAST_WIRE_TYPE(ParticleFrame)
FLEXCAST_WIRE_TYPE(ProbeState)
FLEXCAST_WIRE_TYPE(HandleState)
FLEXCAST_WIRE_TYPE(StepReport)
FLEXCAST_WIRE_TYPE(Failure)
FLEXCAST_WIRE_TYPE(Status)
FLEXCAST_WIRE_TYPE(Command)
FLEXCAST_WIRE_TYPE(Reply)
FLEXCAST_WIRE_TYPE(Event)
FLEXCAST_WIRE_TYPE(RecorderInfo)
FLEXCAST_WIRE_TYPE(RecorderCommand)

#undef FLEXCAST_WIRE_TYPE

}  // namespace flexcast::wire
