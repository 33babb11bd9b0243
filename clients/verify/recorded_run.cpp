#include "clients/verify/recorded_run.h"

#include <algorithm>
#include <tuple>

#include "idl/wire/decode.h"
#include "idl/wire/fill.h"
#include "idl/wire/frame_head.h"
#include "server/convert/events.h"

namespace flexcast::verify {
namespace {

class RunReader {
 public:
  wire::Result<void> add(const recording::RecordedMessage& message) {
    switch (message.topic) {
      case wire::TopicId::scene:
        return add_scene(message.bytes);
      case wire::TopicId::events:
        return add_event(message.bytes);
      case wire::TopicId::frames:
        return add_frame(message.bytes);
      default:
        return {};
    }
  }

  std::vector<RecordedRun> take() {
    std::vector<RecordedRun> runs;
    for (auto& [id, run] : runs_) {
      auto& frames = run.frames;
      const auto key = [](const RecordedFrame& f) { return std::tuple(f.frame, f.step, f.state_hash); };
      std::stable_sort(frames.begin(), frames.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
      frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
      runs.push_back(std::move(run));
    }
    return runs;
  }

 private:
  using Bytes = std::span<const std::byte>;

  RecordedRun& run_of(std::uint64_t run_id, std::string_view world) {
    RecordedRun& run = runs_[run_id];
    run.run_id = run_id;
    if (run.world.empty()) run.world = world;
    return run;
  }

  wire::Result<void> add_scene(Bytes bytes) {
    auto scene = wire::decode<flexcast_SceneInfo>(bytes);
    if (!scene) return scene.error();
    RecordedRun& run = run_of(scene.value()->run_id, wire::text(scene.value()->world));
    run.scene = std::move(scene).value();
    return {};
  }

  wire::Result<void> add_event(Bytes bytes) {
    const auto message = wire::decode<flexcast_Event>(bytes);
    if (!message) return message.error();
    auto event = server::from_wire(*message.value());
    if (!event) return wire::Error{event.error().message};
    run_of(event.value().run_id, wire::text(message.value()->world))
        .events.insert_or_assign(event.value().index, std::move(event).value());
    return {};
  }

  wire::Result<void> add_frame(Bytes bytes) {
    const auto head = wire::peek_frame_head(bytes);
    if (!head) return head.error();
    const wire::FrameHead& h = head.value();
    const RecordedFrame frame{h.frame, static_cast<std::int64_t>(h.step), h.time, h.state_hash};
    // Chunks of a frame mostly come one after the other.
    auto& frames = run_of(h.run_id, h.world).frames;
    if (frames.empty() || !(frames.back() == frame)) frames.push_back(frame);
    return {};
  }

  std::map<std::uint64_t, RecordedRun> runs_;  // run ids grow with time
};

}  // namespace

wire::Result<std::vector<RecordedRun>> read_runs(recording::Recording& recording) {
  RunReader reader;
  std::uint64_t number = 0;
  while (const recording::RecordedMessage* message = recording.next()) {
    ++number;
    if (auto added = reader.add(*message); !added) {
      return wire::Error{recording.path() + ": message " + std::to_string(number) + " (" +
                         wire::topic(message->topic).name + ") cannot be read: " + added.error().message};
    }
  }
  return reader.take();
}

std::string describe_missing_event(const RecordedRun& run) {
  std::uint64_t expected = 0;
  for (const auto& [index, event] : run.events) {
    if (index != expected) break;
    ++expected;
  }
  if (!run.events.empty() && expected == run.events.size()) return {};
  std::string text = "event " + std::to_string(expected) + " is missing";
  if (run.events.empty()) return text + ": the recording has no events of this run";
  return text + ": the recording has " + std::to_string(run.events.size()) + " events up to number " +
         std::to_string(run.events.rbegin()->first);
}

std::vector<std::pair<std::uint64_t, std::uint64_t>> find_gaps(const RecordedRun& run) {
  std::vector<std::pair<std::uint64_t, std::uint64_t>> gaps;
  std::uint64_t expected = 0;
  for (const RecordedFrame& frame : run.frames) {
    if (frame.frame > expected) gaps.emplace_back(expected, frame.frame - 1);
    expected = frame.frame + 1;
  }
  return gaps;
}

}  // namespace flexcast::verify
