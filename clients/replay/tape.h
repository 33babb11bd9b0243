// Tape: goes through the clips of a recording frame by frame and hands every message on, in the order of the file.
// Where it jumps, what is in force there comes first: scene, topology, parameters.
#pragma once

#include <functional>
#include <vector>

#include "clients/replay/clips.h"

namespace flexcast::replay {

class Tape {
 public:
  using Sink = std::function<void(const recording::RecordedMessage&)>;

  // At the first frame of the first clip; there must be one.
  Tape(recording::Recording recording, recording::Index index, std::vector<Clip> clips);

  const recording::Index& index() const { return index_; }
  const std::vector<Clip>& clips() const { return clips_; }

  // Whether nothing of the recording's runs is left out at their start.
  bool is_from_start() const;

  bool at_end() const { return clip_ == clips_.size(); }
  // Where the next frame is. Only where not at_end().
  const recording::FrameEntry& next() const { return index_.frames()[next_]; }
  bool begins_clip() const { return next_ == clips_[clip_].begin; }

  // The clip of the frame that was played last.
  std::size_t played_clip() const { return played_clip_; }

  // The next frame will be this one of this clip.
  void go_to(std::size_t clip, std::size_t frame);

  // Hands on everything up to the last chunk of the next frame.
  void play(const Sink& sink);

  // Behind the last frame: hands on the rest of the file, unless the last clip ends before it.
  void play_rest(const Sink& sink);

  // Hands on the chunks of the frame that was played last once more.
  void play_last_again(const Sink& sink);

 private:
  std::uint64_t first_ordinal() const;
  void play_in_force(const Sink& sink);

  recording::Recording recording_;
  recording::Index index_;
  std::vector<Clip> clips_;
  std::size_t clip_ = 0;
  std::size_t next_ = 0;
  std::size_t played_ = 0;  // frame
  std::size_t played_clip_ = 0;
  bool jumped_ = false;  // what is in force has yet to be handed on
};

}  // namespace flexcast::replay
