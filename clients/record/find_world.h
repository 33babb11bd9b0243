// Finding the world to record.
#pragma once

#include <chrono>
#include <functional>
#include <string>

#include "idl/wire/world_watch.h"

namespace flexcast::record {

// Asked while waiting; true ends the wait.
using Interrupted = std::function<bool()>;

struct FoundWorld {
  std::string name;
  wire::Guid server{};  // its participant
};

// Waits until the world (any world, if `name` is "") is there. The error says what was looked for: world, domain and
// profile; with several worlds and no name it lists them.
wire::Result<FoundWorld> find_world(wire::WorldWatch& watch, const wire::Participant& participant,
                                    const std::string& name, std::chrono::duration<double> wait,
                                    const Interrupted& interrupted);

// "world 'beam' on domain 0 (profile loopback)"
std::string describe_place(const std::string& world, const wire::Participant& participant);

}  // namespace flexcast::record
