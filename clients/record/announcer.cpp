#include "clients/record/announcer.h"

#include <fmt/format.h>
#include <unistd.h>

#include <random>

#include "idl/wire/fill.h"

namespace flexcast::record {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds period{1};

}  // namespace

wire::Result<Announcer> Announcer::create(const wire::Participant& participant, const std::string& world,
                                          const std::string& file) {
  auto writer = wire::Writer<flexcast_RecorderInfo>::create(participant);
  if (!writer) return writer.error();
  return Announcer(std::move(writer).value(), world, file);
}

Announcer::Announcer(wire::Writer<flexcast_RecorderInfo> writer, const std::string& world, const std::string& file)
    : writer_(std::move(writer)) {
  wire::set_string(info_->world, world);
  wire::set_string(info_->recorder_id, fmt::format("recorder-{}-{:08x}", getpid(), std::random_device()()));
  wire::set_string(info_->file, file);
}

void Announcer::announce(flexcast_RecorderState state, const Progress& progress, std::uint64_t bytes,
                         const std::string& text) {
  const auto now = Clock::now();
  if (announced_ && info_->state == state && now - *announced_ < period) return;
  info_->state = state;
  info_->run_id = progress.run_id;
  info_->next_frame = progress.next_frame;
  info_->frames = progress.frames;
  info_->gaps = progress.missing;
  info_->bytes = bytes;
  wire::set_string(info_->text, text);
  (void)writer_.write(*info_);  // nobody waits for it: a recording does not fail because of it
  announced_ = now;
}

}  // namespace flexcast::record
