#include "server/frame_mailbox.h"

#include <iterator>
#include <utility>

#include "core/base/checks.h"

namespace flexcast::server {

FrameMailbox::FrameMailbox(std::int64_t particles, const FrameLimits& limits) : ring_(particles, limits) {}

bool FrameMailbox::push(const FrameHeader& header, const State& state) {
  Frame* frame = nullptr;
  {
    const std::scoped_lock lock(mutex_);
    frame = ring_.acquire();
  }
  if (frame == nullptr) return false;
  FLEXCAST_CHECK(state.positions.size() == frame->positions.size() &&
                 state.velocities.size() == frame->velocities.size());
  frame->header = header;
  frame->positions = state.positions;  // sizes agree, so nothing is allocated
  frame->velocities = state.velocities;
  {
    const std::scoped_lock lock(mutex_);
    ring_.commit(frame);
  }
  changed_.notify_one();
  return true;
}

void FrameMailbox::post(std::vector<Notice> notices) {
  if (notices.empty()) return;
  {
    const std::scoped_lock lock(mutex_);
    std::move(notices.begin(), notices.end(), std::back_inserter(notices_));
  }
  changed_.notify_one();
}

void FrameMailbox::post(WorldStatus status) {
  {
    const std::scoped_lock lock(mutex_);
    std::swap(status_.emplace(), status);
    status_wanted_ = false;
  }
  changed_.notify_one();
}

const Frame* FrameMailbox::take() {
  const std::scoped_lock lock(mutex_);
  Frame* frame = ring_.take();
  if (frame == nullptr) return nullptr;
  if (taken_ != nullptr) ring_.release(taken_);
  return taken_ = frame;
}

std::vector<Notice> FrameMailbox::take_notices() {
  const std::scoped_lock lock(mutex_);
  return std::exchange(notices_, {});
}

std::optional<WorldStatus> FrameMailbox::take_status() {
  const std::scoped_lock lock(mutex_);
  return std::exchange(status_, std::nullopt);
}

void FrameMailbox::wait_until(Clock::time_point time) {
  std::unique_lock lock(mutex_);
  changed_.wait_until(lock, time,
                      [this] { return woken_ || ring_.waiting() > 0 || !notices_.empty() || status_.has_value(); });
  woken_ = false;
}

std::size_t FrameMailbox::waiting() const {
  const std::scoped_lock lock(mutex_);
  return ring_.waiting();
}

void FrameMailbox::wake() {
  {
    const std::scoped_lock lock(mutex_);
    woken_ = true;
  }
  changed_.notify_one();
}

}  // namespace flexcast::server
