// FrameCheck: compares the frames a simulation gives with those that were recorded.
//
// The server numbers its frames 0, 1, 2, ... A frame shows the state at which it became due; where it had to wait at
// the server it may show what a command has made of that state before the next step. So a frame that does not agree at
// once is looked at again until the simulation goes on.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "clients/verify/recorded_run.h"
#include "core/sim/simulation.h"

namespace flexcast::verify {

struct Difference {
  RecordedFrame recorded;
  std::int64_t step = 0;  // that the simulation was at
  std::uint64_t computed_hash = 0;
  std::string after;  // the last event before the frame
};

class FrameCheck {
 public:
  explicit FrameCheck(std::span<const RecordedFrame> frames) : left_(frames) {}

  // The server makes a frame of this state. `after`: the last event before it.
  void add_frame(const Simulation& simulation, const std::string& after);
  // The state may have changed without a step.
  void look_again(const Simulation& simulation);
  // The simulation goes on, or has ended.
  void settle();

  bool done() const { return left_.empty(); }
  std::int64_t last_step() const;  // the highest one of the frames still to come

  std::uint64_t compared() const { return compared_; }
  std::uint64_t differing() const { return differing_; }
  const std::optional<Difference>& first_difference() const { return first_; }
  // A frame that no step of the simulation has given; null: none.
  const RecordedFrame* unreached() const { return left_.empty() ? nullptr : &left_.front(); }

 private:
  std::span<const RecordedFrame> left_;  // not yet due
  std::uint64_t next_ = 0;               // number of the next frame
  std::optional<Difference> open_;       // of the frame that is due, as long as it does not agree
  std::span<const RecordedFrame> due_;   // its samples
  std::uint64_t compared_ = 0;
  std::uint64_t differing_ = 0;
  std::optional<Difference> first_;
};

}  // namespace flexcast::verify
