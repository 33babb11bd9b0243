#include "core/lab/cost/scene_extras.h"

#include <algorithm>
#include <deque>
#include <functional>
#include <string>
#include <utility>

#include "core/lab/bench/bench_timing.h"
#include "core/lab/stream/frame_preparation.h"

namespace flexcast {
namespace {

void read_probes(const Simulation& simulation, std::vector<Vec3>& values) {
  values.clear();
  for (const Probe& probe : simulation.probes()) {
    values.push_back(block3(simulation.state().positions, probe.particle));
    values.push_back(block3(simulation.state().velocities, probe.particle));
  }
}

}  // namespace

std::vector<ExtraCost> measure_extras(const Simulation& simulation) {
  const StreamSettings& stream = simulation.settings().stream;
  std::vector<ExtraCost> extras;
  Turns turns;
  const auto add = [&](const std::string& name, const char* when, std::function<void()> task) {
    extras.push_back({name, when});
    turns.add(std::move(task));
  };
  StepReport report;
  add("energies", "report", [&] { report = simulation.calc_report(); });
  std::vector<Vec3> values;
  if (!simulation.probes().empty()) add("probes", "report", [&] { read_probes(simulation, values); });
  std::uint64_t hash = 0;
  add("state hash", "frame", [&] { hash = simulation.calc_state_hash(); });
  std::deque<FramePreparation> frames;  // stay where they are; the first has no field
  const std::size_t bounds = extras.size();
  add("bounds", "frame", [&frame = frames.emplace_back(simulation, StreamFormat{.positions = false})] { frame.run(); });
  for (const std::string& field : stream.fields) {
    const StreamFormat format = make_stream_format({.fields = {field}, .precision = stream.precision});
    add(field, "frame", [&frame = frames.emplace_back(simulation, format)] { frame.run(); });
  }
  const std::vector<double> seconds = turns.measure({.turns = 31, .budget = 2.0});
  for (std::size_t i = 0; i < extras.size(); ++i) {
    extras[i].seconds = i > bounds ? std::max(0.0, seconds[i] - seconds[bounds]) : seconds[i];
  }
  return extras;
}

}  // namespace flexcast
