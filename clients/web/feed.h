// Feed: the DDS thread. Takes the samples of all worlds and leaves them in the box for the network's thread. Frames are
// read only while somebody wants some, so that none are sent for nothing.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "clients/web/frame_grouper.h"
#include "clients/web/news_box.h"
#include "clients/web/wanted.h"
#include "idl/wire/raw_reader.h"
#include "idl/wire/wait_set.h"

namespace flexcast::web {

class Feed {
 public:
  // Replies are those to `client_id`. `wake` is called on the feed's thread when there is something in the box. The
  // participant must outlive the feed.
  static wire::Result<std::unique_ptr<Feed>> create(const wire::Participant& participant, std::string client_id,
                                                    std::function<void()> wake);
  ~Feed();
  Feed(const Feed&) = delete;
  Feed& operator=(const Feed&) = delete;

  void start();
  void stop();  // no wake-ups after it

  // From any thread:
  Delivery take() { return box_.take(); }
  void want(const Wanted& wanted);
  const wire::Reader<flexcast_Reply>& replies() const { return replies_; }
  const std::string& client_id() const { return client_id_; }

 private:
  struct Readers {
    std::vector<wire::RawReader> states;  // scene, topology, parameters
    wire::RawReader status;
    wire::RawReader events;
  };
  Feed(const wire::Participant& participant, std::string client_id, std::function<void()> wake, Readers readers,
       wire::Reader<flexcast_Reply> replies, wire::GuardCondition guard);
  wire::Result<void> make_wait_set();
  void run();
  bool take_all();
  bool take_states(const wire::RawReader& reader);
  bool take_status();
  bool take_events();
  bool take_replies();
  bool take_frames();
  void add_status(const wire::RawSample& sample);
  void add_frame(const wire::RawSample& sample);
  void tend_frames_reader();
  Wanted wanted() const;

  const wire::Participant& participant_;
  const std::string client_id_;
  const std::function<void()> wake_;
  Readers readers_;
  wire::Reader<flexcast_Reply> replies_;
  wire::GuardCondition guard_;
  std::optional<wire::RawReader> frames_;
  std::optional<wire::WaitSet> wait_set_;          // after what it waits for
  Wanted now_wanted_;                              // of this turn
  std::map<std::uint64_t, std::string> statuses_;  // world by instance
  std::map<std::string, FrameGrouper, std::less<>> groupers_;
  NewsBox box_;

  mutable std::mutex mutex_;  // for the one below
  Wanted wanted_;
  std::atomic<bool> stopping_ = false;
  std::thread thread_;
};

}  // namespace flexcast::web
