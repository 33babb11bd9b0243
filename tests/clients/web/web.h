// What the tests of the bridge share: samples, a line without a network, a way for commands without DDS.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "clients/web/client_message.h"
#include "clients/web/hub.h"
#include "idl/wire/fill.h"

namespace flexcast::web {

inline Sample make_sample(const std::string& text, std::int64_t time = 1) {
  const auto* first = reinterpret_cast<const std::byte*>(text.data());
  return {std::vector<std::byte>(first, first + text.size()), time};
}

inline std::string text_of(const wire::SampleBytes& bytes) {
  const std::span<const std::byte> span = bytes;
  return {reinterpret_cast<const char*>(span.data()), span.size()};
}

// A whole frame whose chunks say "FRAME.CHUNK".
inline FramePointer make_frame(std::uint64_t number, std::size_t chunks = 1) {
  WholeFrame frame{.run_id = 1, .frame = number};
  for (std::size_t i = 0; i < chunks; ++i)
    frame.chunks.push_back(make_sample(std::to_string(number) + "." + std::to_string(i)));
  return std::make_shared<const WholeFrame>(std::move(frame));
}

class FakeLine final : public Line {
 public:
  void wake() override { ++wakes; }
  void close(CloseCode why, const std::string&) override { closed = why; }
  int wakes = 0;
  std::optional<CloseCode> closed;
};

class FakePort final : public CommandPort {
 public:
  struct Sent {
    std::string world;
    std::uint64_t request_id;
    flexcast_CommandKind kind;
    std::vector<client::Parameter> values;
    std::uint64_t count;
    double expires_in;
  };

  bool may_command() const override { return allowed; }
  const std::string& client_id() const override { return id_; }
  bool reaches(const wire::Guid&) override { return reachable; }
  wire::Result<void> write(const flexcast_Command& command) override {
    sent.push_back({std::string(wire::text(command.world)),
                    command.request_id,
                    command.kind,
                    {},
                    command.count,
                    command.expires_in});
    for (const auto& value : wire::elements(command.values)) sent.back().values.push_back(client::from_wire(value));
    return {};
  }

  bool allowed = true, reachable = true;
  std::vector<Sent> sent;

 private:
  std::string id_ = "web-test";
};

// Everything a peer wants to send now.
inline std::vector<Outgoing> drain(Peer& peer) {
  std::vector<Outgoing> messages;
  while (auto message = peer.next()) messages.push_back(std::move(*message));
  return messages;
}

// The payloads of data messages among them.
inline std::vector<std::string> payloads(const std::vector<Outgoing>& messages) {
  std::vector<std::string> texts;
  for (const Outgoing& message : messages)
    if (!message.is_text && message.head[0] == 1) texts.push_back(text_of(message.body));
  return texts;
}

// The JSON messages among them with this "op".
inline std::vector<nlohmann::json> with_op(const std::vector<Outgoing>& messages, const std::string& op) {
  std::vector<nlohmann::json> found;
  for (const Outgoing& message : messages) {
    if (!message.is_text) continue;
    auto json = nlohmann::json::parse(message.head);
    if (json["op"] == op) found.push_back(std::move(json));
  }
  return found;
}

}  // namespace flexcast::web
