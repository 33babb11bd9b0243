#include "clients/web/hub.h"

namespace flexcast::web {
namespace {

constexpr const char* home_notice = "no-world";

std::string notice_of(const WorldRecord& world) {
  return "world:" + world.name();
}

}  // namespace

Hub::Hub(HubOptions options, CommandPort& port, Want want, std::function<Clock::time_point()> now)
    : options_(std::move(options)),
      port_(port),
      want_(std::move(want)),
      now_(std::move(now)),
      home_(options_.world),
      router_(port, [this](const std::string& world) { return find_server(world); }) {
  tend_home_notice();
}

Hub::~Hub() = default;

WorldRecord& Hub::record(const std::string& world) {
  auto& entry = worlds_[world];
  if (!entry) entry = std::make_unique<WorldRecord>(world);
  return *entry;
}

std::optional<wire::Guid> Hub::find_server(const std::string& world) const {
  const auto found = worlds_.find(world);
  if (found == worlds_.end() || found->second->life != Life::alive) return {};
  return found->second->server;
}

std::unique_ptr<Peer> Hub::connect(Line& line) {
  if (is_full()) return nullptr;
  auto client = std::make_unique<Client>(line, *this);
  clients_.insert(client.get());
  greet(*client);
  return client;
}

void Hub::greet(Client& client) {
  client.greet(server_info_message(options_.session, home_));
  for (const auto& [id, notice] : notices_) client.greet(status_message(notice.level, notice.text, id));
  bool any = false;
  for (const auto& [name, world] : worlds_) {
    if (!world->advertised) continue;
    for (Outgoing& message : advertisements(*world)) client.greet(std::move(message));
    any = true;
  }
  if (!any) client.greet(advertise_message({}));  // the protocol wants one
}

void Hub::forget(Client& client) {
  clients_.erase(&client);
  router_.forget(&client);
  tend_wanted();
}

void Hub::take(Delivery delivery) {
  for (const News& news : delivery.news) std::visit([this](const auto& one) { take(one); }, news);
  for (auto& [world, frame] : delivery.frames) take_frame(world, std::move(frame));
}

void Hub::take(const StatusNews& news) {
  WorldRecord& world = record(news.world);
  if (world.server_id != news.server_id && world.server_id != 0)
    router_.lose(news.world, "the server of world '" + news.world + "' was restarted");
  world.server_id = news.server_id;
  world.server = news.server;
  world.heard = now_();
  world.add_status(news.sample);
  router_.note_life(news.world, world.heard);
  if (world.life != Life::alive) revive(world);
  for (Client* client : clients_) client->note_log(world, wire::TopicId::status, news.sample);
  if (news.world == home_ && world.heard - time_sent_ >= time_period) {
    time_sent_ = world.heard;
    broadcast(time_message(news.sample.time));
  }
}

void Hub::take(const EndNews& news) {
  const auto found = worlds_.find(news.world);
  if (found == worlds_.end()) return;
  if (news.on_purpose) {
    end(*found->second);
  } else if (found->second->life == Life::alive) {
    fall_silent(*found->second);
  }
}

void Hub::take(const StateNews& news) {
  WorldRecord& world = record(news.world);
  const auto changes = world.add_state(news);
  for (Client* client : clients_) {
    client->note_state(world, news.topic, news.key);
    std::vector<client::Parameter> heard;
    for (const auto& [name, value] : changes)
      if (client->watches(world.prefix + name)) heard.push_back({world.prefix + name, value});
    if (!heard.empty() && world.advertised) client->send(parameter_values_message(heard, {}));
  }
}

void Hub::take(const EventNews& news) {
  WorldRecord& world = record(news.world);
  world.add_event(news);
  for (Client* client : clients_) client->note_log(world, wire::TopicId::events, news.sample);
}

void Hub::take(const ReplyNews& news) {
  router_.receive(news.world, news.request_id, news.reply);
}

void Hub::take_frame(const std::string& name, FramePointer frame) {
  if (!wanted_.frames) return;  // one of before
  WorldRecord& world = record(name);
  world.add_frame(std::move(frame));
  for (Client* client : clients_) client->note_frame(world);
}

void Hub::tick() {
  const auto now = now_();
  router_.tick(now);
  for (const auto& [name, world] : worlds_)
    if (world->life == Life::alive && now - world->heard > silence) fall_silent(*world);
  tend_wanted();
}

// The first world that shows becomes the home, unless one was named.
void Hub::revive(WorldRecord& world) {
  world.life = Life::alive;
  if (home_.empty() && !world.advertised) {
    home_ = world.name();
    broadcast(server_info_message(options_.session, home_));
  }
  remove_notice(notice_of(world));
  if (!world.advertised) advertise(world);
  tend_home_notice();
}

void Hub::fall_silent(WorldRecord& world) {
  world.life = Life::silent;
  set_notice(notice_of(world), Level::error,
             "world '" + world.name() + "' has fallen silent: its server hangs, was killed or is out of reach");
}

void Hub::end(WorldRecord& world) {
  if (world.life == Life::ended) return;
  world.life = Life::ended;
  router_.lose(world.name(), "world '" + world.name() + "' has ended");
  if (world.advertised) {
    std::vector<std::uint32_t> channels, services;
    for (const Channel* channel : catalog_.channels(world.name(), world.prefix)) channels.push_back(channel->id);
    for (const ServiceEntry* service : catalog_.services(world.name(), world.prefix)) services.push_back(service->id);
    broadcast(unadvertise_message(channels));
    if (port_.may_command()) broadcast(unadvertise_services_message(services));
  }
  world.advertised = false;
  world.server_id = 0;
  world.clear();
  for (Client* client : clients_) client->drop(world);
  set_notice(notice_of(world), Level::warning, "world '" + world.name() + "' has ended");
  if (world.name() == home_ && options_.world.empty()) home_.clear();  // the next one takes its place
  tend_home_notice();
  tend_wanted();
}

void Hub::advertise(WorldRecord& world) {
  world.prefix = world.name() == home_ ? "" : world.name() + "/";
  world.advertised = true;
  for (const Outgoing& message : advertisements(world)) broadcast(message);
}

std::vector<Outgoing> Hub::advertisements(const WorldRecord& world) {
  std::vector<Outgoing> messages{advertise_message(catalog_.channels(world.name(), world.prefix))};
  if (port_.may_command())
    messages.push_back(advertise_services_message(catalog_.services(world.name(), world.prefix)));
  return messages;
}

void Hub::set_notice(const std::string& id, Level level, const std::string& text) {
  notices_[id] = {level, text};
  broadcast(status_message(level, text, id));
}

void Hub::remove_notice(const std::string& id) {
  if (notices_.erase(id) > 0) broadcast(remove_status_message(id));
}

void Hub::tend_home_notice() {
  const auto home = worlds_.find(home_);
  if (home != worlds_.end() && home->second->advertised) return remove_notice(home_notice);
  const std::string what = home_.empty() ? "a world" : "world '" + home_ + "'";
  set_notice(home_notice, Level::info, "looking for " + what + " on " + options_.place);
}

void Hub::broadcast(const Outgoing& message) {
  for (Client* client : clients_) client->send(message);
}

// Frames are wanted for a while after the last one who wanted them has gone.
void Hub::tend_wanted() {
  Wanted wanted;
  for (const Client* client : clients_) {
    wanted.frames |= client->wants(Flow::frames) || client->wants(Flow::points);
    for (const auto& [name, world] : worlds_)
      if (client->wants(Flow::points, *world)) wanted.points.insert(name);
  }
  if (wanted.frames) frames_wanted_ = now_();
  wanted.frames |= wanted_.frames && now_() - frames_wanted_ < linger;
  if (wanted == wanted_) return;
  wanted_ = wanted;
  want_(wanted_);
  if (wanted_.frames) return;
  for (const auto& [name, world] : worlds_) world->forget_frame();
}

}  // namespace flexcast::web
