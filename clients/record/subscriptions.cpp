#include "clients/record/subscriptions.h"

#include <algorithm>
#include <chrono>

#include "idl/wire/fill.h"
#include "idl/wire/frame_size.h"

namespace flexcast::record {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using wire::TopicId;

constexpr auto scene_time = 1s;  // a late joiner gets the scene within milliseconds

wire::Result<wire::FrameSize> find_frame_size(const wire::Participant& participant, const std::string& world) {
  auto reader = wire::Reader<flexcast_SceneInfo>::create(participant);
  if (!reader) return reader.error();
  const auto end = Clock::now() + scene_time;
  for (auto now = Clock::now(); now < end; now = Clock::now()) {
    reader.value().wait(end - now);
    const auto samples = reader.value().take();
    if (!samples) return samples.error();
    for (const auto [scene, info] : samples.value()) {
      if (info.valid && wire::text(scene.world) == world) return wire::frame_size(scene);
    }
  }
  return wire::FrameSize{wire::largest_sample, 1};
}

}  // namespace

wire::Result<Subscriptions> Subscriptions::create(const wire::Participant& participant, const std::string& world) {
  const auto size = find_frame_size(participant, world);
  if (!size) return size.error();
  auto scenes = wire::Reader<flexcast_SceneInfo>::create(participant, wire::topic_of<flexcast_SceneInfo>().recorder);
  if (!scenes) return scenes.error();
  std::vector<wire::RawReader> raw;
  for (const wire::TopicRow& row : wire::topic_table()) {
    if (!row.recorded) continue;
    const bool is_frames = row.id == TopicId::frames;
    const wire::Qos qos = is_frames ? wire::frames_recorder_qos(size.value().bytes, size.value().chunks) : row.recorder;
    auto reader = wire::RawReader::create(participant, row, qos);
    if (!reader) return reader.error();
    raw.push_back(std::move(reader).value());
  }
  return Subscriptions(std::move(raw), std::move(scenes).value());
}

bool Subscriptions::is_matched(const wire::Guid& server) const {
  const auto matched_with_server = [&](const wire::UntypedReader& reader) {
    const auto peers = reader.matched_participants();
    return std::find(peers.begin(), peers.end(), server) != peers.end();
  };
  return matched_with_server(scenes_) && std::all_of(raw_.begin(), raw_.end(), [&](const wire::RawReader& reader) {
           return reader.row().id == TopicId::commands || matched_with_server(reader);
         });
}

}  // namespace flexcast::record
