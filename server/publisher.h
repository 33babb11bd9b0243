// Publisher: the thread that brings the mailbox's content to the network: notices first, the status at least four times
// a second, then frames one by one. A reader that joins while no new frame comes gets the newest again, and so does a
// recorder that a world in lockstep waits for.
#pragma once

#include <atomic>
#include <mutex>
#include <string>
#include <thread>

#include "server/frame_mailbox.h"
#include "server/heartbeat_watch.h"
#include "server/publications.h"
#include "server/unpublished_frames.h"

namespace flexcast::server {

class Publisher {
 public:
  // Both must outlive this object.
  Publisher(Publications& publications, FrameMailbox& mailbox);
  ~Publisher() { stop(); }
  Publisher(const Publisher&) = delete;
  Publisher& operator=(const Publisher&) = delete;

  void start();
  // Publishes what waits (for a second at most), a last status, and says goodbye. To be called when nothing more comes
  // into the mailbox, or nothing more counts. `last_words`: a warning of the last status; "": none.
  void stop(const std::string& last_words = "");

  // What was published last, for people to look at.
  struct Latest {
    WorldStatus status;
    DeliveryStatus delivery;
  };
  Latest latest() const;

 private:
  void run();
  void drain();
  bool turn(Clock::time_point now);  // false: nothing was waiting
  void publish_notices();
  void publish_status(Clock::time_point now);
  void write_status(Clock::time_point now);
  bool publish_frame(Clock::time_point now);
  void serve_late_reader(Clock::time_point now);
  void publish_newest_again(Clock::time_point now);

  Publications& publications_;
  FrameMailbox& mailbox_;
  const Frame* newest_ = nullptr;  // stays the mailbox's
  bool newest_published_ = false;  // somebody read
  std::uint64_t published_ = 0;    // frames of the newest one's run
  Clock::time_point newest_written_;
  UnpublishedFrames unpublished_;  // likewise
  WorldStatus status_;
  HeartbeatWatch heartbeat_watch_;
  Clock::time_point next_request_;    // of a status
  Clock::time_point status_written_;  // the last
  std::uint32_t readers_ever_ = 0;
  std::optional<Clock::time_point> reader_joined_;  // no frame was published since
  mutable std::mutex latest_mutex_;
  Latest latest_;
  std::string last_words_;  // set before `stopping_`
  std::atomic<bool> stopping_ = false;
  std::thread thread_;
};

}  // namespace flexcast::server
