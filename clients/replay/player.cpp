#include "clients/replay/player.h"

#include <algorithm>
#include <utility>

namespace flexcast::replay {
namespace {

using namespace std::chrono_literals;

constexpr Clock::duration status_period = 200ms;      // at the latest a status is published again
constexpr Clock::duration match_time = 20ms;          // until both sides of a new match surely know each other
constexpr Clock::duration late_reader_delay = 100ms;  // a new reader waits that long for a frame, then gets the newest
constexpr Clock::duration poll_period = 50ms;         // for new readers

}  // namespace

Player::Player(Tape tape, const PlayerOptions& options, Publications& publications, CommandDesk& desk)
    : tape_(std::move(tape)),
      options_(options),
      publications_(publications),
      desk_(desk),
      settings_(options.settings),
      pacer_(options.settings.rate),
      state_(options.paused ? flexcast_WORLD_PAUSED : flexcast_WORLD_RUNNING) {
  for (const recording::RunEntry& run : tape_.index().runs()) run_ids_.skip(run.run_id);
  shown_.run_id = tape_.clips().front().run_id;
  shown_.time = tape_.next().time;
}

void Player::announce() {
  publish_status(false);
}

void Player::begin(Clock::time_point now) {
  heartbeat_ = 1;
  if (!tape_.is_from_start()) return jump(0, tape_.clips().front().begin, now);
  show_next(now);
  settle();
}

Clock::duration Player::turn(Clock::time_point now) {
  ++heartbeat_;
  Clock::duration wait = poll_period;
  if (running()) {
    wait = wait_for_next(now);
    if (wait == Clock::duration::zero()) {
      if (!tape_.at_end()) {
        show_next(now);
      } else if (settings_.loop) {
        end_pass(now);
      }
      settle();
    }
  }
  serve_late_reader(now);
  if (now >= status_written_ + status_period) publish_status(false);
  return std::clamp<Clock::duration>(wait, 0ns, std::min(poll_period, status_written_ + status_period - now));
}

void Player::close() {
  drop_goal("the replay is ending");
  publish_status(false);
  publications_.dispose(options_.world);
}

Clock::duration Player::wait_for_next(Clock::time_point now) {
  if (tape_.at_end()) return Clock::duration::zero();
  const double next_time = tape_.next().time;
  if (!tape_.begins_clip()) return pacer_.calc_wait(now, shown_.time, next_time);
  pacer_.restart();
  return pacer_.calc_wait(now, next_time, next_time);
}

void Player::show_next(Clock::time_point now) {
  const std::uint64_t run_before = shown_.run_id;
  if (tape_.begins_clip()) health_.forget();
  tape_.play([this](const recording::RecordedMessage& message) { publish(message); });
  if (shown_.run_id != run_before) frames_published_ = 0;
  ++frames_published_;
  if (reader_joined_ && now - *reader_joined_ >= match_time) reader_joined_.reset();
  if (goal_ && goal_->frames > 0 && --goal_->frames == 0) goal_->time = shown_.time;
}

// Ends the goal or the recording that the last frame has reached.
void Player::settle() {
  const bool ended = tape_.at_end() && !settings_.loop;
  const bool arrived = goal_ && goal_->time && has_reached(shown_.time, *goal_->time);
  const bool run_ended = goal_ && goal_->time && !arrived && (tape_.at_end() || tape_.begins_clip());
  if (!running() || !(ended || arrived || run_ended)) return;
  if (ended) tape_.play_rest([this](const recording::RecordedMessage& message) { publish(message); });
  state_ = ended ? flexcast_WORLD_FINISHED : flexcast_WORLD_PAUSED;
  pacer_.restart();
  publish_status(false);
  if (!arrived) return drop_goal("the recording of this run ends at " + client::to_text(shown_.time) + " s");
  const Goal goal = std::move(*std::exchange(goal_, std::nullopt));
  answer(*goal.command);
}

// The next round.
void Player::end_pass(Clock::time_point now) {
  tape_.play_rest([this](const recording::RecordedMessage& message) { publish(message); });
  jump(0, tape_.clips().front().begin, now);
}

// What comes from there on is published as new runs.
void Player::jump(std::size_t clip, std::size_t frame, Clock::time_point now) {
  const auto frames = tape_.index().frames();
  runs_ = {};
  for (std::size_t c = clip; c < tape_.clips().size(); ++c) {
    const Clip& one = tape_.clips()[c];
    runs_.add(one.run_id, {run_ids_.next(), frames[c == clip ? frame : one.begin].number});
  }
  tape_.go_to(clip, frame);
  shown_ = {.run_id = runs_.find(tape_.clips()[clip].run_id)->run_id, .time = frames[frame].time};
  frames_published_ = 0;
  health_.forget();
  pacer_.restart();
  show_next(now);
  publish_status(false);
}

void Player::publish(const recording::RecordedMessage& message) {
  if (message.topic == wire::TopicId::status) {
    health_.note(message.bytes);
    return publish_status(true);
  }
  if (message.topic == wire::TopicId::frames) show(message);
  publications_.publish(message, stamp());
}

void Player::show(const recording::RecordedMessage& message) {
  const auto peeked = wire::peek_frame_head(message.bytes);
  if (!peeked) return;
  const wire::FrameHead& head = peeked.value();
  const auto run = runs_.find(head.run_id);
  if (!run || head.frame < run->first) return;
  shown_ = {run->run_id, head.frame - run->first, head.step,
            head.time,   head.parameter_revision, head.topology_revision};
}

wire::Owned<flexcast_Status> Player::make_status(bool as_it_came) const {
  OwnState own;
  own.state = state_;
  own.heartbeat = heartbeat_;
  own.server_id = options_.server_id;
  own.rate = settings_.rate;
  own.frames_published = frames_published_;
  own.readers = publications_.frame_readers().current;
  return health_.make(shown_, own, stamp(), as_it_came);
}

void Player::publish_status(bool as_it_came) {
  publications_.publish(*make_status(as_it_came));
  status_written_ = Clock::now();
}

void Player::serve_late_reader(Clock::time_point now) {
  const std::uint32_t total = publications_.frame_readers().total;
  if (total > readers_ever_) reader_joined_ = now;
  readers_ever_ = total;
  if (!reader_joined_ || now - *reader_joined_ < late_reader_delay) return;
  reader_joined_.reset();
  tape_.play_last_again([this](const recording::RecordedMessage& message) { publications_.publish(message, stamp()); });
}

}  // namespace flexcast::replay
