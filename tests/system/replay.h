// The same scene once more, stepped inside the test: what a recording must agree with.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/scene/scene.h"
#include "tests/system/messages.h"

namespace flexcast::test {

struct Change {
  std::int64_t step = 0;  // it takes effect between this step and the next
  std::vector<ParameterAssignment> values;
};

// The parameter changes that the recorded events tell of.
std::vector<Change> changes_of(const std::vector<EventMessage>& set_events);

// Visits the initial state and the state after each of `steps` steps.
void replay(const std::filesystem::path& scene, std::int64_t steps, const std::vector<Change>& changes,
            const std::function<void(const Simulation&)>& visit);

// State hashes: the initial state, then after each step.
std::vector<std::uint64_t> calc_hashes(const std::filesystem::path& scene, std::int64_t steps,
                                       const std::vector<Change>& changes = {});

std::vector<std::uint64_t> hashes_of(const std::vector<FrameMessage>& frames);

}  // namespace flexcast::test
