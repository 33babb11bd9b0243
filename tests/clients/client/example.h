// An integration test of one's own; the README shows it from here on to the end.
#pragma once

#include <chrono>
#include <iostream>

#include "clients/client/connection.h"

// Whether the rope's tip passes x = 3 m once gravity points that way.
inline bool rope_follows_gravity(int domain) {
  namespace client = flexcast::client;
  auto connection = client::Connection::open({.world = "rope", .domain = domain});
  if (!connection) return std::cerr << connection.error().message << "\n", false;
  auto frames = connection.value().frames();
  if (!frames) return std::cerr << frames.error().message << "\n", false;

  const auto set = connection.value().set({{"gravity", client::Vector{9.81, 0, 0}}});
  if (!set) return std::cerr << set.error().message << "\n", false;                   // no answer
  if (!set.value().applied()) return std::cerr << set.value().reason << "\n", false;  // the server said no

  const auto frame = frames.value().wait_for_frame(
      [&](const client::Frame& f) {
        return f.parameter_revision >= set.value().parameter_revision && f.position(f.particles - 1)[0] > 3.0;
      },
      std::chrono::seconds(10));
  if (!frame) std::cerr << frame.error().message << "\n";
  return frame.ok();
}
