// Watcher: a reader of a replay's world in this process, and the replay itself.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "clients/client/connection.h"
#include "clients/replay/replay.h"
#include "idl/wire/raw_reader.h"
#include "tests/support/network.h"
#include "tests/support/recording_maker.h"

namespace flexcast::replay::test {

using namespace std::chrono_literals;

// Waits until `condition` holds; false after half a minute.
inline bool eventually(const std::function<bool()>& condition) {
  for (int i = 0; i < 6000 && !condition(); ++i) std::this_thread::sleep_for(5ms);
  return condition();
}

// A sample as it came, with the time of its writing.
struct Arrived {
  std::vector<std::byte> bytes;
  std::int64_t written = 0;
};

// Everything of one topic.
template <class T>
class Listener {
 public:
  explicit Listener(const wire::Participant& participant)
      : reader_(wire::RawReader::create(participant, wire::topic_of<T>()).value()) {}

  const std::vector<Arrived>& take() {
    for (std::size_t taken = 1; taken > 0;) {
      taken = reader_
                  .take_raw([&](const wire::RawSample& sample) {
                    disposed_ |= sample.info.state == wire::InstanceState::disposed;
                    if (!sample.info.valid) return;
                    samples_.push_back({{sample.bytes.begin(), sample.bytes.end()}, sample.info.source_time});
                  })
                  .value();
    }
    return samples_;
  }
  bool disposed() const { return disposed_; }
  void clear() { samples_.clear(); }
  const wire::RawReader& reader() const { return reader_; }

 private:
  wire::RawReader reader_;
  std::vector<Arrived> samples_;
  bool disposed_ = false;
};

inline std::unique_ptr<Replay> start(Options options) {
  options.domain = flexcast::test::test_domain();
  options.profile = "loopback";
  auto started = Replay::start(options, {.say = [](const std::string& line) { ADD_FAILURE() << line; }});
  if (!started) throw std::runtime_error(started.error().message);
  return std::move(started).value();
}

inline client::Connection connect(const std::string& world = "beam") {
  auto connection = client::Connection::open(
      {.world = world, .domain = flexcast::test::test_domain(), .profile = "loopback", .wait = 40s});
  if (!connection) throw std::runtime_error(connection.error().message);
  return std::move(connection).value();
}

inline client::Reply applied(const client::Result<client::Reply>& reply) {
  if (!reply) throw std::runtime_error(reply.error().message);
  EXPECT_TRUE(reply.value().applied()) << reply.value().reason;
  return reply.value();
}

}  // namespace flexcast::replay::test
