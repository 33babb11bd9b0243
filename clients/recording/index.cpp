#include "clients/recording/index.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "idl/wire/decode.h"

namespace flexcast::recording {
namespace {

constexpr std::uint64_t progress_period = 1024;  // messages

}  // namespace

wire::Result<Index> Index::make(Recording& recording, const Progress& progress) {
  Index index;
  recording.rewind();
  for (std::uint64_t ordinal = 0; const RecordedMessage* message = recording.next(); ++ordinal) {
    index.add(*message, ordinal);
    if (progress && ordinal % progress_period == 0) progress(ordinal);
  }
  index.trouble_ = recording.trouble();
  if (index.frames_.empty()) {
    const std::string why = index.trouble_.empty() ? "" : " (" + index.trouble_ + ")";
    return wire::Error{recording.path() + ": there is no frame in it" + why};
  }
  return index;
}

void Index::add(const RecordedMessage& message, std::uint64_t ordinal) {
  switch (message.topic) {
    case wire::TopicId::frames:
      return add_frame(message, ordinal);
    case wire::TopicId::scene:
    case wire::TopicId::topology:
    case wire::TopicId::parameters:
      return add_definition(message, ordinal);
    default:
      return;
  }
}

void Index::add_frame(const RecordedMessage& message, std::uint64_t ordinal) {
  const auto head = wire::peek_frame_head(message.bytes);
  if (!head) return;
  const wire::FrameHead& h = head.value();
  if (frames_.empty()) world_ = h.world;
  const bool same_run = !runs_.empty() && runs_.back().run_id == h.run_id;
  const bool same_frame = same_run && frames_.back().number == h.frame;
  bytes_of_last_ = message.bytes.size() + (same_frame ? bytes_of_last_ : 0);
  frame_bytes_ = std::max(frame_bytes_, bytes_of_last_);
  if (same_frame) {
    frames_.back().last = ordinal;
    return;
  }
  if (!same_run) runs_.push_back({h.run_id, frames_.size(), frames_.size()});
  frames_.push_back({h.frame, h.time, ordinal, ordinal});
  ++runs_.back().end;
}

void Index::add_definition(const RecordedMessage& message, std::uint64_t ordinal) {
  if (message.topic == wire::TopicId::scene) {
    if (auto scene = wire::decode<flexcast_SceneInfo>(message.bytes)) {
      definitions_.push_back({message.topic, ordinal, scene.value()->run_id, scene.value()->topology_revision, 0, 0});
    }
  } else if (message.topic == wire::TopicId::topology) {
    if (auto part = wire::decode<flexcast_Topology>(message.bytes)) {
      const flexcast_Topology& t = *part.value();
      definitions_.push_back({message.topic, ordinal, t.run_id, t.topology_revision, t.body, t.chunk});
    }
  } else if (auto set = wire::decode<flexcast_ParameterSet>(message.bytes)) {
    definitions_.push_back({message.topic, ordinal, set.value()->run_id, set.value()->parameter_revision, 0, 0});
  }
}

std::vector<std::uint64_t> Index::find_in_force(const wire::FrameHead& head, std::uint64_t ordinal) const {
  std::vector<std::uint64_t> found;
  if (const auto* scene = find_best(wire::TopicId::scene, head, head.topology_revision, ordinal)) {
    found.push_back(scene->ordinal);
  }
  find_topology(head, found);
  if (const auto* parameters = find_best(wire::TopicId::parameters, head, head.parameter_revision, ordinal)) {
    found.push_back(parameters->ordinal);
  }
  return found;
}

// Of the frame's run rather than of another, of its revision rather than of another, before it rather than after it;
// of those before it the last, of those after it the first.
const Index::Definition* Index::find_best(wire::TopicId topic, const wire::FrameHead& head, std::uint64_t revision,
                                          std::uint64_t ordinal) const {
  const Definition* best = nullptr;
  const auto rank = [&](const Definition& d) {
    return std::tuple(d.run_id == head.run_id, d.revision == revision, d.ordinal < ordinal);
  };
  for (const Definition& d : definitions_) {
    if (d.topic != topic) continue;
    const bool later_is_better = d.ordinal < ordinal;
    if (best == nullptr || rank(d) > rank(*best) || (rank(d) == rank(*best) && later_is_better)) best = &d;
  }
  return best;
}

// The last of every part, of this run where it has any.
void Index::find_topology(const wire::FrameHead& head, std::vector<std::uint64_t>& found) const {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint64_t> of_run, of_revision;
  for (const Definition& d : definitions_) {
    if (d.topic != wire::TopicId::topology || d.revision != head.topology_revision) continue;
    of_revision[{d.body, d.chunk}] = d.ordinal;
    if (d.run_id == head.run_id) of_run[{d.body, d.chunk}] = d.ordinal;
  }
  for (const auto& [part, ordinal] : of_run.empty() ? of_revision : of_run) found.push_back(ordinal);
}

}  // namespace flexcast::recording
