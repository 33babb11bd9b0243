#include "tests/bench/stream/subscriber.h"

#include <dds/dds.h>
#include <poll.h>
#include <unistd.h>

#include <cstdio>
#include <iostream>
#include <map>
#include <mutex>
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
  explicit Subscriber(const wire::Reader<flexcast_ParticleFrame>& reader) : reader_(reader) {}

  // The reader is attached to `wait_set`.
  void run(const wire::WaitSet& wait_set) {
    while (obey()) {
      announce();
      if (slow_) std::this_thread::sleep_for(100ms);
      if (!wait_set.wait(10ms)) continue;
      slow_ ? take_one() : take();
    }
  }

  void run_by_listener() {
    dds_listener_t* listener = dds_create_listener(this);
    dds_lset_data_available(listener, [](dds_entity_t, void* self) { static_cast<Subscriber*>(self)->take(); });
    dds_set_listener(reader_.handle(), listener);
    dds_delete_listener(listener);
    while (obey()) {
      announce();
      std::this_thread::sleep_for(1ms);
    }
    dds_set_listener(reader_.handle(), nullptr);
  }

 private:
  static void say(const std::string& line) {
    std::puts(line.c_str());
    std::fflush(stdout);
  }

  void announce() {
    if (announced_ || reader_.matched().current == 0) return;
    announced_ = true;
    say("matched");
  }

  void take() {
    const auto samples = reader_.take();
    if (!samples) return;
    const std::scoped_lock lock(mutex_);
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
      const std::scoped_lock lock(mutex_);
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
  std::mutex mutex_;
  std::map<std::string, FrameTally> tallies_;
  bool announced_ = false;
  bool slow_ = false;
};

}  // namespace

int run_subscriber(int domain, std::size_t frame_bytes, TakeBy take_by) {
  std::ios::sync_with_stdio(false);  // lines that came together are all in cin's buffer then
  const auto participant = wire::Participant::create({.domain = domain});
  if (!participant) return 1;
  const auto chunks = static_cast<std::uint32_t>(frame_bytes / wire::largest_sample + 1);
  auto reader =
      wire::Reader<flexcast_ParticleFrame>::create(participant.value(), wire::frames_recorder_qos(frame_bytes, chunks));
  if (!reader) return 1;
  Subscriber subscriber(reader.value());
  if (take_by == TakeBy::listener) return subscriber.run_by_listener(), 0;
  auto wait_set = wire::WaitSet::create(participant.value());
  if (!wait_set || !wait_set.value().attach_data(reader.value())) return 1;
  subscriber.run(wait_set.value());
  return 0;
}

}  // namespace flexcast::bench
