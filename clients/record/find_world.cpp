#include "clients/record/find_world.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>

namespace flexcast::record {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

std::string names_of(const wire::WorldWatch& watch) {
  std::set<std::string_view> names;
  for (const wire::World* world : watch.worlds()) names.insert(wire::world_name(*world));
  return fmt::format("{}", fmt::join(names, ", "));
}

const wire::World* any_or_named(const wire::WorldWatch& watch, const std::string& name) {
  if (!name.empty()) return watch.find(name);
  const auto worlds = watch.worlds();
  return worlds.empty() ? nullptr : worlds.front();
}

bool has_several_names(const wire::WorldWatch& watch) {
  const auto worlds = watch.worlds();  // ordered by name
  return !worlds.empty() && wire::world_name(*worlds.front()) != wire::world_name(*worlds.back());
}

}  // namespace

std::string describe_place(const std::string& world, const wire::Participant& participant) {
  const std::string what = world.empty() ? "world" : "world '" + world + "'";
  return fmt::format("{} on domain {} (profile {})", what, participant.domain(), participant.profile());
}

wire::Result<FoundWorld> find_world(wire::WorldWatch& watch, const wire::Participant& participant,
                                    const std::string& name, std::chrono::duration<double> wait,
                                    const Interrupted& interrupted) {
  const std::string place = describe_place(name, participant);
  const auto begin = Clock::now();
  while (!watch.wait_for(name, 100ms)) {
    if (interrupted()) return wire::Error{"interrupted while waiting for a " + place};
    if (Clock::now() - begin < wait) continue;
    const std::string others = names_of(watch);
    return wire::Error{
        fmt::format("no {}: waited {:g} s{}", place, wait.count(), others.empty() ? "" : "; there: " + others)};
  }
  if (name.empty()) watch.discover();
  if (name.empty() && has_several_names(watch)) {
    return wire::Error{fmt::format("more than one {}; name one with --world: {}", place, names_of(watch))};
  }
  const wire::World* world = any_or_named(watch, name);
  if (world == nullptr) return wire::Error{"the " + place + " has just gone"};
  return FoundWorld{std::string(wire::world_name(*world)), world->participant};
}

}  // namespace flexcast::record
