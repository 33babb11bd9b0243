// Client: one WebSocket connection's subscriptions and what waits to be sent on it. Frames wait nowhere: whenever the
// socket takes the next message, it is of the newest frame there is.
#pragma once

#include <deque>
#include <map>
#include <set>

#include "clients/web/catalog.h"
#include "clients/web/line.h"
#include "clients/web/rate_limit.h"
#include "clients/web/world_record.h"

namespace flexcast::web {

class Client;

// Who answers the clients.
class ClientHost {
 public:
  virtual ~ClientHost() = default;
  virtual void handle(Client& client, bool is_text, std::string_view message) = 0;
  virtual void forget(Client& client) = 0;  // the client goes
};

namespace limits {
inline constexpr std::size_t queue_bytes = 1024 * 1024;  // of small messages that a client has not taken
inline constexpr std::size_t queue_messages = 1024;
inline constexpr double messages_per_second = 200;
inline constexpr double message_burst = 400;
inline constexpr std::size_t watched_names = 4096;
}  // namespace limits

class Client final : public Peer {
 public:
  // Both outlive the client.
  Client(Line& line, ClientHost& host) : line_(line), host_(host) {}
  ~Client() override { host_.forget(*this); }

  void receive(bool is_text, std::string_view message) override;
  void receive_control() override { (void)may_go_on(); }
  std::optional<Outgoing> next() override;

  // A small message: never left out. A client that does not take them is closed.
  void send(Outgoing message);
  // One of those that greet a new client.
  void greet(Outgoing message);

  // An empty text, or why not. `world` outlives the client.
  std::string subscribe(std::uint32_t id, const Channel& channel, const WorldRecord& world);
  bool unsubscribe(std::uint32_t id);
  void drop(const WorldRecord& world);  // all subscriptions to it

  // Something new of a world.
  void note_state(const WorldRecord& world, wire::TopicId topic, std::uint64_t key);
  void note_log(const WorldRecord& world, wire::TopicId topic, const Sample& sample);
  void note_frame(const WorldRecord& world);
  bool wants(Flow flow, const WorldRecord& world) const;
  bool wants(Flow flow) const;

  // Parameters whose changes it wants to hear of, by full name.
  void watch(const std::vector<std::string>& names);  // none: all
  void unwatch(const std::vector<std::string>& names);
  bool watches(const std::string& name) const { return watches_all_ || watched_.contains(name); }

 private:
  struct Subscription {
    const Channel* channel;
    const WorldRecord* world;
    std::set<std::uint64_t> keys{};  // states to be sent
    std::uint64_t frame_number = 0;  // of the last frame that was sent or begun
  };
  // A frame of which some chunks are sent.
  struct Begun {
    std::uint32_t subscription;
    FramePointer frame;
    std::size_t next_chunk;
  };
  bool may_go_on();
  void send_newest(std::uint32_t id, Subscription& subscription);
  std::optional<Outgoing> next_chunk();
  std::optional<Outgoing> next_state();
  std::optional<Outgoing> next_frame();
  std::optional<Outgoing> begin_frame(std::uint32_t id, Subscription& subscription);

  Line& line_;
  ClientHost& host_;
  RateLimit rate_{limits::messages_per_second, limits::message_burst};
  bool closing_ = false;
  std::deque<Outgoing> queue_;
  std::size_t queue_bytes_ = 0;
  std::map<std::uint32_t, Subscription> subscriptions_;
  std::optional<Begun> begun_;
  std::uint32_t last_served_ = 0;  // the subscription whose frame came last
  bool watches_all_ = false;
  std::set<std::string> watched_;
};

}  // namespace flexcast::web
