#include "clients/record/receiver.h"

#include <algorithm>
#include <numeric>

#include "idl/wire/decode.h"
#include "idl/wire/fill.h"
#include "idl/wire/message_head.h"

namespace flexcast::record {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t batch_samples = 64;
constexpr std::size_t batch_bytes = std::size_t{64} << 20;  // taken before they go to the queue
constexpr auto longest_wait = 100ms;
constexpr auto finishing_time = 500ms;  // for the rest of a frame, or one more status
constexpr auto finishing_period = 5ms;
constexpr auto discarding_time = 1s;
constexpr auto room_time = 2s;  // for the disk to take what is in hand when the end has come

std::int64_t system_time() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

}  // namespace

wire::Result<std::unique_ptr<Receiver>> Receiver::create(const wire::Participant& participant,
                                                         const Subscriptions& subscriptions, ItemQueue& queue,
                                                         const std::string& world, const Limits& limits) {
  auto guard = wire::GuardCondition::create(participant);
  if (!guard) return guard.error();
  auto wait_set = wire::WaitSet::create(participant);
  if (!wait_set) return wait_set.error();
  std::unique_ptr<Receiver> receiver(
      new Receiver(subscriptions, queue, world, limits, std::move(guard).value(), std::move(wait_set).value()));
  wire::WaitSet& set = receiver->wait_set_;
  if (auto attached = set.attach(receiver->guard_); !attached) return attached.error();
  if (auto attached = set.attach_data(subscriptions.scenes()); !attached) return attached.error();
  for (const wire::RawReader& reader : subscriptions.raw()) {
    if (auto attached = set.attach_data(reader); !attached) return attached.error();
  }
  return receiver;
}

Receiver::Receiver(const Subscriptions& subscriptions, ItemQueue& queue, std::string world, const Limits& limits,
                   wire::GuardCondition guard, wire::WaitSet wait_set)
    : subscriptions_(subscriptions),
      queue_(queue),
      world_(std::move(world)),
      limits_(limits),
      guard_(std::move(guard)),
      wait_set_(std::move(wait_set)),
      ledger_(limits.frames) {}

Receiver::~Receiver() {
  stop();
  discard_rest();
}

void Receiver::start(std::function<void(const Progress&)> after_batch) {
  set_paused(paused_asked_);
  after_batch_ = std::move(after_batch);
  thread_ = std::thread(&Receiver::run, this);
}

void Receiver::stop() {
  stopping_ = true;
  guard_.trigger();
  if (thread_.joinable()) thread_.join();
}

void Receiver::ask_paused(bool paused) {
  paused_asked_ = paused;
  guard_.trigger();
}

void Receiver::set_paused(bool paused) {
  const std::scoped_lock lock(mutex_);
  if (paused == ledger_.is_paused()) return;
  if (paused) {
    ledger_.pause();
  } else {
    ledger_.resume();
  }
}

bool Receiver::is_paused() const {
  const std::scoped_lock lock(mutex_);
  return ledger_.is_paused();
}

Progress Receiver::progress() const {
  const std::scoped_lock lock(mutex_);
  const auto dropped = std::accumulate(reception_.dropped.begin(), reception_.dropped.end(), std::uint64_t{0},
                                       [](std::uint64_t sum, const auto& entry) { return sum + entry.second; });
  return {ledger_.run_id(), ledger_.next_frame(), ledger_.contiguous_end(),
          ledger_.frames(), ledger_.missing(),    dropped};
}

Reception Receiver::reception() const {
  const std::scoped_lock lock(mutex_);
  Reception reception = reception_;
  reception.runs = ledger_.runs();
  reception.gaps = ledger_.gaps();
  reception.pauses = ledger_.pauses();
  const auto end = end_time_.value_or(Clock::now());
  if (first_frame_) reception.seconds = std::chrono::duration<double>(end - *first_frame_).count();
  return reception;
}

void Receiver::lose(const wire::FrameHead& head) {
  const std::scoped_lock lock(mutex_);
  ledger_.lose(head);
}

void Receiver::run() {
  while (!at_end()) {
    auto timeout = std::chrono::nanoseconds(longest_wait);
    if (limits_.duration && first_frame_) {
      timeout = std::min<std::chrono::nanoseconds>(timeout, *first_frame_ + *limits_.duration - Clock::now());
    }
    wait_set_.wait(std::max(timeout, 0ns));
    guard_.reset();
    const bool paused = paused_asked_;
    receive();
    set_paused(paused);
  }
  if (reception_.end != EndReason::failed) finish_frames();
  const std::scoped_lock lock(mutex_);
  end_time_ = Clock::now();
  ended_ = true;
}

bool Receiver::at_end() {
  const std::scoped_lock lock(mutex_);
  if (reception_.end == EndReason::failed) return true;
  if (ledger_.is_full()) {
    reception_.end = EndReason::frames;
  } else if (limits_.duration && first_frame_ && Clock::now() - *first_frame_ >= *limits_.duration) {
    reception_.end = EndReason::duration;
  } else {
    return stopping_;
  }
  return true;
}

void Receiver::finish_frames() {
  receive();
  {
    const std::scoped_lock lock(mutex_);
    ledger_.close();
  }
  const std::uint64_t statuses = statuses_;
  for (const auto latest = Clock::now() + finishing_time; waits_for_more(statuses) && Clock::now() < latest;) {
    std::this_thread::sleep_for(finishing_period);
    receive();
  }
}

bool Receiver::waits_for_more(std::uint64_t statuses_before) const {
  const std::scoped_lock lock(mutex_);
  if (reception_.end == EndReason::failed) return false;
  return ledger_.in_progress() > 0 || (statuses_ == statuses_before && ledger_.has_lost());
}

void Receiver::receive() {
  receive_scenes();
  for (const wire::RawReader& reader : subscriptions_.raw()) {
    if (reader.row().id == wire::TopicId::frames) {
      receive_frames(reader);
    } else {
      receive_messages(reader);
    }
  }
}

void Receiver::receive_scenes() {
  const auto samples = subscriptions_.scenes().take();
  if (!samples) return fail(samples.error().message);
  for (const auto [scene, info] : samples.value()) {
    if (!info.valid || wire::text(scene.world) != world_) continue;
    {
      const std::scoped_lock lock(mutex_);
      reception_.server_version = wire::text(scene.version);
    }
    for (Attachment& file : scene_files_.take_new(scene, system_time())) push(wire::TopicId::scene, std::move(file));
  }
}

bool Receiver::belongs(wire::TopicId topic, const wire::RawSample& sample) {
  if (!sample.info.valid) return false;  // the end of an instance: no data
  const auto world = wire::peek_world(topic, sample.bytes);
  if (world) return world == world_;
  const std::scoped_lock lock(mutex_);
  ++reception_.unreadable;
  return false;
}

void Receiver::receive_messages(const wire::RawReader& reader) {
  const wire::TopicId topic = reader.row().id;
  const auto receive_one = [&](const wire::RawSample& sample) {
    if (!belongs(topic, sample)) return;
    if (topic == wire::TopicId::status) note_status(sample);
    // A number is used up by a message that is dropped, too: it shows.
    push(topic, make_message(topic, sequences_[topic]++, sample));
  };
  if (const auto taken = reader.take_raw(receive_one, batch_samples); !taken) fail(taken.error().message);
}

void Receiver::note_status(const wire::RawSample& sample) {
  ++statuses_;
  const auto status = wire::decode<flexcast_Status>(sample.bytes);
  if (!status) return;
  const std::scoped_lock lock(mutex_);
  const auto& unpublished = status.value()->unpublished;
  ledger_.note_unpublished(status.value()->run_id, {unpublished._buffer, unpublished._length});
}

// Takes all there is and puts it in order.
void Receiver::receive_frames(const wire::RawReader& reader) {
  batch_.clear();
  const auto receive_one = [&](const wire::RawSample& sample) {
    if (!belongs(wire::TopicId::frames, sample) || batch_.add(sample)) return;
    const std::scoped_lock lock(mutex_);
    ++reception_.unreadable;
  };
  for (std::size_t count = batch_samples; count == batch_samples && batch_.bytes() < batch_bytes;) {
    const auto taken = reader.take_raw(receive_one, batch_samples);
    if (!taken) return fail(taken.error().message);
    count = taken.value();
  }
  if (batch_.arrivals().empty()) return;
  batch_.sort(progress().run_id);
  for (FrameBatch::Arrival& arrival : batch_.arrivals()) admit(arrival);
  batch_.clear();
  after_batch_(progress());
}

void Receiver::admit(FrameBatch::Arrival& arrival) {
  {
    const std::scoped_lock lock(mutex_);
    const Verdict verdict = ledger_.judge(arrival.head);
    if (verdict == Verdict::invalid) ++reception_.unreadable;
    if (verdict == Verdict::paused) ledger_.skip(arrival.head, arrival.writer);
    if (verdict == Verdict::beyond) ledger_.pass(arrival.head);
    if (verdict != Verdict::record) return;
    if (!first_frame_) first_frame_ = Clock::now();
  }
  record(arrival);
}

void Receiver::record(FrameBatch::Arrival& arrival) {
  const Pushed pushed = push(wire::TopicId::frames, std::move(arrival.message));
  const std::scoped_lock lock(mutex_);
  if (pushed == Pushed::full) return ledger_.drop(arrival.head, arrival.writer);
  ledger_.add(arrival.head, arrival.writer);
  if (pushed == Pushed::closed) ledger_.lose(arrival.head);
}

Pushed Receiver::push(wire::TopicId topic, Item item) {
  Pushed pushed = queue_.push(std::move(item));
  while (pushed == Pushed::full && may_wait_for_room()) {
    queue_.wait_for_room(longest_wait);
    pushed = queue_.push(std::move(item));
  }
  if (pushed == Pushed::closed) fail("");
  if (pushed == Pushed::full) {
    const std::scoped_lock lock(mutex_);
    ++reception_.dropped[topic];
  }
  return pushed;
}

bool Receiver::may_wait_for_room() {
  if (!lockstep_) return false;
  if (!stopping_) return true;
  if (!latest_room_) latest_room_ = Clock::now() + room_time;
  return Clock::now() < *latest_room_;
}

void Receiver::fail(const std::string& error) {
  const std::scoped_lock lock(mutex_);
  if (reception_.end == EndReason::failed) return;
  reception_.end = EndReason::failed;
  reception_.error = error;
}

// The readers go next. Deleting one that is full never ends: Cyclone's thread waits for room in it, and the deletion
// for that thread.
void Receiver::discard_rest() {
  const auto latest = Clock::now() + discarding_time;
  for (const wire::RawReader& reader : subscriptions_.raw()) {
    for (std::size_t count = batch_samples; count == batch_samples && Clock::now() < latest;) {
      const auto taken = reader.take_raw([](const wire::RawSample&) {}, batch_samples);
      count = taken ? taken.value() : 0;
    }
  }
}

}  // namespace flexcast::record
