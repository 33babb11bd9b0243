#include "server/recorder_watch.h"

#include <spdlog/spdlog.h>

#include "idl/wire/fill.h"

namespace flexcast::server {
namespace {

bool takes_part(const flexcast_RecorderInfo& recorder) {
  return recorder.lockstep &&
         (recorder.state == flexcast_RECORDER_WAITING || recorder.state == flexcast_RECORDER_RECORDING ||
          recorder.state == flexcast_RECORDER_PAUSED);
}

}  // namespace

wire::Result<std::unique_ptr<RecorderWatch>> RecorderWatch::create(const wire::Participant& participant,
                                                                   std::string world, RecorderRoll& roll,
                                                                   std::function<void()> changed) {
  auto reader = wire::Reader<flexcast_RecorderInfo>::create(participant);
  if (!reader) return reader.error();
  auto stop_signal = wire::GuardCondition::create(participant);
  if (!stop_signal) return stop_signal.error();
  auto wait_set = wire::WaitSet::create(participant);
  if (!wait_set) return wait_set.error();
  if (auto attached = wait_set.value().attach_data(reader.value()); !attached) return attached.error();
  if (auto attached = wait_set.value().attach(stop_signal.value()); !attached) return attached.error();
  return std::unique_ptr<RecorderWatch>(new RecorderWatch(std::move(world), roll, std::move(changed),
                                                          std::move(reader).value(), std::move(stop_signal).value(),
                                                          std::move(wait_set).value()));
}

RecorderWatch::RecorderWatch(std::string world, RecorderRoll& roll, std::function<void()> changed,
                             wire::Reader<flexcast_RecorderInfo> reader, wire::GuardCondition stop_signal,
                             wire::WaitSet wait_set)
    : world_(std::move(world)),
      roll_(roll),
      changed_(std::move(changed)),
      reader_(std::move(reader)),
      stop_signal_(std::move(stop_signal)),
      wait_set_(std::move(wait_set)) {}

void RecorderWatch::start() {
  thread_ = std::thread(&RecorderWatch::run, this);
}

void RecorderWatch::stop() {
  stopping_ = true;
  stop_signal_.trigger();
  if (thread_.joinable()) thread_.join();
}

void RecorderWatch::run() {
  while (!stopping_) {
    if (wait_set_.wait(std::chrono::seconds(1))) take();
    forget_the_dead();
  }
}

void RecorderWatch::take() {
  auto samples = reader_.take();
  if (!samples) {
    spdlog::error("{}", samples.error().message);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));  // not in a tight loop
    return;
  }
  for (const auto [recorder, info] : samples.value()) {
    if (wire::text(recorder.world) == world_) follow(recorder, info);
  }
  if (!samples.value().empty()) changed_();
}

// A process that was killed does not always show as a change of its instance; its writer is gone in any case.
void RecorderWatch::forget_the_dead() {
  const auto forgotten = std::erase_if(writers_, [this](const auto& entry) {
    if (reader_.participant_of(entry.second)) return false;
    roll_.forget(entry.first);
    return true;
  });
  if (forgotten > 0) changed_();
}

// An instance that is not alive was disposed, or its writer is gone, by its own will or since its lease has run out.
void RecorderWatch::follow(const flexcast_RecorderInfo& recorder, const wire::SampleInfo& info) {
  const std::string id(wire::text(recorder.recorder_id));
  if (info.state == wire::InstanceState::alive && !info.valid) return;
  if (info.state != wire::InstanceState::alive || !takes_part(recorder)) {
    writers_.erase(id);
    return roll_.forget(id);
  }
  writers_[id] = info.writer;
  roll_.note(id, {recorder.state == flexcast_RECORDER_PAUSED, recorder.run_id, recorder.next_frame});
}

}  // namespace flexcast::server
