#include "tests/system/replay.h"

#include <stdexcept>

namespace flexcast::test {
namespace {

ParameterValue value_of(const ParameterMessage& message) {
  switch (message.kind) {
    case flexcast_VALUE_NUMBER:
      return message.numbers.at(0);
    case flexcast_VALUE_INTEGER:
      return static_cast<std::int64_t>(message.numbers.at(0));
    case flexcast_VALUE_VECTOR:
      return Vec3(message.numbers.at(0), message.numbers.at(1), message.numbers.at(2));
    case flexcast_VALUE_CHOICE:
      return message.text;
    case flexcast_VALUE_BOOLEAN:
      break;
  }
  throw std::runtime_error(message.name + " has a value of no kind that the engine knows");
}

}  // namespace

std::vector<Change> changes_of(const std::vector<EventMessage>& set_events) {
  std::vector<Change> changes;
  for (const EventMessage& event : set_events) {
    changes.push_back({static_cast<std::int64_t>(event.step), {}});
    for (const ParameterMessage& value : event.values) changes.back().values.push_back({value.name, value_of(value)});
  }
  return changes;
}

void replay(const std::filesystem::path& scene, std::int64_t steps, const std::vector<Change>& changes,
            const std::function<void(const Simulation&)>& visit) {
  const auto loaded = load_scene(scene);
  if (!loaded) throw std::runtime_error(loaded.error().message);
  Simulation& simulation = *loaded.value().simulation;
  for (std::int64_t step = 0;; ++step) {
    visit(simulation);
    if (step == steps) return;
    for (const Change& change : changes) {
      if (change.step != step) continue;
      if (auto set = simulation.set_parameters(change.values); !set) throw std::runtime_error(set.error().message);
    }
    if (!simulation.step()) throw std::runtime_error(simulation.failure()->text());
  }
}

std::vector<std::uint64_t> calc_hashes(const std::filesystem::path& scene, std::int64_t steps,
                                       const std::vector<Change>& changes) {
  std::vector<std::uint64_t> hashes;
  replay(scene, steps, changes, [&](const Simulation& simulation) { hashes.push_back(simulation.calc_state_hash()); });
  return hashes;
}

std::vector<std::uint64_t> hashes_of(const std::vector<FrameMessage>& frames) {
  std::vector<std::uint64_t> hashes;
  for (const FrameMessage& frame : frames) hashes.push_back(frame.state_hash);
  return hashes;
}

}  // namespace flexcast::test
