// How the world is doing: made by the simulation thread when the publisher asks, and whenever the state changes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "server/convert/command_types.h"

namespace flexcast::server {

struct ProbeStatus {
  std::string name;
  Vec3 position = Vec3::Zero();  // m
  Vec3 velocity = Vec3::Zero();  // m/s
};

struct WorldStatus {
  std::uint64_t run_id = 0;
  WorldState state = WorldState::paused;
  MeasuredReport report;
  double rate = 0.0;  // asked for: simulated seconds per wall second; 0: as fast as possible
  std::uint64_t parameter_revision = 0;
  std::uint64_t topology_revision = 1;
  std::optional<Failure> failure;
  std::vector<ProbeStatus> probes;
  std::vector<HandleReport> handles;
  std::vector<std::string> warnings;

  // Measured by the simulation thread.
  double real_time_factor = 0.0;     // lately; 0 while the world stands still
  double step_seconds = 0.0;         // mean wall time of a step, lately
  double report_seconds = 0.0;       // what this status cost to make
  std::uint64_t frames_skipped = 0;  // of this run: the mailbox was full
  std::uint32_t command_queue = 0;
};

struct FrameRange {
  std::uint64_t first = 0;
  std::uint64_t last = 0;  // included
};

// What the publisher knows and the world does not.
struct DeliveryStatus {
  std::uint64_t heartbeat = 0;
  std::uint64_t frames_published = 0;  // of this run, written to somebody
  std::uint32_t frame_queue = 0;
  std::uint32_t readers = 0;
  bool silent = false;                       // the step loop has not come round for long
  std::vector<FrameRange> unpublished = {};  // of this run, the newest ranges
};

}  // namespace flexcast::server
