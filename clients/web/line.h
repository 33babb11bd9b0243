// The two ends of a WebSocket connection: the network's (Line) and the protocol's (Peer). All on the network's thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "idl/wire/sample_bytes.h"

namespace flexcast::web {

// One message: head and body are sent as one, without being copied together.
struct Outgoing {
  bool is_text = true;
  std::string head{};
  wire::SampleBytes body{};

  std::size_t size() const { return head.size() + body.size(); }
};

enum class CloseCode : std::uint16_t { going_away = 1001, policy = 1008, try_again = 1013 };

class Line {
 public:
  virtual ~Line() = default;

  // There is something to send: as soon as the socket takes it, next() is asked.
  virtual void wake() = 0;
  // Says so to the client, or just ends it when it does not listen.
  virtual void close(CloseCode code, const std::string& reason) = 0;
};

// Destroyed when the connection has ended.
class Peer {
 public:
  virtual ~Peer() = default;

  virtual void receive(bool is_text, std::string_view message) = 0;
  virtual void receive_control() = 0;          // a ping or pong, answered already
  virtual std::optional<Outgoing> next() = 0;  // the next message to send, if any
};

}  // namespace flexcast::web
