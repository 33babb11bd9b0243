// Receiver: the thread that takes samples off the network, decides what is recorded and puts it into the queue.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "clients/record/frame_batch.h"
#include "clients/record/gap_ledger.h"
#include "clients/record/item_queue.h"
#include "clients/record/reception.h"
#include "clients/record/scene_files.h"
#include "clients/record/subscriptions.h"
#include "idl/wire/wait_set.h"

namespace flexcast::record {

// When a recording ends by itself.
struct Limits {
  std::uint64_t frames = GapLedger::no_limit;
  std::optional<std::chrono::nanoseconds> duration;  // from the first frame
};

class Receiver {
 public:
  // Takes the samples of `world`. The first three must outlive the receiver.
  static wire::Result<std::unique_ptr<Receiver>> create(const wire::Participant& participant,
                                                        const Subscriptions& subscriptions, ItemQueue& queue,
                                                        const std::string& world, const Limits& limits);
  ~Receiver();
  Receiver(const Receiver&) = delete;
  Receiver& operator=(const Receiver&) = delete;

  // `after_batch` is called on the thread of the receiver whenever frames have been put into the queue.
  void start(std::function<void(const Progress&)> after_batch = [](const Progress&) {});

  // Takes what has arrived, waits a moment for the rest of a frame that has begun and for news about frames of which
  // nobody knows why they are missing, and ends.
  void stop();

  // While paused new frames are not recorded, everything else is. Holds for what arrives after the call: what has
  // arrived before is taken first, and is_paused() changes then.
  void ask_paused(bool paused);
  bool is_paused() const;

  // The server waits for this recorder: nothing is dropped, a full queue is waited for.
  void set_lockstep(bool lockstep) { lockstep_ = lockstep; }

  bool ended() const { return ended_; }  // a limit was reached, or the file failed
  Progress progress() const;
  Reception reception() const;

  // The file could not take this chunk.
  void lose(const wire::FrameHead& head);

 private:
  using Clock = std::chrono::steady_clock;

  Receiver(const Subscriptions& subscriptions, ItemQueue& queue, std::string world, const Limits& limits,
           wire::GuardCondition guard, wire::WaitSet wait_set);
  void run();
  void set_paused(bool paused);
  void finish_frames();
  bool waits_for_more(std::uint64_t statuses_before) const;
  bool at_end();
  void receive();
  void receive_scenes();
  void receive_frames(const wire::RawReader& reader);
  void receive_messages(const wire::RawReader& reader);
  bool belongs(wire::TopicId topic, const wire::RawSample& sample);
  void note_status(const wire::RawSample& sample);
  void admit(FrameBatch::Arrival& arrival);
  void record(FrameBatch::Arrival& arrival);
  Pushed push(wire::TopicId topic, Item item);
  bool may_wait_for_room();
  void note_account();
  void give_up_holes();
  void fail(const std::string& error);
  void discard_rest();

  const Subscriptions& subscriptions_;
  ItemQueue& queue_;
  const std::string world_;
  const Limits limits_;
  wire::GuardCondition guard_;
  wire::WaitSet wait_set_;  // after what it waits for
  std::function<void(const Progress&)> after_batch_;

  FrameBatch batch_;
  std::map<wire::TopicId, std::uint32_t> sequences_;  // of all topics but the frames
  SceneFiles scene_files_;
  std::uint64_t statuses_ = 0;
  struct Hole {
    std::uint64_t run_id = 0, frame = 0;
    Clock::time_point since;
  };
  std::optional<Hole> hole_;     // the first of the present run, while in lockstep
  std::optional<Item> account_;  // an AccountNote that waits for room
  Clock::time_point account_noted_;
  std::optional<Clock::time_point> latest_room_;  // set when the end has come while the queue is full

  mutable std::mutex mutex_;  // for those below; not held while waiting for room
  GapLedger ledger_;
  Reception reception_;
  std::optional<Clock::time_point> first_frame_;
  std::optional<Clock::time_point> end_time_;

  std::atomic<bool> lockstep_ = false;
  std::atomic<bool> paused_asked_ = false;
  std::atomic<bool> stopping_ = false;
  std::atomic<bool> ended_ = false;
  std::thread thread_;
};

}  // namespace flexcast::record
