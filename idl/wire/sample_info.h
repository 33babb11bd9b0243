// SampleInfo from Cyclone's struct. Internal to idl/wire.
#pragma once

#include <dds/dds.h>

#include "idl/wire/reader.h"

namespace flexcast::wire {

inline SampleInfo to_sample_info(const dds_sample_info_t& info) {
  const auto state = info.instance_state == DDS_IST_ALIVE                ? InstanceState::alive
                     : info.instance_state == DDS_IST_NOT_ALIVE_DISPOSED ? InstanceState::disposed
                                                                         : InstanceState::no_writers;
  return {info.valid_data, state, info.source_timestamp, info.instance_handle, info.publication_handle};
}

}  // namespace flexcast::wire
