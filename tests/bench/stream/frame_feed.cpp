#include "tests/bench/stream/frame_feed.h"

#include <spdlog/spdlog.h>

#include <cstdlib>

#include "tests/bench/stream/frame_tally.h"

namespace flexcast::bench {

wire::Participant join(int domain) {
  auto participant = wire::Participant::create({.domain = domain});
  if (participant) return std::move(participant).value();
  spdlog::error("{}", participant.error().message);
  std::exit(1);
}

server::Publications make_publications(const wire::Participant& participant, std::int64_t particles) {
  auto publications = server::Publications::create(participant, "ours", 1,
                                                   wire::frames_writer_qos(static_cast<std::size_t>(12 * particles)));
  if (publications) return std::move(publications).value();
  spdlog::error("{}", publications.error().message);
  std::exit(1);
}

FrameFeed::FrameFeed(const wire::Participant& participant, std::int64_t particles)
    : mailbox_(particles),
      publications_(make_publications(participant, particles)),
      publisher_(publications_, mailbox_) {
  state_.positions = VecX::Random(3 * particles);
  state_.velocities = VecX::Random(3 * particles);
  header_.run_id = 1;
  mailbox_.on_room([this] { room_.wake(); });
  publisher_.start();
}

FrameFeed::~FrameFeed() {
  publisher_.stop();
}

void FrameFeed::push() {
  header_.time = monotonic_seconds();
  while (!mailbox_.push(header_, state_)) room_.wait_for(std::chrono::milliseconds(100));
  ++header_.frame;
  ++header_.step;
  mailbox_.beat();
}

void FrameFeed::push_for(double seconds) {
  const double end = monotonic_seconds() + seconds;
  while (monotonic_seconds() < end) push();
}

}  // namespace flexcast::bench
