#include "tests/bench/stream/publish_cost.h"

#include <ctime>
#include <thread>

#include "server/convert/frame_capture.h"
#include "server/publications.h"
#include "tests/bench/stream/bare_feed.h"
#include "tests/bench/stream/child.h"
#include "tests/bench/stream/frame_feed.h"
#include "tests/bench/stream/frame_tally.h"
#include "tests/bench/stream/percentiles.h"

namespace flexcast::bench {
namespace {

constexpr int block = 8;  // frames: not more than a subscriber takes in one go

double thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

template <class Push>
double time_block(Push push) {
  const double begin = thread_seconds();
  for (int i = 0; i < block; ++i) push();
  const double cost = (thread_seconds() - begin) / block;
  std::this_thread::sleep_for(std::chrono::milliseconds(2));
  return cost;
}

}  // namespace

Cost measure_publish_cost(int domain, std::int64_t particles, double seconds) {
  const auto participant = join(domain);
  auto publications = make_publications(participant, particles);
  BareFeed bare(participant, particles);
  State state;
  state.positions = VecX::Random(3 * particles);
  state.velocities = VecX::Random(3 * particles);
  server::FrameCapture capture;
  server::FrameHeader header;
  server::Frame frame;
  Child subscriber("/proc/self/exe",
                   {"--subscriber", std::to_string(12 * particles), "--domain", std::to_string(domain)});
  subscriber.hear();
  std::vector<double> ours, bares;
  for (const double end = monotonic_seconds() + seconds; monotonic_seconds() < end;) {
    ours.push_back(time_block([&] {
      capture.fill(header, state, nullptr, frame);
      publications.publish(frame);
      ++header.frame;
    }));
    bares.push_back(time_block([&] { bare.push(); }));
  }
  return {calc_percentile(ours, 0.5), calc_percentile(bares, 0.5)};
}

}  // namespace flexcast::bench
