// WebConsumer: a client of flexcast-web on a thread of its own that counts the whole frames it gets.
#pragma once

#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>
#include <vector>

#include "tests/support/socket_client.h"

namespace flexcast::bench {

struct Consumption {
  std::uint64_t frames = 0;
  std::uint64_t first = 0, last = 0;  // numbers of frames
  std::vector<double> latencies{};    // s, from the end of the step to the last byte
};

class WebConsumer {
 public:
  // Subscribes to the frames; ends the bench when it cannot. `pause`: after each frame that it has read.
  WebConsumer(std::uint16_t port, std::chrono::milliseconds pause);
  ~WebConsumer();

  void clear();
  Consumption consumption() const;

 private:
  void subscribe();
  void run();
  void add(const std::string& message);

  test::SocketClient socket_;
  std::chrono::milliseconds pause_;
  mutable std::mutex mutex_;
  Consumption consumption_;
  std::atomic<bool> stopping_ = false;
  std::thread thread_;
};

}  // namespace flexcast::bench
