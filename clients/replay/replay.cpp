#include "clients/replay/replay.h"

#include <fmt/format.h>

#include <utility>

#include "clients/replay/claim.h"

namespace flexcast::replay {
namespace {

using wire::Error;
using wire::Result;

std::string count(std::size_t number, const char* what) {
  return fmt::format("{} {}{}", number, what, number == 1 ? "" : "s");
}

std::string describe(const Tape& tape, double rate, bool paused) {
  std::size_t frames = 0;
  for (const Clip& clip : tape.clips()) frames += clip.end - clip.begin;
  return fmt::format("{} in {}, rate {}{}", count(frames, "frame"), count(tape.clips().size(), "run"),
                     rate > 0.0 ? fmt::format("{:g}", rate) : "max", paused ? ", paused" : "");
}

// The tape, ready to play; what is odd about the recording is said.
Result<Tape> make_tape(const Options& options, const Replay::Listener& listener) {
  auto recording = recording::Recording::open(options.file);
  if (!recording) return recording.error();
  auto index = recording::Index::make(recording.value(), listener.read);
  if (!index) return index.error();
  if (!index.value().trouble().empty()) listener.say(index.value().trouble() + "; it is replayed as far as it goes");
  auto clips = make_clips(index.value(), options.from, options.to);
  if (clips.empty()) {
    return Error{fmt::format("{}: no run has a frame between --from {:g} s and --to {:g} s", options.file,
                             options.from.value_or(0.0), options.to.value_or(HUGE_VAL))};
  }
  return Tape(std::move(recording).value(), std::move(index).value(), std::move(clips));
}

}  // namespace

Result<std::unique_ptr<Replay>> Replay::start(const Options& options, const Listener& listener) {
  auto tape = make_tape(options, listener);
  if (!tape) return tape.error();
  const std::string world = options.world.empty() ? tape.value().index().world() : options.world;
  auto participant =
      wire::Participant::create({.domain = options.domain, .profile = options.profile, .security = options.security});
  if (!participant) return participant.error();
  auto publications = Publications::create(participant.value(), tape.value().index().frame_bytes(), listener.say);
  if (!publications) return publications.error();
  auto desk = CommandDesk::create(participant.value(), world);
  if (!desk) return desk.error();
  auto stop_signal = wire::GuardCondition::create(participant.value());
  if (!stop_signal) return stop_signal.error();
  auto wait_set = wire::WaitSet::create(participant.value());
  if (!wait_set) return wait_set.error();
  std::unique_ptr<Replay> replay(new Replay(std::move(participant).value(), world, std::move(publications).value(),
                                            std::move(desk).value(), std::move(stop_signal).value(),
                                            std::move(wait_set).value()));
  if (auto attached = replay->wait_set_.attach_data(replay->desk_.reader()); !attached) return attached.error();
  if (auto attached = replay->wait_set_.attach(replay->stop_signal_); !attached) return attached.error();
  replay->description_ =
      fmt::format("world {} on domain {}, profile {}: {}", world, replay->participant_.domain(),
                  replay->participant_.profile(), describe(tape.value(), options.rate, options.paused));
  const PlayerOptions player{world, system_nanoseconds(), {options.rate, options.loop}, options.paused};
  replay->player_ = std::make_unique<Player>(std::move(tape).value(), player, replay->publications_, replay->desk_);
  if (auto claimed = claim_world(replay->participant_, world, player.server_id, [&] { replay->player_->announce(); });
      !claimed) {
    return claimed.error();
  }
  replay->thread_ = std::thread(&Replay::run, replay.get());
  return replay;
}

Replay::Replay(wire::Participant participant, std::string world, Publications publications, CommandDesk desk,
               wire::GuardCondition stop_signal, wire::WaitSet wait_set)
    : participant_(std::move(participant)),
      world_(std::move(world)),
      publications_(std::move(publications)),
      desk_(std::move(desk)),
      stop_signal_(std::move(stop_signal)),
      wait_set_(std::move(wait_set)) {}

void Replay::stop() {
  stopping_ = true;
  stop_signal_.trigger();
  if (thread_.joinable()) thread_.join();
}

void Replay::run() {
  player_->begin(Clock::now());
  while (!stopping_) {
    const Clock::duration wait = player_->turn(Clock::now());
    tell();
    if (wait_set_.wait(wait)) player_->take_commands(Clock::now());
  }
  player_->close();
}

void Replay::tell() {
  const std::scoped_lock lock(mutex_);
  latest_ = {player_->state(), player_->shown(), player_->frames_published()};
}

Replay::Latest Replay::latest() const {
  const std::scoped_lock lock(mutex_);
  return latest_;
}

}  // namespace flexcast::replay
