// Hub: joins worlds and clients. Everything happens on the network's thread; no sockets and no DDS here.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "clients/web/catalog.h"
#include "clients/web/client.h"
#include "clients/web/client_message.h"
#include "clients/web/messages.h"
#include "clients/web/router.h"
#include "clients/web/wanted.h"
#include "clients/web/world_record.h"

namespace flexcast::web {

struct HubOptions {
  std::string world{};    // the home world; "": the first one that shows
  std::string place{};    // "domain 0 (profile loopback)"
  std::string session{};  // of this program
};

class Hub final : public ClientHost {
 public:
  using Clock = std::chrono::steady_clock;
  using Want = std::function<void(const Wanted&)>;

  // `port` outlives the hub. `want` is told when other frames are wanted than before; `now` is the time.
  Hub(HubOptions options, CommandPort& port, Want want, std::function<Clock::time_point()> now = Clock::now);
  ~Hub() override;

  // Null: there are too many. The client must go before the hub.
  std::unique_ptr<Peer> connect(Line& line);
  bool is_full() const { return clients_.size() >= most_clients; }

  void take(Delivery delivery);
  void tick();  // ten times a second

  void handle(Client& client, bool is_text, std::string_view message) override;
  void forget(Client& client) override;

  static constexpr std::size_t most_clients = 32;
  static constexpr std::chrono::milliseconds silence{1750};  // a status missed its deadline (0.75 s) for a second
  static constexpr std::chrono::seconds linger{2};           // frames are read on: pages are loaded again
  static constexpr std::chrono::milliseconds time_period{100};

 private:
  struct Notice {
    Level level;
    std::string text;
  };
  WorldRecord& record(const std::string& world);
  std::optional<wire::Guid> find_server(const std::string& world) const;

  void take(const StatusNews& news);
  void take(const EndNews& news);
  void take(const StateNews& news);
  void take(const EventNews& news);
  void take(const ReplyNews& news);
  void take_frame(const std::string& world, FramePointer frame);

  void greet(Client& client);
  void revive(WorldRecord& world);
  void fall_silent(WorldRecord& world);
  void end(WorldRecord& world);
  void advertise(WorldRecord& world);
  std::vector<Outgoing> advertisements(const WorldRecord& world);
  void set_notice(const std::string& id, Level level, const std::string& text);
  void remove_notice(const std::string& id);
  void tend_home_notice();
  void broadcast(const Outgoing& message);
  void tend_wanted();

  void handle(Client& client, const Subscribe& message);
  void handle(Client& client, const Unsubscribe& message);
  void handle(Client& client, const GetParameters& message);
  void handle(Client& client, const SetParameters& message);
  void handle(Client& client, const WatchParameters& message);
  void handle(Client& client, const CallService& message);
  void set(Client& client, WorldRecord& world, std::vector<client::Parameter> values,
           const std::optional<std::string>& id);
  void refuse_set(Client& client, const WorldRecord& world, const std::vector<std::string>& names,
                  const std::string& reason, const std::optional<std::string>& id);
  WorldRecord* find_world(const std::string& full_name);  // of a parameter; null: none is advertised

  HubOptions options_;
  CommandPort& port_;
  Want want_;
  std::function<Clock::time_point()> now_;
  std::string home_;
  Catalog catalog_;
  std::map<std::string, std::unique_ptr<WorldRecord>> worlds_;
  Router router_;
  std::set<Client*> clients_;
  std::map<std::string, Notice> notices_;  // that hold now, by id
  Wanted wanted_;
  Clock::time_point frames_wanted_{};  // lately
  Clock::time_point time_sent_{};
};

}  // namespace flexcast::web
