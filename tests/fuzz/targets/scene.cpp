// Scene files: any text is a scene or refused with a text; a small scene steps, and its state stays finite or the step
// is refused.
#include <toml++/toml.h>

#include <algorithm>
#include <numeric>
#include <optional>

#include "core/scene/build.h"
#include "core/scene/scene.h"
#include "core/scene/scene_reader.h"
#include "tests/fuzz/targets/fuzz.h"

namespace flexcast::fuzz {
namespace {

constexpr double most_cells = 64;  // of a body: an input is a matter of milliseconds
constexpr int steps = 2;

// None: refused.
std::optional<SceneDescription> describe(const std::string& text) {
  try {
    return read_scene(toml::parse(text, std::string("scene")));
  } catch (const toml::parse_error&) {
  } catch (const SceneError& error) {
    require(error.what()[0] != 0, "an error without a text");
  }
  return {};
}

bool is_small(const SceneDescription& scene) {
  const auto fits = [](const BodyDescription& body) {
    const auto& cells = body.mesh.cells;
    return body.mesh.file.empty() &&
           std::accumulate(cells.begin(), cells.end(), 1.0, std::multiplies<>()) <= most_cells;
  };
  const Settings& settings = scene.settings;
  return scene.bodies.size() <= 4 && std::all_of(scene.bodies.begin(), scene.bodies.end(), fits) &&
         settings.time.substeps <= 10 && settings.solver.newton_iterations <= 20 && settings.solver.iterations <= 20;
}

}  // namespace
}  // namespace flexcast::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace flexcast;
  const auto description = fuzz::describe(fuzz::as_text(data, size));
  if (!description || !fuzz::is_small(*description)) return 0;
  const auto simulation = make_simulation(*description, "/nowhere");
  if (!simulation) {
    fuzz::require(!simulation.error().message.empty(), "an error without a text");
    return 0;
  }
  for (int i = 0; i < fuzz::steps; ++i) {
    if (!simulation.value()->step()) break;
    const State& state = simulation.value()->state();
    fuzz::require(state.positions.allFinite() && state.velocities.allFinite(), "a state that is not finite");
  }
  return 0;
}
