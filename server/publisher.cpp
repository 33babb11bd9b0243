#include "server/publisher.h"

#include <algorithm>

namespace flexcast::server {
namespace {

using namespace std::chrono_literals;

constexpr Clock::duration request_period = 180ms;     // of fresh statuses
constexpr Clock::duration status_period = 240ms;      // at the latest an old one is published again
constexpr double report_share = 0.05;                 // of the simulation's time, at most, for reports
constexpr Clock::duration match_time = 20ms;          // until both sides of a new match surely know each other
constexpr Clock::duration late_reader_delay = 100ms;  // a new reader waits that long for a frame, then gets the newest
constexpr Clock::duration held_period = 500ms;        // a world in lockstep sends its newest frame again while it waits
constexpr Clock::duration poll_period = 50ms;         // for new readers
constexpr Clock::duration drain_time = 1s;

}  // namespace

Publisher::Publisher(Publications& publications, FrameMailbox& mailbox)
    : publications_(publications), mailbox_(mailbox) {}

void Publisher::start() {
  thread_ = std::thread(&Publisher::run, this);
}

void Publisher::stop(const std::string& last_words) {
  if (!stopping_) last_words_ = last_words;
  stopping_ = true;
  mailbox_.wake();
  if (thread_.joinable()) thread_.join();
}

Publisher::Latest Publisher::latest() const {
  const std::scoped_lock lock(latest_mutex_);
  return latest_;
}

void Publisher::run() {
  while (!stopping_) {
    const auto now = Clock::now();
    if (turn(now)) continue;
    mailbox_.wait_until(std::min({next_request_, status_written_ + status_period, now + poll_period}));
  }
  drain();
}

void Publisher::drain() {
  const auto end = Clock::now() + drain_time;
  while (Clock::now() < end && turn(Clock::now())) {
  }
  if (!last_words_.empty()) status_.warnings.push_back(last_words_);
  write_status(Clock::now());
  publications_.dispose();
}

bool Publisher::turn(Clock::time_point now) {
  publish_notices();
  publish_status(now);
  const bool any = publish_frame(now);
  serve_late_reader(now);
  return any;
}

void Publisher::publish_notices() {
  for (const Notice& notice : mailbox_.take_notices()) publications_.publish(notice);
}

void Publisher::publish_status(Clock::time_point now) {
  if (auto fresh = mailbox_.take_status()) {
    status_ = std::move(*fresh);
    return write_status(now);
  }
  if (now >= next_request_) {
    mailbox_.want_status();
    next_request_ = now + std::max(request_period, from_seconds(status_.report_seconds / report_share));
  }
  if (now >= status_written_ + status_period) write_status(now);
}

void Publisher::write_status(Clock::time_point now) {
  DeliveryStatus delivery;
  delivery.heartbeat = mailbox_.heartbeat();
  delivery.silent = !stopping_ && heartbeat_watch_.is_silent(now, delivery.heartbeat);
  if (newest_ != nullptr && newest_->header.run_id == status_.run_id) {
    delivery.frames_published = published_;
    delivery.unpublished = unpublished_.ranges();
  }
  delivery.frame_queue = static_cast<std::uint32_t>(mailbox_.waiting());
  delivery.readers = publications_.frame_readers().current;
  publications_.publish(status_, delivery);
  status_written_ = now;
  const std::scoped_lock lock(latest_mutex_);
  latest_ = {status_, delivery};
}

bool Publisher::publish_frame(Clock::time_point now) {
  const std::uint64_t run_before = newest_ != nullptr ? newest_->header.run_id : 0;
  const Frame* frame = mailbox_.take();
  if (frame == nullptr) return false;
  if (frame->header.run_id != run_before) {
    published_ = 0;
    unpublished_.clear();
  }
  newest_ = frame;
  newest_published_ = publications_.publish(*frame);
  newest_written_ = now;
  if (newest_published_) ++published_;
  unpublished_.note(frame->header.frame, newest_published_);
  if (reader_joined_ && now - *reader_joined_ >= match_time) reader_joined_.reset();
  return true;
}

void Publisher::serve_late_reader(Clock::time_point now) {
  const std::uint32_t total = publications_.frame_readers().total;
  if (total > readers_ever_) reader_joined_ = now;
  readers_ever_ = total;
  if (newest_ == nullptr) return;
  const bool is_late = reader_joined_ && now - *reader_joined_ >= late_reader_delay;
  if (!is_late && !(mailbox_.held() && now - newest_written_ >= held_period)) return;
  reader_joined_.reset();
  publish_newest_again(now);
}

void Publisher::publish_newest_again(Clock::time_point now) {
  newest_written_ = now;
  if (!publications_.publish(*newest_) || newest_published_) return;
  newest_published_ = true;
  ++published_;
  unpublished_.note_newest_published();
}

}  // namespace flexcast::server
