#include "server/frame_mailbox.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace flexcast::server {

FrameMailbox::FrameMailbox(std::int64_t particles, const StreamFormat& format, const FrameLimits& limits)
    : limits_(limits) {
  rings_.emplace_back(particles, format, limits);
}

void FrameMailbox::begin_scene(std::int64_t particles, const StreamFormat& format) {
  std::list<FrameRing> ring;
  ring.emplace_back(particles, format, limits_);
  const std::scoped_lock lock(mutex_);
  rings_.splice(rings_.end(), ring);
}

bool FrameMailbox::push(const FrameHeader& header, const State& state, ParticleFields* fields) {
  Frame* frame = nullptr;
  {
    const std::scoped_lock lock(mutex_);
    frame = rings_.back().acquire();
    if (frame == nullptr) refused_ = true;
  }
  if (frame == nullptr) return false;
  capture_.fill(header, state, fields, *frame);
  {
    const std::scoped_lock lock(mutex_);
    rings_.back().commit(frame);
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
  bool room = false;
  const Frame* frame = take_oldest(room);
  if (room && on_room_) on_room_();
  return frame;
}

const Frame* FrameMailbox::take_oldest(bool& room) {
  std::list<FrameRing> finished;  // goes after the lock
  const std::scoped_lock lock(mutex_);
  const auto ring = std::find_if(rings_.begin(), rings_.end(), [](const FrameRing& r) { return r.waiting() > 0; });
  if (ring == rings_.end()) return nullptr;
  if (taken_ != nullptr) rings_.front().release(taken_);
  finished.splice(finished.end(), rings_, rings_.begin(), ring);
  taken_ = ring->take();
  room = refused_ && 2 * rings_.back().waiting() <= rings_.back().capacity();
  if (room) refused_ = false;
  return taken_;
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
                      [this] { return woken_ || count_waiting() > 0 || !notices_.empty() || status_.has_value(); });
  woken_ = false;
}

std::size_t FrameMailbox::waiting() const {
  const std::scoped_lock lock(mutex_);
  return count_waiting();
}

std::size_t FrameMailbox::count_waiting() const {
  std::size_t count = 0;
  for (const FrameRing& ring : rings_) count += ring.waiting();
  return count;
}

std::size_t FrameMailbox::capacity() const {
  const std::scoped_lock lock(mutex_);
  return rings_.back().capacity();
}

void FrameMailbox::wake() {
  {
    const std::scoped_lock lock(mutex_);
    woken_ = true;
  }
  changed_.notify_one();
}

}  // namespace flexcast::server
