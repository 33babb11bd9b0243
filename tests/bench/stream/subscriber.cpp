#include "tests/bench/stream/subscriber.h"

#include <poll.h>
#include <unistd.h>

#include <cstdio>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "idl/wire/fill.h"
#include "idl/wire/frame_size.h"
#include "idl/wire/reader.h"
#include "idl/wire/wait_set.h"
#include "tests/bench/stream/frame_tally.h"
#include "tests/bench/stream/percentiles.h"

namespace flexcast::bench {
namespace {

using namespace std::chrono_literals;

class Subscriber {
 public:
  // `reader` is attached to `wait_set`.
  Subscriber(const wire::Reader<flexcast_ParticleFrame>& reader, const wire::WaitSet& wait_set)
      : reader_(reader), wait_set_(wait_set) {}

  void run() {
    bool announced = false;
    while (obey()) {
      if (!announced && reader_.matched().current > 0) say("matched");
      announced |= reader_.matched().current > 0;
      if (slow_) std::this_thread::sleep_for(100ms);
      if (!wait_set_.wait(10ms)) continue;
      slow_ ? take_one() : take();
    }
  }

 private:
  static void say(const std::string& line) {
    std::puts(line.c_str());
    std::fflush(stdout);
  }

  void take() {
    const auto samples = reader_.take();
    if (!samples) return;
    for (const auto [frame, info] : samples.value()) {
      if (info.valid) add(frame);
    }
  }
  // As a copy: of one reader all loans must be of one size.
  void take_one() {
    const auto samples = reader_.take_owned(1);
    if (!samples) return;
    for (const auto& sample : samples.value()) {
      if (sample.info.valid) add(*sample.data);
    }
  }
  void add(const flexcast_ParticleFrame& frame) { tallies_[std::string(wire::text(frame.world))].add(frame); }

  // False when the parent has gone.
  bool obey() {
    pollfd input{STDIN_FILENO, POLLIN, 0};
    if (poll(&input, 1, 0) == 0) return true;
    do {
      std::string line;
      if (!std::getline(std::cin, line)) return false;
      if (line == "clear") tallies_.clear();
      if (line == "slow" || line == "fast") slow_ = line == "slow";
      if (line == "report") report();
    } while (std::cin.rdbuf()->in_avail() > 0);
    return true;
  }

  void report() const {
    nlohmann::json report = nlohmann::json::object();
    for (const auto& [world, tally] : tallies_) {
      report[world] = {{"frames", tally.frames()},
                       {"missing", tally.missing()},
                       {"p50", calc_percentile(tally.latencies(), 0.50)},
                       {"p99", calc_percentile(tally.latencies(), 0.99)}};
    }
    say(report.dump());
  }

  const wire::Reader<flexcast_ParticleFrame>& reader_;
  const wire::WaitSet& wait_set_;
  std::map<std::string, FrameTally> tallies_;
  bool slow_ = false;
};

}  // namespace

int run_subscriber(int domain, std::size_t frame_bytes) {
  std::ios::sync_with_stdio(false);  // lines that came together are all in cin's buffer then
  const auto participant = wire::Participant::create({.domain = domain});
  if (!participant) return 1;
  const auto chunks = static_cast<std::uint32_t>(frame_bytes / wire::largest_sample + 1);
  auto reader =
      wire::Reader<flexcast_ParticleFrame>::create(participant.value(), wire::frames_recorder_qos(frame_bytes, chunks));
  if (!reader) return 1;
  auto wait_set = wire::WaitSet::create(participant.value());
  if (!wait_set || !wait_set.value().attach_data(reader.value())) return 1;
  Subscriber(reader.value(), wait_set.value()).run();
  return 0;
}

}  // namespace flexcast::bench
