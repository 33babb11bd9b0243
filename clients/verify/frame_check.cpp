#include "clients/verify/frame_check.h"

#include <algorithm>

namespace flexcast::verify {
namespace {

const RecordedFrame* find_other(std::span<const RecordedFrame> samples, std::int64_t step, std::uint64_t hash) {
  const auto found = std::find_if(samples.begin(), samples.end(), [&](const RecordedFrame& sample) {
    return sample.step != step || sample.state_hash != hash;
  });
  return found == samples.end() ? nullptr : &*found;
}

}  // namespace

void FrameCheck::add_frame(const Simulation& simulation, const std::string& after) {
  settle();
  const std::uint64_t number = next_++;
  std::size_t count = 0;
  while (count < left_.size() && left_[count].frame == number) ++count;
  if (count == 0) return;
  due_ = left_.first(count);
  left_ = left_.subspan(count);
  ++compared_;
  const std::int64_t step = simulation.state().step;
  const std::uint64_t hash = simulation.calc_state_hash();
  if (const RecordedFrame* other = find_other(due_, step, hash)) open_ = Difference{*other, step, hash, after};
}

void FrameCheck::look_again(const Simulation& simulation) {
  if (!open_) return;
  if (find_other(due_, simulation.state().step, simulation.calc_state_hash()) == nullptr) open_.reset();
}

void FrameCheck::settle() {
  if (!open_) return;
  ++differing_;
  if (!first_) first_ = open_;
  open_.reset();
}

std::int64_t FrameCheck::last_step() const {
  std::int64_t last = -1;
  for (const RecordedFrame& frame : left_) last = std::max(last, frame.step);
  return last;
}

}  // namespace flexcast::verify
