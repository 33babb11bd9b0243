#include "tests/bench/stream/web_consumer.h"

#include <cstdio>
#include <cstdlib>
#include <span>

#include "idl/wire/frame_head.h"
#include "tests/bench/stream/frame_tally.h"

namespace flexcast::bench {
namespace {

[[noreturn]] void give_up(const char* what) {
  std::fprintf(stderr, "flexcast-web-bench: %s\n", what);
  std::exit(1);
}

constexpr std::size_t data_head = 13;  // opcode, subscription, time

}  // namespace

WebConsumer::WebConsumer(std::uint16_t port, std::chrono::milliseconds pause)
    : socket_(port, pause.count() > 0 ? 64 * 1024 : 0), pause_(pause) {
  if (!socket_.upgrade().starts_with("HTTP/1.1 101")) give_up("flexcast-web does not take the client");
  subscribe();
  thread_ = std::thread(&WebConsumer::run, this);
}

WebConsumer::~WebConsumer() {
  stopping_ = true;
  thread_.join();
}

void WebConsumer::subscribe() {
  for (;;) {
    const auto advertised = socket_.receive_op("advertise");
    if (advertised.is_null()) give_up("flexcast-web shows no world");
    for (const auto& channel : advertised["channels"])
      if (channel["topic"] == "flexcast/frames") {
        socket_.send_json({{"op", "subscribe"}, {"subscriptions", {{{"id", 1}, {"channelId", channel["id"]}}}}});
        return;
      }
  }
}

void WebConsumer::clear() {
  const std::scoped_lock lock(mutex_);
  consumption_ = {};
}

Consumption WebConsumer::consumption() const {
  const std::scoped_lock lock(mutex_);
  return consumption_;
}

void WebConsumer::run() {
  while (!stopping_) {
    const auto message = socket_.receive(std::chrono::milliseconds(100));
    if (socket_.ended()) give_up("flexcast-web closed a client");
    if (message && message->opcode == 2 && message->content[0] == 1) add(message->content);
  }
}

void WebConsumer::add(const std::string& message) {
  const auto head = wire::peek_frame_head(std::as_bytes(std::span(message)).subspan(data_head));
  if (!head) give_up("flexcast-web sends what is no frame");
  if (head.value().chunk + 1 != head.value().chunks) return;
  {
    const std::scoped_lock lock(mutex_);
    if (consumption_.frames++ == 0) consumption_.first = head.value().frame;
    consumption_.last = head.value().frame;
    consumption_.latencies.push_back(monotonic_seconds() - head.value().time);
  }
  if (pause_.count() > 0) std::this_thread::sleep_for(pause_);
}

}  // namespace flexcast::bench
