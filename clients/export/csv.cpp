#include "clients/export/csv.h"

#include <fmt/format.h>

#include "idl/wire/fill.h"

namespace flexcast::exporting {
namespace {

void add_vector(std::string& row, const std::array<double, 3>& vector) {
  for (const double number : vector) row += fmt::format(",{:.17g}", number);
}

}  // namespace

std::vector<Probe> probes_of(const flexcast_SceneInfo& scene) {
  std::vector<Probe> probes;
  for (const flexcast_ProbeInfo& probe : wire::elements(scene.probes)) {
    probes.push_back({std::string(wire::text(probe.name)), probe.particle});
  }
  return probes;
}

std::string make_csv_header(const std::vector<Probe>& probes, bool velocities) {
  std::string row = "run,frame,step,time";
  for (const Probe& probe : probes) {
    for (const char* component : {"x", "y", "z"}) row += "," + probe.name + "." + component;
    if (!velocities) continue;
    for (const char* component : {"vx", "vy", "vz"}) row += "," + probe.name + "." + component;
  }
  return row + "\n";
}

std::string make_csv_row(const client::Frame& frame, const std::vector<Probe>& probes, bool velocities) {
  std::string row = fmt::format("{},{},{},{:.17g}", frame.run_id, frame.frame, frame.step, frame.time);
  for (const Probe& probe : probes) {
    add_vector(row, frame.position(probe.particle));
    if (velocities) add_vector(row, frame.velocity(probe.particle));
  }
  return row + "\n";
}

}  // namespace flexcast::exporting
