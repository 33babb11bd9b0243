#include "idl/wire/qos.h"

#include <algorithm>
#include <limits>

#include "idl/wire/qos_convert.h"
#include "idl/wire/topics.h"

namespace flexcast::wire {
namespace {

constexpr std::size_t fewest_frames = 4;

std::size_t frames_in_budget(std::size_t frame_bytes) {
  return std::max(fewest_frames, history_budget / std::max<std::size_t>(frame_bytes, 1));
}

}  // namespace

Qos frames_writer_qos(std::size_t frame_bytes) {
  Qos qos = topic(TopicId::frames).writer;
  qos.depth = static_cast<std::int32_t>(std::min<std::size_t>(frames_in_budget(frame_bytes), qos.depth));
  return qos;
}

Qos frames_recorder_qos(std::size_t frame_bytes, std::uint32_t chunks) {
  Qos qos = topic(TopicId::frames).recorder;
  const std::size_t samples = frames_in_budget(frame_bytes) * std::max<std::size_t>(chunks, 1);
  qos.max_samples = static_cast<std::int32_t>(std::min<std::size_t>(samples, 1 << 20));
  return qos;
}

DdsQos to_dds(const Qos& qos) {
  DdsQos dds(dds_create_qos());
  dds_qset_reliability(dds.get(), DDS_RELIABILITY_RELIABLE, qos.max_blocking.count());
  if (qos.depth > 0)
    dds_qset_history(dds.get(), DDS_HISTORY_KEEP_LAST, qos.depth);
  else
    dds_qset_history(dds.get(), DDS_HISTORY_KEEP_ALL, DDS_LENGTH_UNLIMITED);
  if (qos.max_samples > 0)
    dds_qset_resource_limits(dds.get(), qos.max_samples, DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
  if (qos.transient_local) {
    dds_qset_durability(dds.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
    dds_qset_durability_service(dds.get(), 0, DDS_HISTORY_KEEP_LAST, std::max(qos.depth, 1), DDS_LENGTH_UNLIMITED,
                                DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
  } else {
    dds_qset_durability(dds.get(), DDS_DURABILITY_VOLATILE);
  }
  if (qos.deadline.count() > 0) dds_qset_deadline(dds.get(), qos.deadline.count());
  if (qos.lease.count() > 0) dds_qset_liveliness(dds.get(), DDS_LIVELINESS_AUTOMATIC, qos.lease.count());
  dds_qset_writer_data_lifecycle(dds.get(), false);
  return dds;
}

}  // namespace flexcast::wire
