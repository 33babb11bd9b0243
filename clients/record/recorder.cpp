#include "clients/record/recorder.h"

#include <thread>

namespace flexcast::record {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr std::size_t queue_bytes = std::size_t{256} << 20;
constexpr auto match_period = 5ms;
// Until the server surely knows of the match too, and a world that stands still has sent its newest frame again.
constexpr auto settle_time = 300ms;

Limits limits_of(const Options& options) {
  Limits limits;
  if (options.frames) limits.frames = *options.frames;
  if (options.duration) {
    limits.duration =
        std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(*options.duration));
  }
  return limits;
}

}  // namespace

wire::Result<std::unique_ptr<Recorder>> Recorder::start(const Options& options, const Interrupted& interrupted) {
  if (auto checked = check_output(options); !checked) return checked.error();
  auto participant =
      wire::Participant::create({.domain = options.domain, .profile = options.profile, .security = options.security});
  if (!participant) return participant.error();
  auto watch = wire::WorldWatch::create(participant.value());
  if (!watch) return watch.error();
  const std::chrono::duration<double> wait(options.wait);
  const auto found = find_world(watch.value(), participant.value(), options.world, wait, interrupted);
  if (!found) return found.error();
  const std::string& world = found.value().name;
  auto remote = RemoteControl::create(participant.value());
  if (!remote) return remote.error();
  auto announcer = Announcer::create(participant.value(), world, options.file, options.id);
  if (!announcer) return announcer.error();
  auto subscriptions = Subscriptions::create(participant.value(), world);
  if (!subscriptions) return subscriptions.error();

  std::unique_ptr<Recorder> recorder(new Recorder(std::move(participant).value(), std::move(watch).value(),
                                                  std::move(announcer).value(), std::move(remote).value(),
                                                  std::move(subscriptions).value(), world, options.file));
  if (auto matched = recorder->wait_for_match(wait, interrupted); !matched) return matched.error();
  if (auto opened = recorder->open(options); !opened) return opened.error();
  return recorder;
}

Recorder::Recorder(wire::Participant participant, wire::WorldWatch watch, std::unique_ptr<Announcer> announcer,
                   RemoteControl remote, Subscriptions subscriptions, const std::string& world, const std::string& path)
    : world_(world),
      path_(path),
      participant_(std::move(participant)),
      watch_(std::move(watch)),
      announcer_(std::move(announcer)),
      remote_(std::move(remote)),
      subscriptions_(std::move(subscriptions)),
      queue_(queue_bytes) {}

wire::Result<void> Recorder::wait_for_match(std::chrono::duration<double> wait, const Interrupted& interrupted) {
  const std::string place = describe_place(world_, participant_);
  announcer_->announce(flexcast_RECORDER_WAITING, {}, 0);
  for (const auto begin = Clock::now();;) {
    watch_.update();
    const wire::World* world = watch_.find(world_);
    if (world && subscriptions_.is_matched(world->participant)) break;
    if (interrupted()) return wire::Error{"interrupted while connecting to " + place};
    if (Clock::now() - begin > wait) return wire::Error{place + " does not publish all topics of a server"};
    std::this_thread::sleep_for(match_period);
  }
  std::this_thread::sleep_for(settle_time);
  return {};
}

wire::Result<void> Recorder::open(const Options& options) {
  auto receiver = Receiver::create(participant_, subscriptions_, queue_, world_, limits_of(options));
  if (!receiver) return receiver.error();
  receiver_ = std::move(receiver).value();
  receiver_->ask_paused(options.paused);
  auto destination = make_destination(options, [this] { return make_report(); });
  if (!destination) return destination.error();
  destination_ = std::move(destination).value();
  file_thread_ = std::make_unique<FileThread>(queue_, *destination_);
  file_thread_->start();
  update_lockstep();
  receiver_->start([this](const Progress& progress) { announcer_->announce_batch(progress); });
  announcer_->announce(state(), {}, 0);
  return {};
}

std::string Recorder::tend() {
  watch_.update();
  update_lockstep();
  carry_out_commands();
  const bool present = watch_.find(world_) != nullptr;
  const bool changed = present != std::exchange(present_, present);
  if (!stop_asked_) announcer_->announce(state(), progress(), bytes_written());
  if (!changed) return "";
  return describe_place(world_, participant_) + (present ? " is back" : " has gone: waiting for it");
}

void Recorder::carry_out_commands() {
  for (const RemoteCommand& command : remote_.take(world_, announcer_->id())) commands_.push_back(command);
  for (; !commands_.empty() && carry_out(commands_.front()); commands_.pop_front()) {
    announcer_->acknowledge(commands_.front().request_id);
    // Of RECORDER_STOP the end of the recording is the effect: it is told with that.
    if (!stop_asked_) announcer_->announce(state(), progress(), bytes_written());
  }
}

// False: it has no effect yet.
bool Recorder::carry_out(const RemoteCommand& command) {
  if (command.kind == flexcast_RECORDER_STOP) stop_asked_ = true;
  const bool is_start = command.kind == flexcast_RECORDER_START;
  if (!is_start && command.kind != flexcast_RECORDER_PAUSE) return true;
  receiver_->ask_paused(!is_start);
  return receiver_->is_paused() == !is_start;
}

void Recorder::update_lockstep() {
  const wire::World* world = watch_.find(world_);
  if (world) receiver_->set_lockstep(announcer_->update_lockstep(world->participant, progress()));
}

flexcast_RecorderState Recorder::state() const {
  if (!present_) return flexcast_RECORDER_WAITING;
  return is_paused() ? flexcast_RECORDER_PAUSED : flexcast_RECORDER_RECORDING;
}

wire::Result<Report> Recorder::finish() {
  receiver_->stop();
  const mcap::Status status = file_thread_->finish();
  auto report = status ? complete() : rescue(status.message());
  const std::string failure = report ? report.value().failure : report.error().message;
  const std::uint64_t bytes = report ? report.value().bytes : destination_->bytes_written();
  announcer_->announce(failure.empty() ? flexcast_RECORDER_FINISHED : flexcast_RECORDER_FAILED, progress(), bytes,
                       failure);
  return report;
}

Report Recorder::make_report() const {
  return {.file = path_,
          .world = world_,
          .domain = domain(),
          .profile = participant_.profile(),
          .reception = receiver_->reception()};
}

wire::Result<Report> Recorder::complete() {
  auto report = destination_->complete();
  if (!report) return rescue(report.error().message);
  if (report.value().reception.end == EndReason::failed) report.value().failure = report.value().reception.error;
  return report;
}

// The disk is full, as a rule: keeps what can be completed.
wire::Result<Report> Recorder::rescue(const std::string& failure) {
  for (const wire::FrameHead& head : file_thread_->unwritten()) receiver_->lose(head);
  for (;;) {
    const auto cut = destination_->cut_back();
    if (!cut) return wire::Error{cut.error().message == failure ? failure : failure + "; " + cut.error().message};
    for (const wire::FrameHead& head : cut.value()) receiver_->lose(head);
    auto report = destination_->complete();
    if (!report) continue;
    report.value().failure = failure;
    return report;
  }
}

}  // namespace flexcast::record
