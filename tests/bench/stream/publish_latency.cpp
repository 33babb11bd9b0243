#include "tests/bench/stream/publish_latency.h"

#include <nlohmann/json.hpp>
#include <thread>

#include "core/sim/chunks.h"
#include "core/sim/frame_size.h"
#include "idl/wire/fill.h"
#include "idl/wire/writer.h"
#include "tests/bench/stream/child.h"
#include "tests/bench/stream/frame_feed.h"
#include "tests/bench/stream/frame_tally.h"

namespace flexcast::bench {
namespace {

// Writes samples that are ready to be sent, in as many chunks as the server's.
class BareSource {
 public:
  BareSource(const wire::Participant& participant, std::int64_t particles)
      : writer_(wire::Writer<flexcast_ParticleFrame>::create(
                    participant, wire::frames_writer_qos(static_cast<std::size_t>(12 * particles)))
                    .value()),
        positions_(static_cast<std::size_t>(3 * particles), 1.0f) {
    wire::set_string(frame_->world, "bare");
    frame_->chunks = calc_frame_size(particles, StreamFormat{}).chunks;
    frame_->total = static_cast<std::uint32_t>(particles);
  }

  void push() {
    frame_->time = monotonic_seconds();
    for (frame_->chunk = 0; frame_->chunk < frame_->chunks; ++frame_->chunk) {
      const ChunkRun run = chunk_run(frame_->total, frame_->chunk, frame_->chunks);
      wire::view(frame_->positions, std::span<const float>(positions_).subspan(3 * run.first, 3 * run.count));
      (void)writer_.write(*frame_);
    }
    ++frame_->frame;
  }

 private:
  wire::Writer<flexcast_ParticleFrame> writer_;
  wire::Owned<flexcast_ParticleFrame> frame_;
  std::vector<float> positions_;
};

Latency latency_of(const nlohmann::json& report, const char* world) {
  if (!report.contains(world)) return {};
  return {report[world]["p50"].get<double>(), report[world]["p99"].get<double>()};
}

}  // namespace

Latencies measure_latencies(int domain, std::int64_t particles, double rate, double seconds) {
  const auto participant = join(domain);
  FrameFeed ours(participant, particles);
  BareSource bare(participant, particles);
  Child subscriber("/proc/self/exe",
                   {"--subscriber", std::to_string(12 * particles), "--domain", std::to_string(domain)});
  subscriber.hear();
  const std::chrono::duration<double> half_period(0.5 / rate);
  const auto run_for = [&](double span) {
    for (const double end = monotonic_seconds() + span; monotonic_seconds() < end;) {
      ours.push();
      std::this_thread::sleep_for(half_period);
      bare.push();
      std::this_thread::sleep_for(half_period);
    }
  };
  run_for(1.0);
  subscriber.tell("clear");
  run_for(seconds);
  subscriber.tell("report");
  const auto report = nlohmann::json::parse(subscriber.hear());
  return {latency_of(report, "ours"), latency_of(report, "bare")};
}

}  // namespace flexcast::bench
