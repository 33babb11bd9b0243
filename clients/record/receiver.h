// Receiver: the thread that takes samples off the network, decides what is recorded and puts it into the queue.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "clients/record/gap_ledger.h"
#include "clients/record/item_queue.h"
#include "clients/record/scene_files.h"
#include "clients/record/subscriptions.h"
#include "idl/wire/wait_set.h"

namespace flexcast::record {

// When a recording ends by itself.
struct Limits {
  std::uint64_t frames = GapLedger::no_limit;
  std::optional<std::chrono::nanoseconds> duration;  // from the first frame
};

struct Progress {
  std::uint64_t run_id = 0;      // of the newest frame
  std::uint64_t next_frame = 0;  // that is expected in this run
  std::uint64_t frames = 0;      // complete ones
  std::uint64_t missing = 0;     // frames
  std::uint64_t dropped = 0;     // messages that did not fit the queue
};

enum class EndReason { stopped, frames, duration, failed };

// What there is to say when the thread has ended.
struct Reception {
  EndReason end = EndReason::stopped;
  std::vector<RunSummary> runs;
  std::vector<Gap> gaps;
  std::map<wire::TopicId, std::uint64_t> dropped;  // messages
  std::uint64_t unreadable = 0;                    // messages without a sensible head
  double seconds = 0;                              // from the first frame to the end
  std::string server_version;
  std::string error;  // EndReason::failed: why nothing more can be taken; "" if it was the file
};

class Receiver {
 public:
  // Takes the samples of `world`. The first three must outlive the receiver.
  static wire::Result<std::unique_ptr<Receiver>> create(const wire::Participant& participant,
                                                        const Subscriptions& subscriptions, ItemQueue& queue,
                                                        const std::string& world, const Limits& limits);
  ~Receiver() { stop(); }
  Receiver(const Receiver&) = delete;
  Receiver& operator=(const Receiver&) = delete;

  void start();

  // Takes what has arrived, waits a moment for the rest of a frame that has begun, and ends.
  void stop();

  bool ended() const { return ended_; }  // a limit was reached, or the file failed
  Progress progress() const;
  Reception reception() const;  // after stop()

 private:
  using Clock = std::chrono::steady_clock;

  struct Arrival {
    wire::FrameHead head;
    std::uint64_t writer = 0;
    Message message;
  };

  Receiver(const Subscriptions& subscriptions, ItemQueue& queue, std::string world, const Limits& limits,
           wire::GuardCondition guard, wire::WaitSet wait_set);
  void run();
  void finish_frames();
  bool at_end();
  void receive();
  void receive_scenes();
  void receive_frames(const wire::RawReader& reader);
  void receive_messages(const wire::RawReader& reader);
  bool belongs(wire::TopicId topic, const wire::RawSample& sample);
  void note_arrival(const wire::RawSample& sample);
  void sort_arrivals();
  void admit(Arrival& arrival);
  bool push(wire::TopicId topic, Item item);
  void fail(const std::string& error);

  const Subscriptions& subscriptions_;
  ItemQueue& queue_;
  const std::string world_;
  const Limits limits_;
  wire::GuardCondition guard_;
  wire::WaitSet wait_set_;  // after what it waits for

  std::vector<Arrival> arrivals_;  // scratch
  std::size_t arrived_bytes_ = 0;
  std::map<wire::TopicId, std::uint32_t> sequences_;  // of all topics but the frames
  SceneFiles scene_files_;
  std::optional<Clock::time_point> first_frame_;
  Clock::time_point end_time_;

  mutable std::mutex mutex_;  // for the two below while the thread runs
  GapLedger ledger_;
  Reception reception_;

  std::atomic<bool> stopping_ = false;
  std::atomic<bool> ended_ = false;
  std::thread thread_;
};

}  // namespace flexcast::record
