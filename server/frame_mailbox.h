// FrameMailbox: everything that goes from the simulation thread to the publisher. Frames pass through a bounded ring
// and are refused when it is full; notices are few and never refused; of statuses the newest counts. The simulation
// thread holds the lock for moments only and never waits for the publisher.
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <list>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "server/convert/clock.h"
#include "server/convert/frame_capture.h"
#include "server/convert/notice_types.h"
#include "server/convert/status_types.h"
#include "server/frame_ring.h"

namespace flexcast::server {

class FrameMailbox {
 public:
  explicit FrameMailbox(std::int64_t particles, const StreamFormat& format = {}, const FrameLimits& limits = {});

  // ---- for the simulation thread

  // Frames pushed from now on have so many particles in that format. Those that wait are still taken.
  void begin_scene(std::int64_t particles, const StreamFormat& format);
  // Captures the state. False: no room, nothing was done. Allocates nothing, but for stretch and stress: these are
  // computed here when the format has them, and `fields` is of the state's model then.
  bool push(const FrameHeader& header, const State& state, ParticleFields* fields = nullptr);
  void post(std::vector<Notice> notices);
  void post(WorldStatus status);
  bool status_wanted() const { return status_wanted_.load(std::memory_order_relaxed); }  // until a status is posted
  void beat() { heartbeat_.fetch_add(1, std::memory_order_relaxed); }
  // Whether the world waits for recorders to have its frames.
  void set_held(bool held) { held_.store(held, std::memory_order_relaxed); }
  // To be called, on the publisher's thread, when half of the frames are free again after one was refused: so that the
  // two threads do not wake each other for every frame. To be set before the publisher starts.
  void on_room(std::function<void()> call) { on_room_ = std::move(call); }

  // ---- for the publisher

  // The oldest frame that waits, or null. It stays as it is until the next call that returns a frame.
  const Frame* take();
  std::vector<Notice> take_notices();
  std::optional<WorldStatus> take_status();  // the newest, unless it was taken before
  void want_status() { status_wanted_.store(true, std::memory_order_relaxed); }
  bool held() const { return held_.load(std::memory_order_relaxed); }
  std::uint64_t heartbeat() const { return heartbeat_.load(std::memory_order_relaxed); }
  // Until something waits, wake() is called or the time has come.
  void wait_until(Clock::time_point time);

  // ---- for anybody

  std::size_t capacity() const;  // frames, of the present scene
  std::size_t waiting() const;   // frames
  void wake();

 private:
  std::size_t count_waiting() const;     // under the lock
  const Frame* take_oldest(bool& room);  // `room`: on_room is due

  FrameCapture capture_;  // the simulation thread's
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  const FrameLimits limits_;
  std::list<FrameRing> rings_;  // of each scene one: pushed into the last; the first goes when the next is taken from
  Frame* taken_ = nullptr;      // the publisher's, of the first ring
  std::vector<Notice> notices_;
  std::optional<WorldStatus> status_;
  bool woken_ = false;
  bool refused_ = false;  // a frame, since there was room
  std::function<void()> on_room_;
  std::atomic<bool> held_ = false;
  std::atomic<bool> status_wanted_ = false;
  std::atomic<std::uint64_t> heartbeat_ = 0;
};

}  // namespace flexcast::server
