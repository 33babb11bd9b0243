// CSV: a row a frame with the probes of the scene, the columns named as flexcast-lab names them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "clients/client/frame.h"
#include "idl/wire/types.h"

namespace flexcast::exporting {

struct Probe {
  std::string name;
  std::uint32_t particle = 0;
};

std::vector<Probe> probes_of(const flexcast_SceneInfo& scene);

// "run,frame,step,time,tip.x,tip.y,tip.z,tip.vx,...", with the end of the line.
std::string make_csv_header(const std::vector<Probe>& probes, bool velocities);

// Seventeen digits: numbers come back bit for bit. Every probe must be a particle of the frame.
std::string make_csv_row(const client::Frame& frame, const std::vector<Probe>& probes, bool velocities);

}  // namespace flexcast::exporting
