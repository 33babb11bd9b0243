// What clients ask for.
#include <algorithm>

#include "clients/web/decode_news.h"
#include "clients/web/hub.h"

namespace flexcast::web {
namespace {

std::optional<flexcast_ValueKind> find_kind(const WorldRecord& world, const std::string& name) {
  for (const client::Descriptor& descriptor : world.parameters().descriptors)
    if (descriptor.name == name) return descriptor.kind;
  return {};
}

std::vector<client::Parameter> with_prefix(const WorldRecord& world, const std::vector<client::Parameter>& values) {
  std::vector<client::Parameter> full;
  for (const auto& [name, value] : values) full.push_back({world.prefix + name, value});
  return full;
}

std::vector<std::string> names_of(const std::vector<client::Parameter>& values) {
  std::vector<std::string> names;
  for (const auto& [name, value] : values) names.push_back(name);
  return names;
}

// The values in force of those names.
std::vector<client::Parameter> find_values(const WorldRecord& world, const std::vector<std::string>& names) {
  std::vector<client::Parameter> found;
  for (const client::Parameter& parameter : world.parameters().values)
    if (std::find(names.begin(), names.end(), parameter.name) != names.end()) found.push_back(parameter);
  return found;
}

}  // namespace

void Hub::handle(Client& client, bool is_text, std::string_view message) {
  const auto parsed = parse_message(is_text, message);
  if (!parsed) return client.send(status_message(Level::error, parsed.error().message));
  std::visit([&](const auto& request) { handle(client, request); }, parsed.value());
}

void Hub::handle(Client& client, const Subscribe& message) {
  for (const auto [id, number] : message.entries) {
    const Channel* channel = catalog_.find_channel(number);
    const auto world = channel ? worlds_.find(channel->world) : worlds_.end();
    if (world == worlds_.end() || !world->second->advertised) {
      client.send(status_message(Level::error, "there is no channel " + std::to_string(number)));
      continue;
    }
    WorldRecord& record = *world->second;
    // The frames of a world that stands still do not come again.
    if (channel->row->flow == Flow::points && record.frame() && !record.frame()->points) {
      WholeFrame frame = *record.frame();
      frame.points = make_points(frame);
      record.add_frame(std::make_shared<const WholeFrame>(std::move(frame)));
    }
    const std::string error = client.subscribe(id, *channel, record);
    if (!error.empty()) client.send(status_message(Level::error, error));
  }
  tend_wanted();
}

void Hub::handle(Client& client, const Unsubscribe& message) {
  for (const std::uint32_t id : message.ids)
    if (!client.unsubscribe(id))
      client.send(status_message(Level::error, "there is no subscription " + std::to_string(id)));
  tend_wanted();
}

WorldRecord* Hub::find_world(const std::string& full_name) {
  const std::size_t slash = full_name.find('/');
  const std::string prefix = slash == std::string::npos ? "" : full_name.substr(0, slash + 1);
  for (const auto& [name, world] : worlds_)
    if (world->advertised && world->prefix == prefix) return world.get();
  return nullptr;
}

void Hub::handle(Client& client, const GetParameters& message) {
  std::vector<client::Parameter> values;
  for (const auto& [name, world] : worlds_) {
    if (!world->advertised) continue;
    for (const client::Parameter& parameter : with_prefix(*world, world->parameters().values))
      if (message.names.empty() ||
          std::find(message.names.begin(), message.names.end(), parameter.name) != message.names.end())
        values.push_back(parameter);
  }
  client.send(parameter_values_message(values, message.id));
}

// All or nothing in each world.
void Hub::handle(Client& client, const SetParameters& message) {
  std::map<WorldRecord*, std::vector<client::Parameter>> by_world;
  std::map<WorldRecord*, std::string> errors;
  for (const auto& [full_name, content] : message.entries) {
    WorldRecord* world = find_world(full_name);
    if (!world) {
      client.send(status_message(Level::error, "there is no world for the parameter '" + full_name + "'"));
      continue;
    }
    const std::string name = full_name.substr(world->prefix.size());
    auto value = to_value(content, find_kind(*world, name));
    by_world[world].push_back({name, value ? value.value() : client::Value()});
    if (!value) errors.try_emplace(world, full_name + ": " + value.error().message);
  }
  for (auto& [world, values] : by_world) {
    const auto error = errors.find(world);
    if (error != errors.end()) {
      refuse_set(client, *world, names_of(values), error->second, message.id);
    } else {
      set(client, *world, std::move(values), message.id);
    }
  }
}

void Hub::set(Client& client, WorldRecord& world, std::vector<client::Parameter> values,
              const std::optional<std::string>& id) {
  const auto names = names_of(values);
  if (!port_.may_command())
    return refuse_set(client, world, names, "the identity of this flexcast-web may only watch", id);
  const auto answer = [this, &client, &world, names, id](const wire::Result<client::Reply>& reply) {
    if (!reply) return refuse_set(client, world, names, reply.error().message, id);
    if (!reply.value().applied()) return refuse_set(client, world, names, reply.value().reason, id);
    if (id) client.send(parameter_values_message(with_prefix(world, reply.value().values), id));
  };
  router_.send(world.name(), {.kind = flexcast_COMMAND_SET, .values = std::move(values)}, &client, now_(), answer);
}

void Hub::refuse_set(Client& client, const WorldRecord& world, const std::vector<std::string>& names,
                     const std::string& reason, const std::optional<std::string>& id) {
  client.send(status_message(Level::error, reason));
  client.send(parameter_values_message(with_prefix(world, find_values(world, names)), id));
}

void Hub::handle(Client& client, const WatchParameters& message) {
  message.on ? client.watch(message.names) : client.unwatch(message.names);
}

void Hub::handle(Client& client, const CallService& message) {
  const auto fail = [&client, service = message.service, call = message.call](const std::string& why) {
    client.send(service_failure_message(service, call, why));
  };
  const ServiceEntry* entry = catalog_.find_service(message.service);
  const auto world = entry ? worlds_.find(entry->world) : worlds_.end();
  if (world == worlds_.end() || !world->second->advertised || !port_.may_command())
    return fail("there is no service " + std::to_string(message.service));
  if (message.encoding != "json") return fail("the encoding must be json");
  const auto request = parse_request(*entry->service, message.payload,
                                     [&](const std::string& name) { return find_kind(*world->second, name); });
  if (!request) return fail(request.error().message);
  router_.send(entry->world, request.value(), &client, now_(),
               [&client, fail, service = message.service, call = message.call](const auto& reply) {
                 if (!reply) return fail(reply.error().message);
                 client.send(service_response_message(service, call, to_response(reply.value())));
               });
}

}  // namespace flexcast::web
