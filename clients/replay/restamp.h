// Restamping: a recorded message under the name and the run that it is published with.
#pragma once

#include <string>

#include "clients/replay/run_map.h"
#include "idl/wire/fill.h"

namespace flexcast::replay {

struct Stamp {
  const std::string& world;
  const RunMap& runs;
};

// Change the message in place. False: its run, or that frame of it, is not published.
bool restamp(flexcast_ParticleFrame& frame, const Stamp& stamp);
bool restamp(flexcast_Status& status, const Stamp& stamp);

// Scene, topology, parameters and events: world and run alone.
template <class T>
bool restamp(T& message, const Stamp& stamp) {
  const auto run = stamp.runs.find(message.run_id);
  if (!run) return false;
  message.run_id = run->run_id;
  if (wire::text(message.world) != stamp.world) wire::set_string(message.world, stamp.world);
  return true;
}

}  // namespace flexcast::replay
