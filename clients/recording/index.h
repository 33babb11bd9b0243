// Index: what is where in a recording, from one pass over it: its runs and frames, and the messages that say what a
// frame means. It holds some 32 bytes a frame, whatever the frames hold themselves.
//
//   auto index = Index::make(recording, {});
//   const RunEntry& last = index.value().runs().back();
//   recording.seek(index.value().frames()[last.begin].first);   // the next message is that frame
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "clients/recording/recording.h"
#include "idl/wire/frame_head.h"

namespace flexcast::recording {

// A frame, whole or with chunks missing. Ordinals are those of Recording::seek.
struct FrameEntry {
  std::uint64_t number = 0;  // within its run, as recorded
  double time = 0;           // s, simulated
  std::uint64_t first = 0;   // ordinals of its first ...
  std::uint64_t last = 0;    // ... and last chunk; other messages may lie between
};

// Frames of one run, one after the other. A run that is left and met again has two entries.
struct RunEntry {
  std::uint64_t run_id = 0;
  std::size_t begin = 0;  // frames()[begin] to frames()[end - 1], at least one
  std::size_t end = 0;
};

class Index {
 public:
  // Called now and then with the number of messages so far.
  using Progress = std::function<void(std::uint64_t)>;

  // Reads the recording to its end, or to where it is truncated. An error if there is no frame in it.
  static wire::Result<Index> make(Recording& recording, const Progress& progress);

  std::span<const FrameEntry> frames() const { return frames_; }  // in the order of the file
  std::span<const RunEntry> runs() const { return runs_; }
  const std::string& world() const { return world_; }       // of the first frame
  std::size_t frame_bytes() const { return frame_bytes_; }  // of the largest frame, all chunks, as recorded
  const std::string& trouble() const { return trouble_; }   // of the recording: "" if it is complete

  // Ordinals of the messages that are in force at the frame `head`, found at `ordinal`: its scene, then its topology,
  // then its parameters. What was recorded late, after the frame, counts too: DDS knows no order across topics.
  std::vector<std::uint64_t> find_in_force(const wire::FrameHead& head, std::uint64_t ordinal) const;

  Index() = default;  // of nothing

 private:
  struct Definition {  // a scene, a part of a topology, or a set of parameters
    wire::TopicId topic = wire::TopicId::scene;
    std::uint64_t ordinal = 0;
    std::uint64_t run_id = 0;
    std::uint64_t revision = 0;  // of the topology, or of the parameters
    std::uint32_t body = 0, chunk = 0;
  };

  void add(const RecordedMessage& message, std::uint64_t ordinal);
  void add_frame(const RecordedMessage& message, std::uint64_t ordinal);
  void add_definition(const RecordedMessage& message, std::uint64_t ordinal);
  const Definition* find_best(wire::TopicId topic, const wire::FrameHead& head, std::uint64_t revision,
                              std::uint64_t ordinal) const;
  void find_topology(const wire::FrameHead& head, std::vector<std::uint64_t>& found) const;

  std::vector<FrameEntry> frames_;
  std::vector<RunEntry> runs_;
  std::vector<Definition> definitions_;
  std::string world_;
  std::size_t frame_bytes_ = 0;
  std::size_t bytes_of_last_ = 0;
  std::string trouble_;
};

}  // namespace flexcast::recording
