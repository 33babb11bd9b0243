#include "clients/record/announcer.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <random>

#include "idl/wire/fill.h"

namespace flexcast::record {
namespace {

constexpr std::chrono::seconds announcement_period{1};

}  // namespace

wire::Result<std::unique_ptr<Announcer>> Announcer::create(const wire::Participant& participant,
                                                           const std::string& world, const std::string& file,
                                                           const std::string& id) {
  auto writer = wire::Writer<flexcast_RecorderInfo>::create(participant);
  if (!writer) return writer.error();
  return std::unique_ptr<Announcer>(new Announcer(std::move(writer).value(), world, file, id));
}

Announcer::Announcer(wire::Writer<flexcast_RecorderInfo> writer, const std::string& world, const std::string& file,
                     const std::string& id)
    : writer_(std::move(writer)) {
  wire::set_string(info_->world, world);
  const std::string own = fmt::format("recorder-{}-{:08x}", getpid(), std::random_device()());
  wire::set_string(info_->recorder_id, id.empty() ? own : id);
  wire::set_string(info_->file, file);
}

std::string Announcer::id() const {
  const std::scoped_lock lock(mutex_);
  return std::string(wire::text(info_->recorder_id));
}

void Announcer::announce(flexcast_RecorderState state, const Progress& progress, std::uint64_t bytes,
                         const std::string& text) {
  const std::scoped_lock lock(mutex_);
  if (announced_ && info_->state == state && Clock::now() - *announced_ < announcement_period) return;
  info_->state = state;
  info_->bytes = bytes;
  wire::set_string(info_->text, text);
  write(progress);
}

void Announcer::announce_batch(const Progress& progress) {
  const std::scoped_lock lock(mutex_);
  if (info_->lockstep) write(progress);
}

void Announcer::acknowledge(std::uint64_t request_id) {
  const std::scoped_lock lock(mutex_);
  info_->request_id = request_id;
  announced_.reset();
}

bool Announcer::update_lockstep(const wire::Guid& server, const Progress& progress) {
  const auto peers = writer_.matched_participants();
  const bool lockstep = std::find(peers.begin(), peers.end(), server) != peers.end();
  const std::scoped_lock lock(mutex_);
  if (lockstep == info_->lockstep) return lockstep;
  info_->lockstep = lockstep;
  write(progress);
  return lockstep;
}

// A server that waits needs the end of what is whole; others are told how far the recording is.
void Announcer::write(const Progress& progress) {
  info_->run_id = progress.run_id;
  info_->next_frame = info_->lockstep ? progress.contiguous_end : progress.next_frame;
  info_->frames = progress.frames;
  info_->gaps = progress.missing;
  (void)writer_.write(*info_);  // nobody waits for it: a recording does not fail because of it
  announced_ = Clock::now();
}

}  // namespace flexcast::record
